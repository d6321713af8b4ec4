// Usage: node flash.mjs NODE_MODULES PAGE.wasm rp2040|rp2350 IMAGE.uf2 [SCENE.phs]
// Does what the page's button Flash does, with the page's own modules; WebUSB is that of npm's package `usb`, over libusb.
// Exit status: 0 done, 1 with a line; it says how many times the bar moved, too.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { resolve } from 'node:path';
import { startFlash } from '../../../host-sim/page/page_flash.mjs';
import { chooseBoard } from '../../../host-sim/page/page_usb.mjs';

const [modules, wasm, chip, image, scene] = process.argv.slice(2);
const { WebUSB } = createRequire(resolve(modules) + '/')('usb');
const flash = await startFlash(readFileSync(wasm));
const shown = new Set();
const { wrong } = flash.join(readFileSync(image), scene === undefined ? new Uint8Array() : readFileSync(scene), 2097152);
const device = await chooseBoard(new WebUSB({ allowAllDevices: true }), chip).catch(() => null);
const result = wrong !== undefined ? { wrong } : device === null ? { wrong: flash.nobody(chip) } :
    await flash.write(device, chip, ({ what, done, all }) => shown.add(`${what} ${done}/${all}`));
console.log(result.done ?? '', `${shown.size} steps`);
if (result.wrong !== undefined) {
    console.error(`page: ${result.wrong}`);
}
process.exit(result.wrong === undefined ? 0 : 1); // libusb's thread goes on
