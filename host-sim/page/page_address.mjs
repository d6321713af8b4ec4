// address: what the page shows, in its address: #board=NAME&demo=NAME&view=NAME&depth=NAME&frame=N, or size=WxH without
// a kit. The names are those of the options of pinhole-sim. Where the camera was moved, moved=TURN,UP,AWAY says how far
// (core.moved()). The tab Model is #tab=model&board=NAME, with what is not as usual under the names of pinhole-asset's options:
// up, filter, texture-size, background, light, turntable, two-sided, max-triangles; beside shows the unsimplified model, too. A
// model itself is in no address. That of the tab Lesson is read by lesson_state.mjs.

const FRAMES = 1e9; // numbers of frames are below, as in pinhole-sim
const SIDE = 1024; // pixels of a glass at most
const AWAY = 32768; // DEMO_DOLLY_MAX of demo.h

// Returns the index of a name in a list; an unknown name is said, and the default taken.
function indexOf(list, name, fallback, what, wrong) {
    const found = list.findIndex((item) => (item.name ?? item) === (name ?? fallback));
    if (found < 0) {
        wrong.push(`--${what} '${name}': no such ${what}`);
    }
    return found < 0 ? Math.max(0, list.findIndex((item) => (item.name ?? item) === fallback)) : found;
}

function readSize(text, wrong) {
    const [, width, height] = /^(\d{1,4})x(\d{1,4})$/.exec(text) ?? [];
    const good = width >= 1 && width <= SIDE && height >= 1 && height <= SIDE;
    if (!good) {
        wrong.push(`--size '${text}': WxH, each 1 .. ${SIDE}`);
    }
    return good ? { board: -1, width: +width, height: +height } : null;
}

function readMoved(text, wrong) {
    if (!/^(-?\d{1,10})(,-?\d{1,10}){2}$/.test(text)) {
        wrong.push(`moved '${text}': three whole numbers`);
        return [0, 0, 0];
    }
    const [turned, raised, away] = text.split(',').map((number) => number | 0);
    return [turned, raised, Math.max(-AWAY, Math.min(AWAY, away))];
}

// Returns {board, width, height, demo, view, depth, moved, frame} as indices of the core's lists, frame -1 where none is
// named; and `wrong`, lines about what the address has wrong.
export function readAddress(hash, core) {
    const words = new URLSearchParams(hash.replace(/^#/, '')), wrong = [];
    const size = words.has('size') && !words.has('board') ? readSize(words.get('size'), wrong) : null;
    const kit = size ?? { board: indexOf(core.boards, words.get('board'), 'pico-display-2', 'board', wrong) };
    const demo = indexOf(core.demos, words.get('demo'), 'turntable', 'demo', wrong);
    const views = core.demos[demo].views;
    const view = views.length > 0 ? indexOf(views, words.get('view'), views[0], 'view', wrong) : 0;
    const depth = indexOf(core.depths, words.get('depth'), 'auto', 'depth', wrong);
    const moved = readMoved(words.get('moved') ?? '0,0,0', wrong);
    const text = words.get('frame');
    const good = /^\d{1,9}$/.test(text ?? '0') && +(text ?? 0) < FRAMES;
    if (!good) {
        wrong.push(`frame '${text}': a whole number, 0 .. ${FRAMES - 1}`);
    }
    return { ...kit, demo, view, depth, moved, frame: text !== null && good ? +text : -1, wrong };
}

export function writeAddress(state, core) {
    const words = new URLSearchParams();
    if (state.board < 0) {
        words.set('size', `${state.width}x${state.height}`);
    } else {
        words.set('board', core.boards[state.board].name);
    }
    words.set('demo', core.demos[state.demo].name);
    if (state.view > 0) {
        words.set('view', core.demos[state.demo].views[state.view]);
    }
    if (state.depth > 0) {
        words.set('depth', core.depths[state.depth]);
    }
    if (state.moved.some((number) => number !== 0)) {
        words.set('moved', state.moved.join());
    }
    words.set('frame', state.frame);
    return `#${words}`.replaceAll('%2C', ',');
}

export function tabOf(hash) {
    const tab = new URLSearchParams(hash.replace(/^#/, '')).get('tab');
    return ['model', 'lesson'].includes(tab) ? tab : 'kit';
}

const usual = (select) => Math.max(0, [...select.options].findIndex((option) => option.defaultSelected));

// Whether an input has the value that stands in no address.
export function isUsual(input) {
    const { type } = input;
    return type === 'checkbox' ? input.checked === input.defaultChecked : type === 'color' ? input.value === input.defaultValue : input.selectedIndex === usual(input);
}

const textOf = ({ type, value, options, selectedIndex }) => (type === 'checkbox' ? 'on' : type === 'color' ? value.slice(1) : options[selectedIndex].text);

// Sets inputs, an object of selects, colours and checkboxes by the names in the address. Returns { board, triangles, wrong }: its index; what
// max-triangles says ('fit' where it is not named, 'all', or a number); lines about what the address has wrong.
export function readModelAddress(hash, boards, inputs) {
    const words = new URLSearchParams(hash.replace(/^#/, '')), wrong = [];
    for (const [name, input] of Object.entries(inputs)) {
        if (input.type === 'checkbox') {
            input.checked = words.has(name) || input.defaultChecked;
        } else if (input.type === 'color') {
            const text = words.get(name) ?? input.defaultValue.slice(1), good = /^[0-9a-f]{6}$/i.test(text);
            input.value = good ? `#${text}` : input.defaultValue;
            if (!good) {
                wrong.push(`--${name} '${text}': six hexadecimal digits`);
            }
        } else {
            const texts = [...input.options].map((option) => option.text), text = words.get(name) ?? texts[usual(input)];
            input.selectedIndex = indexOf(texts, text, texts[usual(input)], name, wrong);
        }
    }
    const triangles = words.get('max-triangles') ?? 'fit', good = /^(fit|all|[1-9]\d{0,8})$/.test(triangles);
    if (!good) {
        wrong.push(`--max-triangles '${triangles}': a whole number, all or fit`);
    }
    return { board: indexOf(boards, words.get('board'), 'pico-display-2', 'board', wrong), triangles: good ? triangles : 'fit', wrong };
}

export function writeModelAddress(board, inputs, triangles) {
    const words = new URLSearchParams({ tab: 'model', board: board.name });
    for (const [name, input] of Object.entries(inputs)) {
        if (!isUsual(input)) {
            words.set(name, textOf(input));
        }
    }
    if (triangles !== 'fit') {
        words.set('max-triangles', triangles);
    }
    return `#${words}`;
}
