// send: the part "To the kit" of a tab, which saves the kit's image as a UF2 file, or writes it into a kit by USB. The images
// stand beside the page, as scripts, because a page that was opened from a file may load those, and nothing else.
import { saveFile, unpack } from './page_files.mjs';
import { chooseBoard } from './page_usb.mjs';

const chips = JSON.parse(document.getElementById('kits').textContent); // by board

// Resolves to { uf2, flash }, or to { wrong }.
async function loadKit(name) {
    if (globalThis.pinholeKits?.[name] === undefined) {
        const script = document.createElement('script');
        script.src = `kits/${name}.js`;
        const loaded = await new Promise((done) => {
            script.onload = () => done(true);
            script.onerror = () => done(false);
            document.head.append(script);
        });
        script.remove();
        if (!loaded) {
            return { wrong: `kits/${name}.js is not beside this page: make page-kits BOARD=${name.replace(/-riscv$/, '')}` };
        }
    }
    const { uf2, flash } = globalThis.pinholeKits[name];
    return { uf2: await unpack(uf2), flash };
}

// Fills the element. board() is the name of the board that is chosen; scene() is { name, bytes } that goes with the image, or
// null to wait for. flasher() resolves to what startFlash() of page_flash.mjs gives. Returns update(), to be called after
// another board or scene was chosen.
export function openSend(element, { board, scene, flasher }) {
    element.append(document.getElementById('send').content.cloneNode(true));
    const part = (name) => element.querySelector(`[data-send=${name}]`);
    let job = null; // the flasher that writes
    const say = (text, wrong = false) => {
        part('said').textContent = text;
        part('said').classList.toggle('wrong', wrong);
    };
    const update = () => {
        const chip = chips[board()];
        part('cores').hidden = chip !== 'rp2350';
        part('save').disabled = part('flash').disabled = chip === undefined || scene() === null || job !== null;
        part('none').hidden = chip !== undefined;
        part('stop').hidden = part('progress').hidden = job === null;
    };
    const name = () => (chips[board()] === 'rp2350' && part('isa').value === 'riscv' ? `${board()}-riscv` : board());
    // Resolves to { flash, uf2 } of the image with the scene, or to { wrong }.
    const make = async () => {
        const { uf2, flash, wrong } = await loadKit(name());
        if (wrong !== undefined) {
            return { wrong };
        }
        const worker = await flasher();
        return { worker, ...worker.join(uf2, scene().bytes, flash) };
    };
    const save = async () => {
        const file = `${name()}-${scene().name}.uf2`, { uf2, wrong } = await make();
        if (wrong !== undefined) {
            say(wrong, true);
        } else {
            saveFile(file, [uf2], 'application/octet-stream');
            say(`${file}: copy it onto the drive of the boot loader, RPI-RP2 or RP2350`);
        }
    };
    const flash = async () => {
        if (navigator.usb === undefined) {
            say('this browser has no WebUSB, as Chromium and its kin have: Save UF2, and copy the file onto the drive of the boot loader', true);
            return;
        }
        const chip = chips[board()], making = make();
        const device = await chooseBoard(navigator.usb, chip).catch(() => null); // now, while the click counts
        const { worker, wrong } = await making;
        if (wrong !== undefined || device === null) {
            say(wrong ?? worker.nobody(chip), true);
            return;
        }
        job = worker;
        update();
        const result = await worker.write(device, chip, ({ what, done, all }) => {
            part('progress').value = done / all;
            say(what);
        });
        say(result.done ?? result.wrong, result.wrong !== undefined);
    };
    const during = (work) => async () => {
        say('');
        part('save').disabled = part('flash').disabled = true;
        await work().catch((error) => say(`this page failed: ${error.message}`, true));
        job = null;
        update();
    };
    part('save').addEventListener('click', during(save));
    part('flash').addEventListener('click', during(flash));
    part('stop').addEventListener('click', () => job.stop());
    update();
    return update;
}
