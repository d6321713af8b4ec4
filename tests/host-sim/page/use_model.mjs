// use_model: tries the tab Model as its users do; see browser.mjs. FOLDER has models, and scenes that pinhole-asset made of
// them: made.glb, fit.phs and light.phs, ring.obj with its files (in the folder ring, too) and ring.phs, ring.triangles, ring.c, large.obj, boards, whole.crc; scene.crc is what pinhole-sim draws.
import { readFileSync, truncateSync, writeFileSync } from 'node:fs';

const same = (is, must, what) => (String(is) === String(must) ? [] : [`${what}: ${is}, not ${must}`]);

// A page on its tab Model, and what is done with it.
async function begin({ browser, open, folder }, hash) {
    const page = await open(browser);
    const text = (id) => page.evaluate((from) => document.getElementById(from).textContent, id);
    const ready = () => page.waitForFunction(() => document.getElementById('model-busy').hidden);
    const give = async (...names) => {
        await page.setInputFiles('#model-files', names.map((name) => `${folder}/${name}`));
        await page.waitForFunction(() => !document.getElementById('model-busy').hidden || document.getElementById('model-said').textContent !== '');
        await ready();
    };
    const saved = async (button, name) => {
        const [download] = await Promise.all([page.waitForEvent('download'), page.click(button)]);
        await download.saveAs(`${folder}/${name}`);
        return download.suggestedFilename();
    };
    const equal = (one, other) => (readFileSync(`${folder}/${one}`).equals(readFileSync(`${folder}/${other}`)) ? [] : [`${one} and ${other} differ`]);
    const crc = () => page.evaluate(() => document.querySelector('#model-facts dd').textContent);
    if (hash !== undefined) {
        await page.evaluate((to) => window.show(to), hash);
    }
    return { page, text, ready, give, saved, equal, crc };
}

export async function useModel(test) {
    const { check, folder } = test, { page, text, give, saved, equal, crc } = await begin(test);
    await page.click('#play');
    await page.click('[role=tab]:nth-child(2)');
    check('the kit pauses behind the tab Model', same(await text('play'), 'Play', 'button'));
    await give('made.glb');
    await saved('#model-save', 'made.saved');
    check('a GLB with textures becomes the bytes that pinhole-asset writes', [...same(await text('model-said'), '', 'said'), ...equal('made.saved', 'fit.phs')]);
    check('... and is drawn as pinhole-sim draws them', same(await crc(),
        readFileSync(`${folder}/scene.crc`, 'utf8').trim(), 'crc32'));
    check('... on every board of the table', same(await page.evaluate(() => document.querySelectorAll('#model-boards tr').length),
        await page.evaluate(() => document.getElementById('model-board').options.length), 'rows'));

    await page.fill('#model-background', '#336699');
    await page.waitForFunction(() => document.getElementById('model-busy').hidden);
    await page.selectOption('#model-light', { label: 'left' });
    await page.waitForFunction(() => document.getElementById('model-busy').hidden);
    await saved('#model-save', 'made.saved');
    check('... also before another background and in another light', [...same(await text('model-said'), '', 'said'), ...equal('made.saved', 'light.phs')]);
    await page.fill('#model-background', '#141a26');
    await page.selectOption('#model-light', { label: 'two lamps' });

    const glb = readFileSync(`${folder}/made.glb`);
    writeFileSync(`${folder}/short.glb`, glb.subarray(0, glb.length / 2));
    await give('short.glb');
    check('a broken model is one line', [...same((await text('model-said')).split('\n').length, 1, 'lines'),
        ...same(/^short\.glb: /.test(await text('model-said')), true, await text('model-said'))]);
    await page.click('#model-save-c');
    check('... after which there is no C scene to save', same(await text('model-said'), 'give the model again', 'said'));
    await give('ring.png');
    check('a picture is no model', same(await text('model-said'), 'no model among these files: OBJ, STL, PLY, glTF and GLB are', 'said'));
    await give('made.glb');
    await saved('#model-save', 'made.saved');
    check('... and the page goes on', [...same(await text('model-said'), '', 'said'), ...equal('made.saved', 'fit.phs')]);
    await page.context().close();
}

// Models that are broken, large or on their way; each costs one line, and then the page reads a good one.
async function faults(test) {
    const { check, folder } = test, { page, text, ready, give, saved, equal } = await begin(test, '#tab=model');
    const goesOn = async () => {
        await give('made.glb');
        await saved('#model-save', 'made.saved');
        return [...same(await text('model-said'), '', 'said'), ...equal('made.saved', 'fit.phs')];
    };
    await page.setInputFiles('#model-files', `${folder}/large.obj`);
    await page.waitForFunction(() => !document.getElementById('model-busy').hidden);
    await page.click('#model-cancel');
    check('a model that is being read is cancelled', same(await text('model-said'), 'cancelled: give the model again', 'said'));
    await page.waitForTimeout(500);
    check('... and does not come after that', [...same(await text('model-said'), 'cancelled: give the model again', 'said'), ...same(await page.isVisible('#model-busy'), false, 'busy'), ...await goesOn()]);

    const session = await page.context().newCDPSession(page);
    await page.locator('.drop').scrollIntoViewIfNeeded();
    const box = await page.locator('.drop').boundingBox();
    for (const type of ['dragEnter', 'dragOver', 'drop']) {
        await session.send('Input.dispatchDragEvent', { type, x: box.x + 20, y: box.y + 20, data: { items: [], files: [`${folder}/ring`], dragOperationsMask: 1 } });
    }
    await page.waitForFunction(() => /^ring: /.test(document.getElementById('model-need').textContent));
    await ready();
    check('a folder that is dropped gives its model with its textures', [...same(await text('model-said'), '', 'said'), ...same(await text('model-note'), '', 'note')]);

    truncateSync(`${folder}/huge.stl`, 2 ** 28 + 1);
    await give('huge.stl');
    check('files that are too large are one line', same(await text('model-said'), 'these files have 268435457 bytes, and the page takes 268435456', 'said'));
    const glb = readFileSync(`${folder}/made.glb`), wrong = [];
    let refused = 0;
    for (let i = 0; i < 24; i++) {
        const bytes = Buffer.from(glb);
        bytes.fill(i * 37, 20 + i * 61, 24 + i * 61); // in its JSON
        writeFileSync(`${folder}/broken.glb`, i % 4 === 3 ? bytes.subarray(0, 100 * i) : bytes);
        await give('broken.glb');
        const said = await text('model-said');
        refused += said !== '';
        wrong.push(...said.includes('\n') || said.includes('pinhole') ? [said] : []);
    }
    check('broken models are one line each', [...wrong, ...same(refused > 12, true, `${refused} of 24 are refused`)]);
    writeFileSync(`${folder}/many.gltf`, JSON.stringify({ asset: { version: '2.0' }, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }], meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
        accessors: [{ bufferView: 0, componentType: 5126, count: 1e9, type: 'VEC3' }], bufferViews: [{ buffer: 0, byteLength: 12e9 }], buffers: [{ byteLength: 12e9 }] }));
    await give('many.gltf');
    check('... and so is one that asks for 12 GB', [...same((await text('model-said')).split('\n').length, 1, 'lines'), ...same(/^many\.gltf: /.test(await text('model-said')), true, await text('model-said'))]);
    check('... and the page goes on', await goesOn());
    await page.context().close();
}

async function address(test) {
    const hash = '#tab=model&board=pico-display&up=z&filter=bilinear&texture-size=64&background=336699&light=left&turntable=on&two-sided=on&max-triangles=100';
    const { check } = test, { page, text, give } = await begin(test, hash);
    check('the address opens the tab Model', same(await page.isVisible('#model'), true, 'visible'));
    await give('ring.obj', 'ring.mtl', 'ring.png');
    check('... with what it says', [...same(await page.evaluate(() => ['up', 'filter', 'texture', 'light', 'board'].map((id) => document.getElementById(`model-${id}`).selectedOptions[0].text)), 'z,bilinear,64,left,pico-display, 240x135', 'choices'),
        ...same(await page.inputValue('#model-background'), '#336699', 'background'),
        ...same(await page.isChecked('#model-turntable'), true, 'turntable'), ...same(await page.isChecked('#model-two-sided'), true, 'two-sided'), ...same(/ of 1,152$/.test(await text('model-count')) && parseInt(await text('model-count'), 10) <= 100, true, await text('model-count'))]);
    check('... and keeps it', same(await page.evaluate(() => location.hash), hash, 'hash'));
    await page.selectOption('#model-filter', { label: 'nearest' });
    check('a choice is in the address', same(await page.evaluate(() => location.hash), hash.replace('&filter=bilinear', ''), 'hash'));
    await page.evaluate(() => window.show('#tab=model&board=pico&up=x'));
    await page.waitForFunction(() => document.getElementById('model-said').textContent !== '');
    check('a wrong address is told', same(await text('model-said'), "--up 'x': no such up; --board 'pico': no such board", 'said'));
    await page.context().close();
}

// FOLDER/boards has lines `board crc32`: the first frame of made.glb on each, with as many triangles as it has room for.
async function boards(test) {
    const { check, folder } = test, { page, give, crc } = await begin(test, '#tab=model'), wrong = [];
    await give('made.glb');
    for (const line of readFileSync(`${folder}/boards`, 'utf8').trim().split('\n')) {
        const [board, expected] = line.split(' ');
        await page.evaluate((name) => {
            const select = document.getElementById('model-board');
            select.selectedIndex = [...select.options].findIndex(({ text }) => text.startsWith(`${name},`));
            select.dispatchEvent(new Event('change'));
        }, board);
        await page.waitForFunction(() => document.getElementById('model-busy').hidden);
        wrong.push(...same(await crc(), expected, board));
    }
    check('a model is drawn on each board as pinhole-asset and pinhole-sim do', wrong);
    await page.context().close();
}

// Simplifying, C scenes, keys and widths.
async function choices(test) {
    const { check, folder } = test, { page, text, ready, give, saved, equal } = await begin(test, '#tab=model');
    await give('ring.obj', 'ring.mtl', 'ring.png');
    await page.focus('#model-triangles');
    const [triangles] = readFileSync(`${folder}/ring.triangles`, 'utf8').trim().split(' ');
    await page.evaluate(() => {
        document.getElementById('model-triangles').value = 500;
    });
    await page.keyboard.press('ArrowRight');
    await page.waitForFunction(() => document.getElementById('model-need').textContent.includes('simplified'));
    await ready();
    const name = await saved('#model-save', 'ring.saved');
    check('a simplified OBJ with its textures does, too', [...same(name, 'ring.phs', 'file'),
        ...same(await text('model-count'), `${triangles} of 1,152`, 'triangles'), ...equal('ring.saved', 'ring.phs')]);
    await saved('#model-save-c', 'ring.saved.c');
    check('... and as C', equal('ring.saved.c', 'ring.c'));
    await page.check('#model-compare');
    await page.waitForSelector('#model-beside', { state: 'visible' });
    await ready();
    check('the unsimplified model stands beside it, as pinhole-sim draws it', [...same(await text('model-whole-title'), 'unsimplified: 1,152 triangles', 'title'),
        ...same(await page.evaluate(() => window.painted(document.querySelector('#model-whole canvas'))), readFileSync(`${folder}/whole.crc`, 'utf8').trim(), 'crc32')]);
    await saved('#model-save-c', 'ring.saved.c');
    check('... and the C scene is still the simplified one', equal('ring.saved.c', 'ring.c'));
    const before = await page.evaluate(() => document.querySelector('#model-facts dd').textContent);
    await page.focus('#model-glass');
    await page.keyboard.press('ArrowRight');
    const turned = await page.evaluate(() => document.querySelector('#model-facts dd').textContent);
    await page.keyboard.press('ArrowLeft');
    check('arrows go around it', [...(turned === before ? ['it stands'] : []),
        ...same(await page.evaluate(() => document.querySelector('#model-facts dd').textContent), before, 'crc32')]);
    for (const width of [360, 800, 1440]) {
        await page.setViewportSize({ width, height: 800 });
        check(`${width} pixels: nothing of the model is wider`, same(await page.evaluate(() => document.documentElement.scrollWidth), width, 'width'));
        await page.screenshot({ path: `${folder}/model-${width}.png`, fullPage: true });
    }

    await page.context().close();
}

export async function useModelMore(test) {
    await choices(test);
    await address(test);
    await boards(test);
    await faults(test);
}
