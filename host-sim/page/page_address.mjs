// address: what the page shows, in its address: #board=NAME&demo=NAME&view=NAME&depth=NAME&frame=N, or size=WxH without
// a kit. The names are those of the options of pinhole-sim.

const FRAMES = 1e9; // numbers of frames are below, as in pinhole-sim
const SIDE = 1024; // pixels of a glass at most

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

// Returns {board, width, height, demo, view, depth, frame} as indices of the core's lists, frame -1 where none is
// named; and `wrong`, lines about what the address has wrong.
export function readAddress(hash, core) {
    const words = new URLSearchParams(hash.replace(/^#/, '')), wrong = [];
    const size = words.has('size') && !words.has('board') ? readSize(words.get('size'), wrong) : null;
    const kit = size ?? { board: indexOf(core.boards, words.get('board'), 'pico-display-2', 'board', wrong) };
    const demo = indexOf(core.demos, words.get('demo'), 'turntable', 'demo', wrong);
    const views = core.demos[demo].views;
    const view = views.length > 0 ? indexOf(views, words.get('view'), views[0], 'view', wrong) : 0;
    const depth = indexOf(core.depths, words.get('depth'), 'auto', 'depth', wrong);
    const text = words.get('frame');
    const good = /^\d{1,9}$/.test(text ?? '0') && +(text ?? 0) < FRAMES;
    if (!good) {
        wrong.push(`frame '${text}': a whole number, 0 .. ${FRAMES - 1}`);
    }
    return { ...kit, demo, view, depth, frame: text !== null && good ? +text : -1, wrong };
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
    words.set('frame', state.frame);
    return `#${words}`;
}
