// model: the tab in which a model of the user becomes a scene, and is drawn as a kit draws it.
import { isUsual, readModelAddress, tabOf, writeModelAddress } from './page_address.mjs';
import { makeBeside } from './page_beside.mjs';
import { showBoards } from './page_boards.mjs';
import { at, count, fill, showFacts } from './page_facts.mjs';
import { saveFile, watchFiles } from './page_files.mjs';
import { makeGlass } from './page_glass.mjs';
import { makePlayer } from './page_player.mjs';
import { makeReader } from './page_reader.mjs';
import { openSend } from './page_send.mjs';

const ENDINGS = /\.(gltf|glb|obj|stl|ply)$/i;
const ALL = 0xFFFFFFFF, LEAST = 16; // triangles
const STEPS = 1000; // of the slider, which goes by factors
const FIT = 0;

// The slider's place for so many triangles of `most`, and back.
const placeOf = (triangles, most) => (most <= LEAST ? STEPS : Math.round(STEPS * Math.log(triangles / LEAST) / Math.log(most / LEAST)));
const trianglesAt = (place, most) => (place >= STEPS ? most : Math.round(LEAST * (most / LEAST) ** (place / STEPS)));

// core has the lists; startAnother() starts a module of its own for this tab, readerModule() is that of the worker, and
// flasher() is for openSend().
export function openModelTab({ boards }, startAnother, readerModule, flasher) {
    let core = null, files = null, path = '', made = null, wanted = null, frame = 0, rate = 0;
    let board = 0, first = FIT; // triangles that the next model is made of
    let fit = null; // triangles that the board has room for, of the model as it is read now
    const say = (text, wrong = false) => {
        at('model-said').textContent = text;
        at('model-said').classList.toggle('wrong', wrong);
    };
    const busy = (is) => {
        at('model-busy').hidden = !is;
        at('model').classList.toggle('busy', is);
        updateSend();
    };
    const inputs = { up: at('model-up'), filter: at('model-filter'), 'texture-size': at('model-texture'),
        background: at('model-background'), light: at('model-light'), turntable: at('model-turntable'), 'two-sided': at('model-two-sided'), beside: at('model-compare') };
    const remember = () => {
        if (!at('model').hidden) {
            const triangles = made?.triangles ?? first;
            history.replaceState(null, '', writeModelAddress(boards[board], inputs, triangles === FIT ? 'fit' : triangles === ALL ? 'all' : triangles));
        }
    };
    const reader = makeReader(readerModule, (what, share) => {
        at('model-what').textContent = what;
        at('model-progress').value = share;
    });
    const draw = () => {
        if (core === null || made === null || !core.frame(frame)) {
            say(core?.messages() || 'there is no model', true);
            return -1;
        }
        const note = core.messages(), stats = core.stats(frame);
        if (note !== '') {
            say(note, true);
        }
        glass.show(core.glass());
        beside.draw(frame);
        showFacts(at('model-facts'), stats, core.crc(), player.isPlaying() ? rate : 0);
        return stats.bus_us / 1000;
    };
    const move = (...way) => {
        if (made !== null) {
            core.drag(...way);
            beside.drag(...way);
            if (!player.isPlaying()) {
                draw();
            }
        }
    };
    const glass = makeGlass(at('model-glass'), move);
    const beside = makeBeside(startAnother, move);
    at('model-glass').addEventListener('keydown', (event) => {
        const way = { ArrowLeft: [-8, 0, 0], ArrowRight: [8, 0, 0], ArrowUp: [0, 0, 1], ArrowDown: [0, 0, -1] }[event.key];
        if (way !== undefined) {
            event.preventDefault();
            move(...way);
        }
    });
    const player = makePlayer(() => {
        frame = (frame + 1) % 1e9;
        return draw();
    }, (playing) => {
        at('model-play').textContent = playing ? 'Pause' : 'Play';
        rate = 0;
    }, (frames) => {
        rate = frames;
    });

    const showReport = () => {
        const { report } = made, { read, triangles, simplified, error, note, flash } = report;
        at('model-triangles').disabled = read <= LEAST;
        at('model-triangles').value = placeOf(triangles, read);
        at('model-count').textContent = `${count(triangles)} of ${count(read)}`;
        at('model-fit-mark').value = placeOf(fit ?? triangles, read);
        at('model-fit').textContent = `fit: ${count(fit ?? triangles)}`;
        at('model-note').textContent = note !== '' ? `${path}: ${note}` : '';
        at('model-need').textContent = `${report.name}: ${count(triangles)} triangles` +
            `${simplified ? `, simplified: the surface moved by about ${(100 * error).toPrecision(2)} % of its radius` : ''}.` +
            `${report.bare ? ' It stands without the platter, which has no room.' : ''}`;
        fill(at('model-clip'), report.clips);
        at('model-clip').prepend(new Option('all', -1));
        at('model-clip').value = made.clip;
        at('model-clips').hidden = report.clips.length < 2;
        showBoards(at('model-boards'), boards, report, board, (i) => takeBoard(i));
        at('model-flash').textContent = count(flash);
        at('model-table').hidden = false;
    };
    const showScene = () => {
        const wrong = core.scene(made.scene);
        if (wrong !== '' || !core.open({ board, demo: -1 })) {
            say(wrong || core.messages(), true);
            return;
        }
        const title = boards[board].title;
        at('model-title').textContent = title;
        glass.describe(`${made.report.name} on ${title}`);
        frame = 0;
        draw();
        updateSend();
        at('model-save').disabled = at('model-save-c').disabled = at('model-save-png').disabled = at('model-play').disabled = false;
    };
    // Makes the scene anew: `triangles` of it, FIT or ALL.
    const make = async (triangles) => {
        if (files === null || reader.isBusy()) {
            wanted = triangles; // for when it has answered
            return;
        }
        wanted = null;
        say('');
        busy(true);
        const clip = +at('model-clip').value;
        const goal = { board, triangles, texture_log2: +at('model-texture').value, turntable: +at('model-turntable').checked, clip };
        const whole = at('model-compare').checked && triangles !== ALL ? await reader.ask({ call: 'make', goal: { ...goal, triangles: ALL } }) : null;
        const answer = await reader.ask({ call: 'make', goal }); // the last one is what a C scene is written of
        core ??= await startAnother();
        busy(false);
        if (answer.wrong !== undefined) {
            say(answer.wrong, true);
            return;
        }
        made = { ...answer, board: goal.board, clip, triangles };
        fit = triangles === FIT ? answer.report.triangles : fit;
        showReport();
        beside.hide();
        const lacks = whole?.scene === undefined ? whole?.wrong : await beside.show(whole.scene, boards[board], whole.report.triangles);
        showScene();
        if (lacks) {
            say(lacks, true);
        }
        remember();
        if (wanted !== null) {
            await make(wanted);
        }
    };
    const open = async () => {
        if (files === null) {
            return;
        }
        reader.stop();
        say('');
        at('model-what').textContent = 'reading';
        at('model-progress').value = 0;
        busy(true);
        const options = { up: at('model-up').value, filter: +at('model-filter').value, two_sided: +at('model-two-sided').checked,
            background: isUsual(inputs.background) ? -1 : parseInt(inputs.background.value.slice(1), 16), light: +at('model-light').value };
        const answer = await reader.ask({ call: 'open', files, path, options });
        busy(false);
        if (answer.wrong !== undefined) {
            files = null;
            say(answer.wrong, true);
            return;
        }
        await make(first);
        first = FIT;
    };
    const takeBoard = (i) => {
        board = i;
        at('model-board').value = i;
        remember();
        make(FIT);
    };
    const updateSend = openSend(at('model-send'), {
        board: () => boards[board].name,
        scene: () => (reader.isBusy() || made?.board !== board ? null : { name: made.report.name, bytes: made.scene }),
        flasher,
    });
    watchFiles(at('model'), [at('model-files'), at('model-folder')], (given) => {
        const models = [...given.keys()].filter((name) => ENDINGS.test(name));
        if (models.length === 0) {
            say('no model among these files: OBJ, STL, PLY, glTF and GLB are', true);
            return;
        }
        files = given;
        [path] = models;
        at('model-clip').replaceChildren(new Option('all', -1));
        open().then(() => models.length > 1 && at('model-note').append(` ${models.length} models: this is the first.`));
    }, (text) => say(text, true));

    fill(at('model-board'), boards.map(({ name, width, height }) => `${name}, ${width}x${height}`));
    const follow = () => {
        const asked = readModelAddress(tabOf(location.hash) === 'model' ? location.hash : '', boards, inputs);
        board = asked.board;
        at('model-board').value = board;
        first = asked.triangles === 'fit' ? FIT : asked.triangles === 'all' ? ALL : +asked.triangles;
        open().then(() => asked.wrong.length > 0 && say(asked.wrong.join('; '), true));
    };
    window.addEventListener('hashchange', () => tabOf(location.hash) === 'model' && follow());
    at('model').addEventListener('enter', remember);
    for (const input of Object.values(inputs)) {
        input.addEventListener('change', remember);
    }
    at('model-board').addEventListener('change', () => takeBoard(+at('model-board').value));
    for (const id of ['model-up', 'model-filter', 'model-background', 'model-light', 'model-two-sided']) {
        at(id).addEventListener('change', open);
    }
    for (const id of ['model-texture', 'model-turntable', 'model-clip', 'model-compare']) {
        at(id).addEventListener('change', () => make(made?.triangles ?? FIT));
    }
    at('model-triangles').addEventListener('input', () => {
        at('model-count').textContent = made === null ? '' : `${count(trianglesAt(+at('model-triangles').value, made.report.read))} of ${count(made.report.read)}`;
    });
    at('model-triangles').addEventListener('change', () => {
        const place = +at('model-triangles').value;
        make(place >= STEPS ? ALL : trianglesAt(place, made.report.read));
    });
    at('model-fit').addEventListener('click', () => make(FIT));
    at('model-cancel').addEventListener('click', () => {
        reader.stop();
        files = wanted = null;
        busy(false);
        say('cancelled: give the model again');
    });
    at('model-play').addEventListener('click', player.toggle);
    follow();
    at('model').addEventListener('leave', () => player.isPlaying() && player.pause());
    at('model-save').addEventListener('click', () => saveFile(`${made.report.name}.phs`, [made.scene], 'application/octet-stream'));
    at('model-save-c').addEventListener('click', async () => {
        if (files === null || reader.isBusy()) {
            say(files === null ? 'give the model again' : 'not yet: the scene is being made');
            return;
        }
        const { text, wrong } = await reader.ask({ call: 'c' });
        if (wrong !== undefined) {
            say(wrong, true);
        } else {
            saveFile(`${made.report.name}.c`, [text], 'text/plain');
        }
    });
    at('model-save-png').addEventListener('click', () => glass.save(`${made.report.name}-${String(frame).padStart(4, '0')}.png`));
}
