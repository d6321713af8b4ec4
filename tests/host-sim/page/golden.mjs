// Usage: node golden.mjs MODULE.wasm FRAMES.txt
// Draws each frame that FRAMES.txt lists (tests/tools/frames.sh) by the page's module, and compares its CRC.
import { readFileSync } from 'node:fs';
import { startCore } from '../../../host-sim/page/page_core.mjs';

const [wasm, frames] = process.argv.slice(2);
const core = await startCore(readFileSync(wasm));
const named = (list, name) => list.findIndex((item) => item.name === name);
let opened = '', compared = 0, wrong = 0;
for (const line of readFileSync(frames, 'utf8').trim().split('\n')) {
    const [demo, kit, depth, , number, , crc] = line.split(' ');
    if (opened !== `${demo} ${kit} ${depth}`) {
        opened = `${demo} ${kit} ${depth}`;
        const size = /^(\d+)x(\d+)$/.exec(kit);
        const kind = size ? { width: +size[1], height: +size[2] } : { board: named(core.boards, kit) };
        if (!core.open({ ...kind, demo: named(core.demos, demo), depth: core.depths.indexOf(depth) })) {
            console.log(`${opened}: ${core.messages()}`);
        }
    }
    const drawn = core.frame(+number) ? core.crc() : core.messages();
    compared++;
    if (drawn !== crc) {
        wrong++;
        console.log(`${line}, but the page: ${drawn}`);
    }
}
console.log(`${compared} frames compared, ${wrong} differ`);
process.exit(wrong === 0 && compared > 0 ? 0 : 1);
