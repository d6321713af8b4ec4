// use_send: tries the part "To the kit"; see browser.mjs. FOLDER has box.obj; the UF2 files and the scenes in them go there:
// FOLDER/IMAGE.uf2 and IMAGE.phs. The images stand beside the page, made by kits.sh.
import { readFileSync } from 'node:fs';

const same = (is, must, what) => (String(is) === String(must) ? [] : [`${what}: ${is}, not ${must}`]);
export const SENT = [['pico-display', '', 'pico-display'], ['pico2-display-2', 'arm', 'pico2-display-2'], ['pico2-display-2', 'riscv', 'pico2-display-2-riscv']];

// In the page, before it starts: navigator.usb, with a board in its boot loader that does what PICOBOOT's commands say.
// fault: 'none' (no board is chosen), 'slow', 'hang', 'stall', 'pulled' (after 5 sectors), or ''.
function playBoard(fault) {
    const flash = new Uint8Array(2 ** 21).fill(0x55);
    let command = null, wrote = 0;
    const hangs = () => new Promise(() => {});
    const gone = () => Object.assign(new Error('The device was disconnected.'), { name: 'NotFoundError' });
    const alternate = { interfaceClass: 255, interfaceSubclass: 0, interfaceProtocol: 0, endpoints: [{ direction: 'out', endpointNumber: 3 }, { direction: 'in', endpointNumber: 4 }] };
    const device = {
        configuration: { interfaces: [{ interfaceNumber: 1, alternate }] },
        open: async () => {},
        close: async () => {},
        claimInterface: async () => {},
        clearHalt: async () => {},
        controlTransferIn: async (setup, length) => ({ status: 'ok', data: new DataView(new ArrayBuffer(length)) }),
        controlTransferOut: async () => ({ status: 'ok', bytesWritten: 0 }),
        async transferOut(endpoint, bytes) {
            await new Promise((done) => setTimeout(done, fault === 'slow' ? 20 : 0));
            if (fault === 'hang' && wrote > 3) {
                return hangs();
            }
            if (fault === 'pulled' && wrote > 5) {
                throw gone();
            }
            if (bytes.length === 32) {
                const view = new DataView(bytes.buffer, bytes.byteOffset, 32);
                command = { id: view.getUint8(8), at: view.getUint32(16, true) - 0x10000000, size: view.getUint32(20, true), data: view.getUint32(12, true) };
                if (command.id === 3) {
                    flash.fill(0xFF, command.at, command.at + command.size);
                }
            } else if (bytes.length > 0) {
                flash.set(bytes, command.at);
                wrote++;
                window.boardWrote = wrote;
            }
            return { status: fault === 'stall' && command.id === 5 ? 'stall' : 'ok', bytesWritten: bytes.length };
        },
        async transferIn() {
            const bytes = command.id === 0x84 ? flash.slice(command.at, command.at + command.data) : new Uint8Array();
            window.boardStarted ||= command.id === 2;
            return { status: 'ok', data: new DataView(bytes.buffer) };
        },
    };
    const requestDevice = async () => {
        if (fault === 'none') {
            throw new Error('No device selected.');
        }
        return device;
    };
    window.boardFlash = flash;
    Object.defineProperty(navigator, 'usb', { value: { requestDevice } });
}

async function saves({ browser, open, check, folder }) {
    const page = await open(browser);
    const ready = () => page.waitForFunction(() => document.getElementById('model-busy').hidden && !document.querySelector('#model-send [data-send=save]').disabled);
    const saved = async (button, name) => {
        const [download] = await Promise.all([page.waitForEvent('download'), page.click(button)]);
        await download.saveAs(`${folder}/${name}`);
        return download.suggestedFilename();
    };
    await page.click('[role=tab]:nth-child(2)');
    check('without a model there is nothing to save', same(await page.isDisabled('#model-send [data-send=save]'), true, 'disabled'));
    await page.setInputFiles('#model-files', [`${folder}/box.obj`]);
    for (const [board, isa, image] of SENT) {
        await page.selectOption('#model-board', { index: await page.evaluate((name) => [...document.getElementById('model-board').options].findIndex(({ text }) => text.startsWith(`${name},`)), board) });
        await ready();
        check(`${image}: cores are asked for where there are two kinds`, same(await page.isVisible('#model-send [data-send=isa]'), isa !== '', 'visible'));
        if (isa !== '') {
            await page.selectOption('#model-send [data-send=isa]', isa);
        }
        await saved('#model-save', `${image}.phs`);
        const name = await saved('#model-send [data-send=save]', `${image}.uf2`);
        check(`${image}: image and scene are saved as one UF2 file`, same(name, `${image}-box.uf2`, 'file'));
    }
    await page.selectOption('#model-board', { label: 'rpi-waveshare-1in3, 240x240' });
    check('a board without a boot loader gets none', same(await page.isDisabled('#model-send [data-send=save]'), true, 'disabled'));
    await page.click('[role=tab]:nth-child(1)');
    await page.evaluate(() => window.show('#board=waveshare-pico-lcd-1in3&demo=cube&frame=0'));
    await page.click('#kit-send [data-send=save]');
    await page.waitForSelector('#kit-send .wrong');
    check('an image that is not there is one line', same(await page.textContent('#kit-send .wrong'),
        'kits/waveshare-pico-lcd-1in3.js is not beside this page: make page-kits BOARD=waveshare-pico-lcd-1in3', 'said'));
    await page.context().close();
}

async function flashes({ browser, open, check, folder }, fault, pattern, work = async () => {}) {
    const page = await open(browser, {}, undefined, [playBoard, fault]);
    await page.click('#kit-send [data-send=flash]');
    await work(page);
    await page.waitForFunction(() => document.querySelector('#kit-send [data-send=stop]').hidden && !document.querySelector('#kit-send [data-send=flash]').disabled, null, { timeout: 60000 });
    const said = await page.textContent('#kit-send [data-send=said]');
    check(`Flash, ${fault || 'a board'}: ${pattern}`, same(pattern.test(said), true, said));
    if (fault === '') {
        const held = await page.evaluate(async (n) => [...window.boardFlash.subarray(0, n)].join(), 4096);
        check('... its flash holds the image, and it was started', [...same(held, [...readFileSync(`${folder}/image.bin`).subarray(0, 4096)].join(), 'bytes'),
            ...same(await page.evaluate(() => window.boardStarted), true, 'started')]);
    }
    await page.context().close();
}

export async function useSend(test) {
    await saves(test);
    await flashes(test, '', /^RP2040: \d+ bytes written, read back and equal, started$/);
    await flashes(test, 'slow', /^RP2040: stopped before \w+ 0x10[0-9a-f]{6}; the board stays in its boot loader: run this again$/, async (page) => {
        await page.waitForFunction(() => window.boardWrote > 2);
        await page.click('#kit-send [data-send=stop]');
    });
    await flashes(test, 'none', /^no RP2040 in its boot loader \(2e8a:0003\) on USB; plug it in with BOOTSEL held, /);
    await flashes(test, 'hang', /^RP2040: no answer for 3 s while \w+ 0x10[0-9a-f]{6}; pull it out, plug it in with BOOTSEL held and run this again$/);
    await flashes(test, 'stall', /^RP2040: the board refuses writing 0x10001000 \(no reason given\); pull it out, plug it in with BOOTSEL held and run this again$/);
    await flashes(test, 'pulled', /^RP2040: unplugged while \w+ 0x10[0-9a-f]{6}; plug it in with BOOTSEL held and run this again$/);
}
