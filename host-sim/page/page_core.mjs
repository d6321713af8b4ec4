// core: the simulator's module (page.h) as functions of JavaScript.

import { makeWasi } from './page_wasi.mjs';

const WORDS = 8192; // PAGE_WORDS of page.h

// Returns the lists of the simulator, and its calls. `messages` are lines that a program would print on stderr.
export async function startCore(bytes) {
    let calls = null;
    const { wasi, take } = makeWasi(() => calls.memory);
    const module = await WebAssembly.instantiate(bytes, { wasi_snapshot_preview1: wasi });
    calls = module.instance.exports;
    calls._initialize();
    calls.page_list();
    const lines = take(1).trimEnd().split('\n');
    const depths = JSON.parse(lines.pop());
    const { boards, demos } = JSON.parse(lines.join('\n'));
    return {
        boards,
        demos,
        depths,
        // board, demo, view and depth are indices of the lists; without a board it is a glass of width x height pixels.
        open({ board = -1, width = 240, height = 240, demo, view = 0, depth = 0 }) {
            return calls.page_open(board, width, height, demo, view, depth) === 0;
        },
        // Does what pinhole-sim does with these words (page_run of page.h). Returns { drawn, text, wrong }: whether there is a
        // picture, what it prints, and its messages.
        run(words) {
            const bytes = new TextEncoder().encode(words.map((word) => `${word}\0`).join('')), at = calls.page_words();
            if (bytes.length > WORDS) {
                return { drawn: false, text: '', wrong: 'these options are too long' };
            }
            new Uint8Array(calls.memory.buffer, at, WORDS).fill(0).set(bytes);
            const drawn = calls.page_run(words.length) === 0;
            return { drawn, text: take(1), wrong: take(2).trim().replace(/^pinhole: /gm, '') };
        },
        // Takes a binary scene, which demo number -1 shows from then on. Returns '' or what is wrong.
        scene(bytes) {
            const at = calls.page_scene_room(bytes.length); // the memory may have another buffer then
            if (at === 0) {
                return 'not enough memory for the scene';
            }
            new Uint8Array(calls.memory.buffer, at, bytes.length).set(bytes);
            return calls.page_scene() === 0 ? '' : take(2).trim();
        },
        frame: (number, buttons = 0) => calls.page_frame(number, buttons) === 0,
        drag: (right, down, notches) => calls.page_drag(right, down, notches),
        move: (turned, raised, away) => calls.page_move(turned, raised, away),
        moved: () => [calls.page_turned(), calls.page_raised(), calls.page_away()], // what move() takes to come here again
        demo: () => calls.page_demo(),
        crc: () => (calls.page_crc() >>> 0).toString(16).toUpperCase().padStart(8, '0'),
        stats(number) { // the keys are those of --stats --json
            calls.page_stats(number);
            return JSON.parse(take(2));
        },
        // The glass as it is now; rgb is valid until the next call.
        glass() {
            const width = calls.page_width(), height = calls.page_height();
            const rgb = new Uint8Array(calls.memory.buffer, calls.page_rgb(), width * height * 3);
            return { width, height, rgb, round: calls.page_round() === 1 };
        },
        messages: () => take(2).trim(),
    };
}
