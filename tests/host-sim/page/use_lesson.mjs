// use_lesson: tries the tab Lesson as its users do, and compares its numbers and pixels with pinhole-sim; see browser.mjs.
import { execFileSync, spawnSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { exercises } from '../../../host-sim/page/lesson/lesson_exercises.mjs';
import { answersOf, textOf } from './exercise_answers.mjs';

const built = process.env.B ?? 'build';
const same = (is, must, what) => (String(is) === String(must) ? [] : [`${what}: ${is}, not ${must}`]);
const STATES = ['demo=cube&size=200x100&fov=90&near=2&far=10&camera=eye=0,0,5&point=1,2,-1&frustum=2,2',
    'demo=cube&size=120x90&projection=ortho&near=1&far=9&camera=eye=1.5,2,4,target=0,0,-3&point=0.1,0.7,-2&convention=d3d',
    'demo=cube&size=96x96&convention=lmu&near=-2&far=-10&fov=61.7&camera=ypr=20,-10,5,eye=1,1,2&point=.3,.4,-3',
    'demo=cube&size=96x64&projection=frustum=-1,3,-1,2&near=2&far=12&camera=vrp=1,2,3,vpn=.2,.3,1&flatten=plane=0,0,1,2&point=1,1,-3'];

// What pinhole-sim prints as a sorted list of `label: number...`; of several cameras the first.
function numbersOf(text) {
    const list = [];
    let matrix = '', row = 0;
    for (const line of text.split(/^camera 2 of .*$/m)[0].trim().split('\n')) {
        const words = line.split(' ');
        if (words.length === 1) {
            [matrix, row] = [line, 0];
        } else if (words.length === 3 && line.startsWith('depth.')) {
            list.push(`${words[0]}: ${['', words[2], words[1], ''].join(' ')}`);
        } else if (/^[-.\d]/.test(line)) {
            list.push(...words.map((word, i) => `${matrix}.${row}.${i}: ${word}`));
            row++;
        } else if (!/^(frame|camera) /.test(line)) {
            list.push(`${words[0]}: ${words.slice(1).join(' ')}`);
        }
    }
    return list.sort();
}

// Runs the command that the page shows. Returns { numbers, crc, said }.
function runTool(command) {
    const { stdout, stderr } = spawnSync(`${built}/pinhole-sim`, command.split(' ').slice(1), { encoding: 'utf8' });
    return { numbers: numbersOf(stdout), crc: /crc32 (\w+)/.exec(stdout)?.[1] ?? '', said: stderr.trim().replaceAll(/^pinhole-sim: /gm, '').replaceAll('\n', '; ') };
}

// Runs in the page: everything that the lesson shows. The address follows a change after a tenth of a second.
async function readLesson() {
    await new Promise((done) => setTimeout(done, 150));
    const plain = (text) => text.replaceAll('\u2212', '-'), of = (id) => document.getElementById(`lesson-${id}`);
    const rows = [...document.querySelectorAll('#lesson tr[data-label]')].map((row) => [row.dataset.label, [...row.cells].slice(1).map((cell) => plain(cell.textContent)).join(' ')]);
    const cells = [...document.querySelectorAll('#lesson .lesson-matrix [data-label]')].filter((cell) => !/^(turn|move)\./.test(cell.dataset.label) && cell.offsetParent !== null)
        .map((cell) => [cell.dataset.label, plain(cell.value ?? cell.textContent)]);
    return { numbers: [...rows, ...cells].filter(([, text]) => text !== '').map(([label, text]) => `${label}: ${text}`).sort(), said: of('said').textContent,
        command: of('command').textContent, code: of('code').textContent, cross: of('cross').hidden ? null : [parseFloat(of('cross').style.left), parseFloat(of('cross').style.top)], crc: window.painted(document.querySelector('#lesson-glass canvas')), hash: location.hash };
}

// Opens a state by its address.
async function show(page, options) {
    await page.evaluate((to) => {
        if (location.hash === to) {
            return null;
        }
        document.getElementById('lesson-command').textContent = '';
        return window.show(to);
    }, `#tab=lesson&${options}`);
    await page.waitForFunction(() => document.getElementById('lesson-command').textContent !== '');
    return page.evaluate(readLesson);
}

// typed: matrices whose cells keep what was typed, and are not compared.
function compareTool(shown, typed = []) {
    const { numbers, crc, said } = runTool(shown.command), compared = (list) => list.filter((line) => !typed.some((name) => line.startsWith(`${name}.`) && /\.\d\.\d/.test(line)));
    const is = compared(shown.numbers), must = compared(numbers);
    return [...is.filter((line) => !must.includes(line)).map((line) => `only on the page: ${line}`), ...must.filter((line) => !is.includes(line)).map((line) => `only of the tool: ${line}`),
        ...same(shown.crc, crc, 'crc32'), ...same(shown.said.replace(/(; )?--(matrix|point)[:,] .*/, ''), said, 'said'), ...(must.length > 0 || !shown.command.includes('--matrix ') ? [] : ['no numbers'])];
}

// The cross stands at the pixel that is printed; LMU counts lines upwards.
function compareCross({ cross, numbers, command }) {
    const [width, height] = /--size (\d+)x(\d+)/.exec(command).slice(1).map(Number), of = (label) => +numbers.find((line) => line.startsWith(`${label}: `))?.split(' ')[2];
    const must = [of('pixel.x') / width, command.includes('lmu') ? 1 - of('pixel.y') / height : of('pixel.y') / height].map((share) => share * 100);
    const inside = must.every((share) => share >= 0 && share <= 100);
    return inside ? same(cross?.map((share) => share.toFixed(2)), must.map((share) => share.toFixed(2)), 'cross') : same(cross, null, 'cross');
}

// Each convention has other numbers, and the same pixels.
async function conventions(page, check, options, what) {
    await show(page, options);
    const seen = [];
    for (const convention of ['gl', 'd3d', 'lmu', 'reversed']) {
        await page.selectOption('#lesson-convention', convention);
        seen.push(await page.evaluate(readLesson));
    }
    check(`${what}: changing the convention moves no pixel, and changes the numbers`, [...same(new Set(seen.map(({ crc }) => crc)).size, 1, 'pictures'),
        ...same(new Set(seen.map(({ numbers }) => numbers.join())).size, 4, 'sets of numbers'), ...seen.flatMap((one) => compareTool(one, options.includes('matrix') ? ['view', 'projection'] : []))]);
}

async function wrongMatrix(page, check) {
    const before = await show(page, STATES[0]);
    await page.fill('[data-label="projection.2.3"]', '5');
    await page.press('[data-label="projection.2.3"]', 'Enter');
    const wrong = await page.evaluate(readLesson);
    check('a matrix with a wrong sign is drawn, and explained as by the tool', [...compareTool(wrong, ['view', 'projection']),
        ...(/row 2, column 3 has the other sign/.test(wrong.said) ? [] : [`said: ${wrong.said}`]), ...(wrong.crc !== before.crc ? [] : ['the same picture'])]);
    await page.click('#lesson-lens-back');
    const back = await page.evaluate(readLesson);
    check('... and the lens comes back', [...same(back.crc, before.crc, 'crc32'), ...same(back.numbers, before.numbers, 'numbers')]);
    await page.fill('[data-label="view.0.3"]', '0.5');
    await page.press('[data-label="view.0.3"]', 'Enter');
    const moved = await page.evaluate(readLesson);
    check('a cell of the view moves the camera', [...compareTool(moved), ...(moved.crc !== before.crc ? [] : ['the same picture']), ...(moved.numbers.includes('view.0.3: 0.5') ? [] : ['no 0.5'])]);
}

async function lock(page, check) {
    const before = await show(page, 'demo=cube&size=100x100&fov=90&near=1&far=20&camera=eye=0,0,1,target=0,0,-3&frustum=4');
    await page.check('#lesson-lock');
    await page.fill('#lesson-distance-text', '2');
    await page.press('#lesson-distance-text', 'Enter');
    const after = await page.evaluate(readLesson), angle = +/--fov ([\d.]+)/.exec(after.command)[1];
    check('Hitchcock: half the distance is a field of view of 126.87 degrees', [...same(angle, 126.8699, 'fov'), ...(after.command.includes('eye=0,0,-1,') ? [] : [after.command]), ...compareTool(after), ...(before.crc !== after.crc ? [] : ['the same picture'])]);
    await page.uncheck('#lesson-lock');
}

export async function useLesson({ browser, open, check }) {
    const page = await open(browser);
    for (const options of STATES) {
        const shown = await show(page, options);
        check(`the lesson's numbers and pixels are those of pinhole-sim: ${options}`, [...compareTool(shown), ...compareCross(shown), ...same(new URLSearchParams(shown.hash.slice(1)).toString(), new URLSearchParams(`tab=lesson&${options}`).toString(), 'address')]);
    }
    const beside = await show(page, STATES[0].replace('point=1,2,-1', 'point=1,0,5'));
    check('a vertex beside the eye is told, and the picture is drawn', [...compareTool(beside), ...(/^--point: .* w is 0/.test(beside.said) && !beside.command.includes('--point') ? [] : [beside.said, beside.command])]);
    const bug = await show(page, 'demo=cube&size=96x96&projection=fisheye&fov=170&camera=eye=0,0,0,target=0,0,-3&point=1,1,-2&show=depth');
    check('a fisheye is drawn, and so is its depth buffer; it has its numbers', [...compareTool(bug), ...compareCross(bug), ...(bug.numbers.some((line) => line.startsWith('angle.degrees: ')) ? [] : bug.numbers)]);
    const demo = await show(page, 'demo=fisheye&size=96x96&point=1,-2,-2');
    check('a demo\'s own fisheye, too', [...compareTool(demo), ...compareCross(demo), ...(demo.numbers.some((line) => line.startsWith('angle.degrees: ')) ? [] : demo.numbers)]);
    await conventions(page, check, STATES[0], 'a perspective');
    await wrongMatrix(page, check);
    await lock(page, check);
    await page.context().close();
}

// The lines of C, in a program that prints their matrices and the vertex in clip coordinates, which must be those on the page. A
// world whose typed matrix is left-handed is mirrored: its z is the other way in Pinhole's own world.
async function sources(page, check, folder) {
    const typed = ['demo=cube&size=96x64&view-matrix=0.6,0,0.8,-1,0,1,0,0.5,-0.8,0,0.6,-4,0,0,0,1&projection-matrix=1.5,0,0.25,0,0,2,0,0,0,0,-1.5,-5,0,0,-1,0&anyway=on&point=0,0,0',
        'demo=cube&size=96x64&convention=d3d&fov=90&near=1&far=9&view-matrix=1,0,0,0,0,1,0,0,0,0,1,5,0,0,0,1&anyway=on&point=1,.5,-2',
        'demo=cube&size=96x64&convention=d3d&camera=quat=1,.2,.3,0,eye=1,0,4&projection-matrix=.25,0,0,.5,0,.5,0,0,0,0,.125,-.25,0,0,0,1&anyway=on&point=0,0,0', `${STATES[0]}&focal=-1.5`.replace('fov=90&', '')];
    for (const options of [...STATES, ...typed]) {
        const { code, numbers, said } = await show(page, options), source = `${folder}/lesson.c`;
        writeFileSync(source, `#include "camera.h"\n#include "render.h"\n#include <stdio.h>\nint main(void)\n{\n    static struct ph_renderer renderer;\n${code}\n    for (int i = 0; i < 32; i++) { printf("%s.%d.%d %.0f\\n", i < 16 ? "view" : "projection", i / 4 % 4, i % 4, (double)(i < 16 ? &V : &P)->m[i / 4 % 4][i % 4]); }\n    printf("clip %d %d %d %d\\n", (int)clip.x, (int)clip.y, (int)clip.z, (int)clip.w);\n    return 0;\n}\n`);
        const made = spawnSync('cc', ['-std=c11', '-Wall', '-Werror', '-Ifirmware/core', '-Ifirmware/core/kernels/portable', source, `${built}/libpinhole.a`, '-o', `${folder}/lesson`], { encoding: 'utf8' });
        const printed = made.status === 0 ? execFileSync(`${folder}/lesson`, { encoding: 'utf8' }).trim().split('\n') : [];
        const clip = printed.pop()?.split(' ').slice(1) ?? [], left = /d3d.*view-matrix/.test(options);
        const must = numbers.filter((line) => /^(view|projection)\.\d\.\d/.test(line))
            .map((line) => line.replace(/: (.*)/, (_, number) => ` ${(left && /^view\.\d\.2/.test(line) ? -1 : 1) * Math.round(number * 65536) || 0}`));
        const far = numbers.filter((line) => /^clip\.[wxyz]:/.test(line)).filter((line) => Math.abs(clip['xyzw'.indexOf(line[5])] - line.split(' ')[3]) > 2);
        check(`the lines of C make the camera of ${options}`, [...(made.status === 0 ? [] : [made.stderr]), ...same(printed.sort(), must.sort(), 'matrices'), ...same(far, '', `clip ${clip}`), ...same(numbers.filter((line) => line.startsWith('clip.')).length, 4, 'clip'), ...same(said, '', 'said')]);
    }
}

// A world of the other hand: back to a camera the picture is the same, and a vertex is dragged in its object's coordinates.
async function hands(page, check) {
    const left = await show(page, 'demo=cube&size=96x64&convention=d3d&fov=90&near=1&far=9&view-matrix=1,0,0,-0.5,0,1,0,-1,0,0,1,2,0,0,0,1&anyway=on&object=1,0,0&point=0,0,-1');
    await page.click('#lesson-view-back');
    const back = await page.evaluate(readLesson);
    check('a left-handed world has a camera with the same picture', [...compareTool(left), ...compareTool(back), ...same(back.crc, left.crc, 'crc32'), ...(back.command.includes('--camera') ? [] : [back.command])]);
    const place = ({ numbers }) => numbers.filter((line) => /^(object|world)\.[xyz]: /.test(line)).map((line) => line.split(' ')[2]);
    const before = place(await show(page, 'demo=cube&size=96x64&camera=eye=0,0,5&object=1,0,0,target=2,0,0&point=0,0,2'));
    await page.focus('[data-handle=point]');
    await page.keyboard.press('ArrowRight');
    const after = place(await page.evaluate(readLesson)), moved = after.map((number, i) => Math.round((number - before[i]) * 1000) / 1000);
    check('a vertex of an object is moved in the world', same(moved, '0,0,0.125,0.125,0,0', 'moved'));
}

async function moves(page, check) {
    const before = await show(page, STATES[0]);
    for (const handle of ['eye', 'target', 'point']) {
        await show(page, STATES[0]);
        const box = await page.locator(`[data-handle=${handle}]`).boundingBox(), at = [box.x + box.width / 2, box.y + box.height / 2];
        await page.mouse.move(...at);
        await page.mouse.down();
        await page.mouse.move(at[0] + 30, at[1] - 20, { steps: 3 });
        await page.mouse.up();
        const dragged = await page.evaluate(readLesson);
        const height = (hash) => +new RegExp(handle === 'point' ? 'point=[^,]*,([^,&]*)' : `${handle}=[^,]*,([^,&]*)`).exec(hash)?.[1];
        check(`${handle} is dragged, upwards`, [...compareTool(dragged), ...(height(dragged.hash) > (height(before.hash) || 0) ? [] : [`${before.hash} ${dragged.hash}`])]);
        await page.focus(`[data-handle=${handle}]`);
        await page.keyboard.press('PageUp');
        const pressed = await page.evaluate(readLesson);
        check('... and moved by a key', [...compareTool(pressed), ...(pressed.hash !== dragged.hash ? [] : ['nothing moved'])]);
    }
    await show(page, STATES[0]);
    const glass = await page.locator('#lesson-glass canvas').boundingBox();
    await page.mouse.move(glass.x + 20, glass.y + 20);
    await page.mouse.down();
    await page.mouse.move(glass.x + 60, glass.y + 20, { steps: 3 });
    await page.mouse.up();
    const around = await page.evaluate(readLesson), eye = /eye=([-.\d]+),([-.\d]+),([-.\d]+)/.exec(around.command).slice(1).map(Number);
    check('a drag on the glass to the right goes around to the left, and keeps the distance', [...compareTool(around), ...(eye[0] < -0.5 && Math.abs(Math.hypot(...eye) - 5) < 0.01 ? [] : [around.command])]);
    const pixels = () => page.evaluate(() => window.painted(document.querySelector('#lesson-world canvas')));
    const world = await pixels();
    await page.evaluate(() => {
        document.getElementById('lesson-morph').value = 1;
        document.getElementById('lesson-morph').dispatchEvent(new Event('input'));
    });
    check('the slider makes a cube of the frustum', await pixels() !== world ? [] : ['the world stays']);
}

// How long a step of a slider takes until its picture is there: by the clock, and of the page's thread alone, on a busy machine.
async function speed(page, check) {
    await show(page, 'demo=cube&size=240x180&fov=60&near=2&far=10&camera=eye=0,3,1,target=0,0,-3&point=1,1,-2');
    const session = await page.context().newCDPSession(page), steps = 40;
    await session.send('Performance.enable', { timeDomain: 'threadTicks' });
    const busy = async () => (await session.send('Performance.getMetrics')).metrics.find(({ name }) => name === 'TaskDuration').value * 1000;
    const before = await busy();
    const times = await page.evaluate(async (count) => {
        const slider = document.getElementById('lesson-fov'), list = [];
        for (let i = 0; i < count; i++) {
            const from = performance.now();
            slider.value = 40 + i;
            slider.dispatchEvent(new Event('input'));
            list.push(performance.now() - from);
            await new Promise(requestAnimationFrame);
        }
        return list.sort((a, b) => a - b);
    }, steps);
    const thread = (await busy() - before) / steps;
    console.log(`# slider to picture: ${thread.toFixed(1)} ms of the page's thread, with layout and paint; by the clock ${times[0].toFixed(1)} at best, ${times[steps / 2].toFixed(1)} in the middle (aim: 33)`);
    check('the picture is the last step\'s of the slider', compareTool(await page.evaluate(readLesson)));
}

// The runs and things of lesson.txt, each label read on the page.
async function walk(page, check) {
    const lines = readFileSync('tests/host-sim/lesson.txt', 'utf8').split('\n'), runs = new Map();
    for (const [, name, text] of lines.map((line) => /^\$ (\S+)\s+(.*)/.exec(line)).filter((match) => match !== null)) {
        const options = [...text.matchAll(/--([a-z-]+) ([^-]\S*|-[\d.]\S*)/g)].filter(([, option]) => option !== 'matrix').map(([, option, value]) => `${option}=${value}`);
        const shown = await show(page, options.join('&')), typed = text.includes('-matrix ') ? ['view', 'projection'] : [];
        const faults = compareTool(shown, typed);
        runs.set(name, { faults, labels: new Map(shown.numbers.map((line) => line.split(': '))) });
    }
    const things = [];
    for (const line of lines) {
        const title = /^([A-Z0-9]+ \d+) \|/.exec(line)?.[1];
        if (title !== undefined) {
            things.push({ title, faults: [], values: new Map() });
        }
        const [, run, label] = /^    (\S+) (\S+) [=~#^]/.exec(line) ?? [];
        if (run !== undefined) {
            const thing = things.at(-1), value = runs.get(run).labels.get(label);
            thing.faults.push(...(value === undefined ? [`${run} has no ${label}`] : []), ...runs.get(run).faults);
            thing.values.set(label, [...(thing.values.get(label) ?? []), value]);
        }
    }
    const bad = things.filter(({ faults, values }) => faults.length > 0 || ![...values.values()].some((list) => new Set(list).size > 1));
    check(`${things.length - bad.length} of the ${things.length} things of lesson.txt are changed and read on the page`,
        [...same(things.length, 55, 'things'), ...bad.flatMap(({ title, faults }) => [`${title}: ${faults[0] ?? 'no label has two values'}`])]);
}

// A student reads the task, types a typical mistake, then the answers that were worked out from the task's words; asks for other
// numbers, and sees them above.
async function answers(page, check, { id, title }) {
    const body = page.locator('#lesson-exercises details', { has: page.getByText(title, { exact: true }) }).locator('form'), faults = [];
    await page.locator('#lesson-exercises summary', { hasText: title }).click();
    const task = async () => {
        const text = await body.locator('.lesson-task').textContent(), labels = (await body.locator('label').allTextContents()).map((label) => label.trim());
        return { text, all: text + labels, ...answersOf[id](text, labels) };
    };
    const answer = async (texts) => {
        for (const [i, text] of texts.entries()) {
            await body.locator('input').nth(i).fill(text);
        }
        await body.getByText('Check').click();
        return body.locator('.said').allTextContents();
    };
    const first = await task(), right = first.answers.map(textOf), [part, value, pattern] = first.wrongs.find((wrong) => wrong[1] !== null && textOf(wrong[1]) !== right[wrong[0]]);
    const mistaken = await answer(right.map((text, i) => (i === part ? textOf(value) : text)));
    faults.push(...mistaken.flatMap((said, i) => (i === part ? (pattern.test(said) ? [] : [`to ${textOf(value)}: ${said}`]) : same(said, 'right', 'the others'))));
    faults.push(...same((await body.locator('.said').nth(part).getAttribute('class')), 'said wrong', 'class'));
    faults.push(...same(await answer(right), right.map(() => 'right'), 'said'));
    await body.getByText('Other numbers').click();
    const other = await task();
    faults.push(...(other.all === first.all ? ['the numbers stay'] : []), ...same((await body.locator('.said').allTextContents()).join(''), '', 'said of other numbers'),
        ...same(await answer(other.answers.map(textOf)), right.map(() => 'right'), 'said of other answers'));
    const above = body.getByText('Show it above');
    if (await above.count() > 0) {
        const before = await page.evaluate(() => location.hash);
        await above.click();
        await page.waitForFunction((hash) => location.hash !== hash, before);
        faults.push(...compareTool(await page.evaluate(readLesson)).slice(0, 3));
    }
    check(`exercise ${title}: a mistake has its word, right answers are right, other numbers come`, faults);
}

// A finger drags the vertex, on a small screen.
async function fingers({ browser, open, check }) {
    const page = await open(browser, { viewport: { width: 360, height: 700 }, hasTouch: true }), before = await show(page, STATES[0]);
    const box = await page.locator('[data-handle=point]').boundingBox(), session = await page.context().newCDPSession(page);
    const touch = (type, ...ways) => session.send('Input.dispatchTouchEvent', { type, touchPoints: ways.map((way) => ({ x: box.x + box.width / 2 + way, y: box.y + box.height / 2 + way })) });
    await touch('touchStart', 0);
    await touch('touchMove', 10);
    await touch('touchMove', 20);
    await touch('touchEnd');
    const after = await page.evaluate(readLesson);
    check('a finger drags the vertex', [...compareTool(after), ...(after.hash !== before.hash ? [] : ['nothing moved']), ...same(await page.evaluate(() => scrollY), 0, 'scrolled')]);
    check('everything of the lesson to click or to type in has a name', await page.evaluate(() => [...document.querySelectorAll('#lesson :is(button, select, input, canvas, [tabindex])')]
        .filter((element) => !(element.getAttribute('aria-label') || (element.matches('select, input') ? element.labels[0] : element)?.textContent.trim())).map((element) => element.outerHTML)));
    await page.context().close();
}

async function looks({ browser, open, check, folder }) {
    for (const width of [360, 800, 1440]) {
        for (const colorScheme of ['light', 'dark']) {
            const page = await open(browser, { viewport: { width, height: 800 }, colorScheme });
            await show(page, STATES[3]);
            check(`the lesson on ${width} pixels, ${colorScheme}: nothing is wider`, same(await page.evaluate(() => document.documentElement.scrollWidth), width, 'width'));
            await page.screenshot({ path: `${folder}/lesson-${width}-${colorScheme}.png`, fullPage: true });
            await page.context().close();
        }
    }
}

export async function useLessonMore(test) {
    const { browser, open, check, folder } = test, page = await open(browser);
    await sources(page, check, folder);
    await hands(page, check);
    await moves(page, check);
    await speed(page, check);
    await conventions(page, check, STATES[1], 'in parallel');
    await conventions(page, check, STATES[2], 'planes as coordinates');
    await conventions(page, check, 'demo=cube&size=96x64&view-matrix=1,0,0,0,0,1,0,0,0,0,1,-1,0,0,0,1&projection-matrix=1,0,0,0,0,1.5,0,0,0,0,-1.5,-5,0,0,-1,0&anyway=on&point=0,0,-2', 'typed matrices');
    await walk(page, check);
    for (const exercise of exercises) {
        await answers(page, check, exercise);
    }
    await looks(test);
    await fingers(test);
    await page.context().close();
}
