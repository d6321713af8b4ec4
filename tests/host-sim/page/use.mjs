// use: tries the page as its users do; see browser.mjs.
import { readFileSync } from 'node:fs';

const same = (is, must, what) => (String(is) === String(must) ? [] : [`${what}: ${is}, not ${must}`]);
const differ = (is, from, what) => (String(is) !== String(from) ? [] : [`${what}: ${is} still`]);

async function keyboard({ browser, open, check, folder }) {
    const page = await open(browser), seen = () => page.evaluate(() => window.seen());
    await page.evaluate(() => window.show('#board=pico-display&demo=turntable&frame=5'));
    const [, before] = await seen();
    const focus = () => page.evaluate(() => document.activeElement.id);
    for (let i = 0; i < 5 && await focus() !== 'glass'; i++) {
        await page.keyboard.press('Tab');
    }
    check('Tab comes to the glass', same(await focus(), 'glass', 'focus'));
    await page.keyboard.press('ArrowRight');
    const [frame, turned] = await seen();
    check('an arrow is the kit\'s button while the frame stands',
        [...same(frame, 5, 'frame'), ...same(turned, readFileSync(`${folder}/keys.crc`, 'utf8').trim(), 'crc32')]);
    await page.keyboard.press('ArrowLeft');
    check('... and the other one turns back', same((await seen())[1], before, 'crc32'));
    await page.keyboard.press('.');
    check('the key . steps', same((await seen())[0], 6, 'frame'));
    check('... and the address follows', same(await page.evaluate(() => location.hash), '#board=pico-display&demo=turntable&frame=6', 'hash'));
    await page.keyboard.press('p');
    await page.waitForFunction(() => +document.getElementById('frame').value > 12);
    const name = () => page.evaluate(() => document.getElementById('play').textContent);
    check('the key p plays', same(await name(), 'Pause', 'button'));
    await page.fill('#frame', '500');
    await page.waitForTimeout(200);
    check('a number that is being typed stays while it plays', same((await seen())[0], 500, 'frame'));
    await page.press('#frame', 'Enter');
    await page.focus('#glass');
    await page.waitForFunction(() => +document.getElementById('frame').value > 502);
    check('... and then it goes on from there', [...same((await seen())[0] < 600, true, 'near frame 500')]);
    await page.keyboard.press('p');
    const [stands] = await seen();
    await page.waitForTimeout(300);
    check('... and pauses', [...same((await seen())[0], stands, 'frame'), ...same(await name(), 'Play', 'button')]);
    await page.keyboard.press('Enter');
    check('Enter takes the next demo', same(await page.evaluate(() => new URLSearchParams(location.hash.slice(1)).get('demo')), 'testcard', 'demo'));
    check('no choice is left out by Tab', await page.evaluate(() => [...document.querySelectorAll('button:not([role=tab]), select, input')]
        .filter((element) => element.tabIndex < 0).map((element) => element.id)));
    await page.context().close();
}

async function pointer({ browser, open, check }) {
    const page = await open(browser), crc = async () => (await page.evaluate(() => window.seen()))[1];
    await page.evaluate(() => window.show('#board=pico-display-2&demo=turntable&frame=5'));
    const before = await crc(), box = await page.locator('#glass canvas').boundingBox();
    const at = [box.x + box.width / 2, box.y + box.height / 2];
    const drag = async (right, down) => {
        await page.mouse.move(...at);
        await page.mouse.down();
        await page.mouse.move(at[0] + right, at[1] + down, { steps: 4 });
        await page.mouse.up();
        return crc();
    };
    const dragged = await drag(40, 24);
    check('a drag goes around', differ(dragged, before, 'crc32'));
    const hash = await page.evaluate(() => location.hash), other = await open(browser);
    await other.evaluate((to) => window.show(to), hash);
    check('... which is in the address', same((await other.evaluate(() => window.seen()))[1], dragged, `crc32 of ${hash}`));
    await other.context().close();
    check('... and back', same(await drag(-40, -24), before, 'crc32'));
    await page.mouse.wheel(0, -100);
    check('the wheel comes nearer', differ(await crc(), before, 'crc32'));
    await page.mouse.wheel(0, 100);
    check('... and goes back', same(await crc(), before, 'crc32'));
    await page.click('button[aria-label=left]');
    check('a button on the screen is the kit\'s', differ(await crc(), before, 'crc32'));
    await page.context().close();
}

async function fingers({ browser, open, check }) {
    const page = await open(browser, { viewport: { width: 360, height: 700 }, hasTouch: true });
    const crc = async () => (await page.evaluate(() => window.seen()))[1];
    await page.evaluate(() => window.show('#board=pico-display-2&demo=turntable&frame=5'));
    const before = await crc(), box = await page.locator('#glass canvas').boundingBox();
    const session = await page.context().newCDPSession(page);
    const touch = async (type, ...ways) => {
        const touchPoints = ways.map(([right, down], id) => ({ x: box.x + box.width / 2 + right, y: box.y + box.height / 2 + down, id }));
        await session.send('Input.dispatchTouchEvent', { type, touchPoints });
    };
    const move = async (from, to) => {
        await touch('touchStart', ...from);
        await touch('touchMove', ...to.map(([right, down], i) => [(right + from[i][0]) / 2, (down + from[i][1]) / 2]));
        await touch('touchMove', ...to);
        await touch('touchEnd');
        return crc();
    };
    check('a finger goes around', differ(await move([[0, 0]], [[20, -50]]), before, 'crc32'));
    check('... and back', same(await move([[0, 0]], [[-20, 50]]), before, 'crc32'));
    check('... and the browser does not scroll by it', same(await page.evaluate(() => getComputedStyle(document.getElementById('glass')).touchAction), 'none', 'touch-action'));
    check('two fingers come nearer', differ(await move([[-20, 0], [20, 0]], [[-25, 0], [25, 0]]), before, 'crc32'));
    check('... and go back', same(await move([[-26, 0], [26, 0]], [[-20, 0], [20, 0]]), before, 'crc32'));
    await page.context().close();
}

async function choices({ browser, open, check, folder }) {
    const page = await open(browser), hash = () => page.evaluate(() => location.hash);
    await page.selectOption('#board', { label: 'waveshare-rp2040-lcd-1in28, 240x240' });
    await page.selectOption('#demo', { label: 'solar' });
    await page.selectOption('#view', { label: 'moon' });
    await page.selectOption('#depth', { label: 'fixed24' });
    await page.fill('#frame', '7');
    await page.press('#frame', 'Enter');
    check('the choices are in the address', same(await hash(), '#board=waveshare-rp2040-lcd-1in28&demo=solar&view=moon&depth=fixed24&frame=7', 'hash'));
    check('a round glass is round', await page.evaluate(() => getComputedStyle(document.querySelector('canvas')).borderRadius) === '50%' ? [] : ['it is square']);
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]);
    await download.saveAs(`${folder}/saved.png`);
    check('a picture is saved under the demo\'s name', same(download.suggestedFilename(), 'solar-0007.png', 'file'));
    await page.evaluate(() => window.show('#size=320x240&demo=turntable&frame=11'));
    check('a glass of any size is the one of --size', same((await page.evaluate(() => window.seen()))[2], readFileSync(`${folder}/size.crc`, 'utf8').trim(), 'crc32'));
    await page.evaluate(() => window.show('#board=pico-displey&demo=solr&frame=1'));
    check('a wrong address is told', same(await page.evaluate(() => window.said()), "--board 'pico-displey': no such board; --demo 'solr': no such demo", 'said'));
    await page.context().close();
}

async function looks({ browser, open, check, folder }) {
    for (const width of [360, 800, 1440]) {
        for (const colorScheme of ['light', 'dark']) {
            const page = await open(browser, { viewport: { width, height: 800 }, colorScheme });
            check(`${width} pixels, ${colorScheme}: nothing is wider`, same(await page.evaluate(() => document.documentElement.scrollWidth), width, 'width'));
            await page.screenshot({ path: `${folder}/${width}-${colorScheme}.png`, fullPage: true });
            await page.context().close();
        }
    }
    const page = await open(browser, { reducedMotion: 'no-preference' });
    check('everything to click or to type in has a name', await page.evaluate(() => [...document.querySelectorAll('button, select, input, canvas, [tabindex]')]
        .filter((element) => !(element.getAttribute('aria-label') || (element.matches('select, input') ? element.labels[0] : element)?.textContent.trim())).map((element) => element.outerHTML)));
    await page.context().close();
}

export async function use(test) {
    await keyboard(test);
    await pointer(test);
    await choices(test);
}

export async function useMore(test) {
    await fingers(test);
    await looks(test);
}
