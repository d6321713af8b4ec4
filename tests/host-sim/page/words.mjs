// Usage: node words.mjs MODULE.wasm
// Does in the page's module what pinhole-sim does with the options that lines of stdin have, and prints what it prints: what is
// asked for, a message on a line with # before it, and what --crc prints.
import { readFileSync } from 'node:fs';
import { startCore } from '../../../host-sim/page/page_core.mjs';

const core = await startCore(readFileSync(process.argv[2]));
for (const line of readFileSync(0, 'utf8').trim().split('\n')) {
    const { drawn, text, wrong } = core.run([...line.split(' '), '--crc']), frame = /--start (\d+)/.exec(line)?.[1] ?? 0;
    process.stdout.write(text + (drawn ? `frame ${frame} crc32 ${core.crc()}\n` : '') + (wrong === '' ? '' : `${wrong.replace(/^/gm, '# ')}\n`));
}
