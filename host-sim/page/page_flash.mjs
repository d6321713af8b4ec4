// flash: image and scene as one UF2 file, and pinhole-flash's job over WebUSB, by the simulator's module (page_flash.h).
import { openBoard } from './page_usb.mjs';
import { makeWasi } from './page_wasi.mjs';

const CHIPS = { rp2040: 1, rp2350: 2 }; // enum flash_chip
const TRANSFERS = ['', 'out', 'in', 'commandStatus', 'reset']; // enum page_flash_want

export async function startFlash(wasm) {
    let calls = null;
    const { wasi, take } = makeWasi(() => calls.memory);
    const { instance } = await WebAssembly.instantiate(wasm, { wasi_snapshot_preview1: wasi });
    calls = instance.exports;
    calls._initialize();
    const said = () => take(2).trim().replace(/^pinhole: /, '');
    const why = (chip, status) => {
        calls.page_flash_why(CHIPS[chip], status);
        return said();
    };
    const put = (is_scene, bytes) => {
        const at = calls.page_flash_room(is_scene, bytes.length);
        new Uint8Array(calls.memory.buffer, at, at === 0 ? 0 : bytes.length).set(bytes);
    };
    const bytesOf = () => new Uint8Array(calls.memory.buffer, calls.page_flash_bytes(), calls.page_flash_size());
    return {
        nobody: (chip) => why(chip, 0),
        // Joins an image's UF2 file and a binary scene (or an empty one). Returns { uf2 }, or { wrong }.
        join(image, scene, flash_bytes) {
            put(0, image);
            put(1, scene);
            if (calls.page_flash_join(flash_bytes) !== 0) {
                return { wrong: said() };
            }
            return { uf2: new Uint8Array(calls.memory.buffer, calls.page_flash_uf2(), calls.page_flash_uf2_bytes()).slice() };
        },
        // Writes what was joined into the board, and tells({ what, done, all }) meanwhile. Resolves to { done } or { wrong }, a line.
        async write(device, chip, tell) {
            const board = await openBoard(device);
            if (board.status !== 0) {
                return { wrong: why(chip, board.status) };
            }
            calls.page_flash_begin();
            for (let want; (want = calls.page_flash_run()) !== 0;) {
                calls.page_flash_progress();
                tell(JSON.parse(take(1)));
                const { status, bytes } = await board[TRANSFERS[want]](bytesOf().slice());
                if (status === 0 && bytes !== undefined) {
                    bytesOf().set(bytes);
                }
                calls.page_flash_answer(status);
            }
            await board.close();
            const wrong = said();
            return wrong !== '' ? { wrong } : { done: take(1).trim() };
        },
        stop: () => calls.page_flash_stop(), // the job ends before its next command
    };
}
