// Usage: node browser.mjs NODE_MODULES PAGE.html EXPECTED [FOLDER USE...]
// Opens the page in Debian's Chromium and compares what its canvas shows: EXPECTED has lines `board demo frame crc32`. Then
// the page's use is tried: each USE is a name of `uses` below, and FOLDER has what it needs. Speaks TAP.
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { use, useMore } from './use.mjs';
import { useLesson, useLessonMore } from './use_lesson.mjs';
import { useModel, useModelMore } from './use_model.mjs';
import { useSend } from './use_send.mjs';

const uses = { kit: use, looks: useMore, model: useModel, models: useModelMore, send: useSend, lesson: useLesson, lessons: useLessonMore, host };
const [modules, page_file, expected, folder, ...wanted] = process.argv.slice(2);
const { chromium } = createRequire(resolve(modules) + '/')('playwright-core');
const address = pathToFileURL(resolve(page_file)).href;
const wrong = [];
let tests = 0, failed = 0;

function check(name, faults) {
    tests++;
    failed += faults.length > 0;
    console.log(`${faults.length > 0 ? 'not ok' : 'ok'} ${tests} - ${name}`);
    faults.slice(0, 20).forEach((fault) => console.log(`# ${fault}`));
}

// A page whose requests are all refused, but for its own file, and kept; as are messages on its console.
// before: a function that runs in it first, and its argument.
async function open(browser, options = {}, at = address, before = null) {
    const context = await browser.newContext({ viewport: { width: 1000, height: 800 }, ...options });
    await context.route('**', (route) => {
        const url = route.request().url().replace(/#.*/, '');
        const is_kit = url.startsWith(at.replace(/[^/]*$/, 'kits/')); // images, beside the page
        if (url !== at && !is_kit && !url.startsWith('blob:') && !url.startsWith('data:')) {
            wrong.push(`asks for ${url.slice(0, 200)}`);
            return route.abort();
        }
        return route.continue();
    });
    const page = await context.newPage();
    page.on('console', (message) => message.text().includes('ERR_FILE_NOT_FOUND') || wrong.push(`console: ${message.text()}`)); // of an image
    page.on('pageerror', (error) => wrong.push(`error: ${error.message}`));
    page.on('websocket', (socket) => wrong.push(`asks for ${socket.url()}`));
    if (before !== null) {
        await page.addInitScript(...before);
    }
    await page.goto(`${at}#board=pico-display&demo=cube&frame=0`);
    await page.waitForSelector('dd[data-name=crc32]');
    await page.evaluate(tools);
    return page;
}

// Runs in the page: show(hash) opens an address; seen() is [frame, crc32 that the page tells, crc32 of its canvas].
function tools() {
    const table = Array.from({ length: 256 }, (_, n) => {
        for (let k = 0; k < 8; k++) {
            n = n & 1 ? 0xEDB88320 ^ (n >>> 1) : n >>> 1;
        }
        return n >>> 0;
    });
    const copy = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
    window.painted = (canvas) => {
        const { width, height } = Object.assign(copy.canvas, { width: canvas.width, height: canvas.height });
        copy.drawImage(canvas, 0, 0);
        const { data } = copy.getImageData(0, 0, width, height);
        let crc = 0xFFFFFFFF;
        for (let i = 0; i < data.length; i++) {
            crc = i % 4 === 3 ? crc : table[(crc ^ data[i]) & 255] ^ (crc >>> 8);
        }
        return ((crc ^ 0xFFFFFFFF) >>> 0).toString(16).toUpperCase().padStart(8, '0');
    };
    window.seen = () => [document.getElementById('frame').value, document.querySelector('dd[data-name=crc32]').textContent,
        window.painted(document.querySelector('canvas'))];
    window.said = () => document.getElementById('said').textContent;
    window.show = (hash) => new Promise((done) => {
        if (location.hash === hash) {
            return done();
        }
        window.addEventListener('hashchange', () => done(), { once: true });
        location.hash = hash;
    });
}

// Compares one demo on one board: frame 0 by its address, those that follow by the button Step, others by address.
async function compare(page, board, demo, rows) {
    const faults = [];
    for (const { frame, crc } of rows) {
        const [number, told, painted] = await page.evaluate(async ([hash, step]) => {
            await (step ? document.getElementById('step').click() : window.show(hash));
            return window.seen();
        }, [`#board=${board}&demo=${demo}&frame=${frame}`, frame > 0 && frame < 4]);
        if (number !== frame || told !== crc || painted !== crc) {
            faults.push(`${board} ${demo} ${frame} ${crc}, but the page: ${number} ${told} ${painted}`);
        }
    }
    return faults;
}

// The page on a host of static files.
async function host({ browser }) {
    const server = createServer((request, answer) => {
        if (request.url !== '/kit/') {
            wrong.push(`asks the host for ${request.url}`);
        }
        answer.setHeader('Content-Type', 'text/html');
        answer.end(readFileSync(page_file));
    });
    await new Promise((done) => server.listen(0, '127.0.0.1', done));
    const page = await open(browser, {}, `http://127.0.0.1:${server.address().port}/kit/`);
    const [, told, painted] = await page.evaluate(() => window.seen());
    check('a host of static files serves it', told === painted ? [] : ['another picture']);
    server.close();
    server.closeAllConnections();
}

const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox'] });
try {
    const page = await open(browser), kits = new Map();
    for (const line of readFileSync(expected, 'utf8').trim().split('\n').filter((row) => row !== '')) {
        const [board, demo, frame, crc] = line.split(' ');
        kits.set(board, kits.get(board) ?? new Map());
        kits.get(board).set(demo, [...(kits.get(board).get(demo) ?? []), { frame, crc }]);
    }
    for (const [board, demos] of kits) {
        const faults = [];
        for (const [demo, rows] of demos) {
            faults.push(...await compare(page, board, demo, rows));
        }
        check(`${board}: the page draws ${demos.size} demos as pinhole-sim does`, faults);
    }
    for (const name of wanted) {
        await uses[name]({ browser, open, check, folder });
    }
    check('no request leaves the page, and its console stays empty', wrong);
} catch (error) {
    check(`the page does not stop: ${error.message.split('\n')[0]}`, [error.stack]);
} finally {
    await browser.close();
}
console.log(`1..${tests}`);
process.exit(failed === 0 ? 0 : 1);
