// kit: the tab in which a demo runs on a kit.
import { readAddress, tabOf, writeAddress } from './page_address.mjs';
import { watchButtons } from './page_buttons.mjs';
import { at, fill, showFacts } from './page_facts.mjs';
import { makeGlass } from './page_glass.mjs';
import { makePlayer } from './page_player.mjs';
import { openSend } from './page_send.mjs';

export function openKit(core, flasher) {
    let state = null, shown = -1, rate = 0, opened = false; // shown: the frame on the glass
    const say = (text, wrong = false) => {
        at('said').textContent = text;
        at('said').classList.toggle('wrong', wrong);
    };
    const title = () => state.board < 0 ? `no kit: a glass of ${state.width}x${state.height}` : core.boards[state.board].title;
    const remember = () => {
        state.moved = opened ? core.moved() : state.moved;
        if (!at('kit').hidden) {
            history.replaceState(null, '', writeAddress(state, core));
        }
    };
    const showChoices = () => {
        const demo = core.demos[state.demo];
        at('board').value = state.board;
        at('demo').value = state.demo;
        at('depth').value = state.depth;
        at('summary').textContent = `${demo.summary}; ${demo.frames} frame${demo.frames === 1 ? '' : 's'}`;
        at('views').hidden = demo.views.length === 0;
        fill(at('view'), demo.views);
        at('view').value = state.view;
        at('title').textContent = title();
        glass.describe(`${demo.name} on ${title()}`);
        updateSend();
    };

    // Draws the frame of the state, with the buttons that are pressed. Returns its time on the bus, or -1.
    const draw = () => {
        if (!opened || !core.frame(state.frame, buttons())) {
            say(core.messages() || at('said').textContent, true);
            return -1;
        }
        const note = core.messages(), stats = core.stats(state.frame);
        if (note !== '') {
            say(note, true);
        }
        shown = state.frame;
        glass.show(core.glass());
        if (!player.isPlaying() || document.activeElement !== at('frame')) { // a number that is being typed stays
            at('frame').value = state.frame;
        }
        showFacts(at('facts'), stats, core.crc(), player.isPlaying() ? rate : 0);
        if (core.demo() !== state.demo) { // the select button took the next
            state = { ...state, demo: core.demo(), view: 0 };
            showChoices();
        }
        return stats.bus_us / 1000;
    };
    const drawNext = () => {
        state.frame = shown === state.frame ? (state.frame + 1) % 1e9 : state.frame;
        return draw();
    };
    const step = () => {
        player.pause();
        if (drawNext() >= 0) {
            say(`frame ${state.frame} crc32 ${core.crc()}`);
            remember();
        }
    };
    const redraw = () => !player.isPlaying() && draw() >= 0 && remember();
    const open = () => {
        say('');
        opened = core.open(state);
        if (!opened) {
            say(core.messages(), true);
        }
        shown = -1;
        if (opened) {
            core.move(...state.moved);
        }
        showChoices();
        remember();
        if (opened && !player.isPlaying()) {
            draw();
        }
    };
    const glass = makeGlass(at('glass'), (...way) => {
        if (opened) {
            core.drag(...way);
            redraw();
        }
    });
    const player = makePlayer(drawNext, (playing) => {
        at('play').textContent = playing ? 'Pause' : 'Play';
        rate = 0;
        remember();
    }, (frames) => {
        rate = frames;
        remember();
    });
    const screen = [...document.querySelectorAll('[data-button]')];
    const buttons = watchButtons(at('glass'), screen, redraw, { p: player.toggle, '.': step });

    fill(at('board'), core.boards.map((board) => `${board.name}, ${board.width}x${board.height}`));
    at('board').append(new Option('no kit: --size WxH', -1));
    fill(at('demo'), core.demos.map((demo) => demo.name));
    fill(at('depth'), core.depths);
    const choose = (id, change) => at(id).addEventListener('change', () => {
        remember(); // where the camera is
        state = { ...state, ...change(+at(id).value) };
        open();
    });
    choose('board', (board) => ({ board, width: 320, height: 240 }));
    choose('demo', (demo) => ({ demo, view: 0, moved: [0, 0, 0], frame: 0 }));
    choose('view', (view) => ({ view }));
    choose('depth', (depth) => ({ depth }));
    at('frame').addEventListener('change', () => {
        const frame = Math.trunc(+at('frame').value);
        state.frame = frame >= 0 && frame < 1e9 ? frame : state.frame;
        at('frame').value = state.frame;
        shown = -1;
        redraw();
    });
    at('play').addEventListener('click', player.toggle);
    at('step').addEventListener('click', step);
    at('speed').addEventListener('change', () => player.setSpeed(+at('speed').value));
    at('save').addEventListener('click', () => glass.save(`${core.demos[state.demo].name}-${String(shown).padStart(4, '0')}.png`));
    at('link').addEventListener('click', () => {
        remember();
        navigator.clipboard.writeText(location.href).then(() => say('the link is in the clipboard'),
            () => say('the link is in the address bar'));
    });
    at('kit').addEventListener('leave', () => player.isPlaying() && player.pause());
    const updateSend = openSend(at('kit-send'), {
        board: () => core.boards[state?.board]?.name,
        scene: () => ({ name: 'demos', bytes: new Uint8Array() }), // the image alone
        flasher,
    });
    at('kit').addEventListener('enter', remember);
    const follow = () => {
        const { wrong, frame, ...kit } = readAddress(tabOf(location.hash) === 'kit' ? location.hash : '', core);
        state = { ...kit, frame: Math.max(0, frame) };
        open();
        if (wrong.length > 0) {
            say(wrong.join('; '), true);
        }
        return frame;
    };
    window.addEventListener('hashchange', () => tabOf(location.hash) === 'kit' && follow());
    if (follow() < 0 && !at('kit').hidden && !matchMedia('(prefers-reduced-motion: reduce)').matches) {
        player.play();
    }
}
