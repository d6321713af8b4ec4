// use_model: tries the tab Model as its users do; see browser.mjs. FOLDER has models, and scenes that pinhole-asset made of
// them: made.glb and fit.phs, ring.obj with its files and ring.phs, ring.triangles, ring.c; scene.crc is what pinhole-sim draws.
import { readFileSync, writeFileSync } from 'node:fs';

const same = (is, must, what) => (String(is) === String(must) ? [] : [`${what}: ${is}, not ${must}`]);

export async function useModel({ browser, open, check, folder }) {
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

    await page.click('#play');
    await page.click('[role=tab]:nth-child(2)');
    check('the kit pauses behind the tab Model', same(await text('play'), 'Play', 'button'));
    await give('made.glb');
    await saved('#model-save', 'made.saved');
    check('a GLB with textures becomes the bytes that pinhole-asset writes', [...same(await text('model-said'), '', 'said'), ...equal('made.saved', 'fit.phs')]);
    check('... and is drawn as pinhole-sim draws them', same(await page.evaluate(() => document.querySelector('#model-facts dd').textContent),
        readFileSync(`${folder}/scene.crc`, 'utf8').trim(), 'crc32'));
    check('... on every board of the table', same(await page.evaluate(() => document.querySelectorAll('#model-boards tr').length),
        await page.evaluate(() => document.getElementById('model-board').options.length), 'rows'));

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
