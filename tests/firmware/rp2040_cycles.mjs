// node rp2040_cycles.mjs MODULES IMAGE.bin CHIP ADDRESS...    for test_rp2040_cycles.sh
// Runs an image in host-sim/emulate/rp2040 until core 0 has come to each address (hexadecimal) in turn, and prints the cycles
// between them. CHIP is the flash, of flash_chips.mjs.
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { makeMachine } from '../../host-sim/emulate/rp2040/machine.mjs';

const [modules, image, chip, ...addresses] = process.argv.slice(2);
const lib = {};
for (const file of ['rp2040.js', 'cortex-m0-core.js', 'sio.js', 'peripherals/ppb.js']) {
  Object.assign(lib, await import(resolve(modules, 'rp2040js/dist/esm', file)));
}
const machine = makeMachine(lib, { chip, warn(text) {
  console.log(text);
  process.exitCode = 1;
} });
const counts = [];
addresses.forEach((address) => machine.calls.set(parseInt(address, 16), () => counts.push(machine.mcu.core.cycles)));
machine.load(readFileSync(image));
machine.run(() => counts.length >= addresses.length);
console.log(counts.slice(1).map((count, i) => count - counts[i]).join(' '));
