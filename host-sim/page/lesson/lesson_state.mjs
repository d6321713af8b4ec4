// lesson_state: what the tab Lesson shows is a Map of options of pinhole-sim and their values, which is its address, too:
// #tab=lesson&size=240x180&fov=60... An option without a value stands there with `on`.

const LESSON_FLAGS = ['anyway', 'aa', 'dither', 'overlay'];
const LESSON_LENS = ['fov', 'focal', 'near', 'far', 'projection']; // what --projection-matrix holds
const LESSON_EITHER = { camera: 'view-matrix', 'view-matrix': 'camera', fov: 'focal', focal: 'fov', size: 'board', board: 'size', projection: 'focal' };
const LESSON_FIRST = '#tab=lesson&demo=cube&size=240x180&fov=60&near=2&far=10&camera=eye=0,3,1,target=0,0,-3&point=1,1,-2';

// Returns the state of an address; one that names no option opens what the lesson begins with.
export function readLessonAddress(hash) {
    const state = new Map(new URLSearchParams(hash.replace(/^#/, '')));
    state.delete('tab');
    if (state.size === 0) {
        return readLessonAddress(LESSON_FIRST);
    }
    return state.has('demo') ? state : new Map([['demo', 'cube'], ...state]);
}

export function writeLessonAddress(state) {
    return `#${new URLSearchParams([['tab', 'lesson'], ...state])}`.replaceAll('%2C', ',').replaceAll('%3D', '=');
}

// Sets an option, or takes it away where value is ''. What excludes it goes away, and so does a lens before its matrix, and a
// matrix before a lens. `kept` has the lens's options meanwhile, which come back with the next of them that is set.
export function setLessonOption(state, kept, name, value) {
    state.delete(value !== '' && LESSON_EITHER[name]);
    if (name === 'projection-matrix' && value !== '') {
        for (const option of LESSON_LENS.filter((option) => state.has(option))) {
            kept.set(option, state.get(option));
            state.delete(option);
        }
    } else if (name === 'projection-matrix' || (LESSON_LENS.includes(name) && state.has('projection-matrix'))) {
        state.delete('projection-matrix');
        kept.forEach((text, option) => state.set(option, text));
        kept.clear();
    }
    if (value === '') {
        state.delete(name);
    } else {
        state.set(name, value);
    }
    if (state.has('view-matrix') || state.has('projection-matrix')) {
        state.set('anyway', 'on');
    } else {
        state.delete('anyway');
    }
}

// The command line: the state, and what prints its numbers; a fisheye has no matrix.
export function lessonWords(state) {
    const words = [...state].flatMap(([name, value]) => [`--${name}`, ...(LESSON_FLAGS.includes(name) ? [] : [value])]);
    return [...words, ...(state.get('projection') === 'fisheye' ? [] : ['--matrix', 'factors']), '--crc'];
}

export function lessonCommand(words) {
    return ['pinhole-sim', ...words.map((word) => (/^[\w.,=:/+-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`))].join(' ');
}

// Options as they are typed on a command line; the rest is said. Returns { options: [[name, value], ...], wrong }.
export function readLessonOptions(text) {
    const options = [], words = text.trim().split(/\s+/).filter((word) => word !== '');
    for (let i = 0; i < words.length; i++) {
        const [, name, , inline] = /^--([a-z-]+)(=(.*))?$/.exec(words[i]) ?? [];
        if (name === undefined) {
            return { options, wrong: `${words[i]}: an option begins with --` };
        }
        options.push([name, LESSON_FLAGS.includes(name) ? 'on' : inline ?? words[++i] ?? '']);
    }
    return { options, wrong: '' };
}

export const lessonPlace = (text) => (text ?? '').split(',').map(Number);
export const lessonNumber = (x) => String(+x.toFixed(4));
export const lessonList = (numbers) => numbers.map(lessonNumber).join();

// The look-at camera that an option states, or null where it states another: { eye, target, up }.
export function readLessonCamera(text) {
    const number = '(-?[\\d.]+,-?[\\d.]+,-?[\\d.]+)';
    const [, eye, , target, , up] = new RegExp(`^eye=${number}(,target=${number})?(,up=${number})?$`).exec(text ?? '') ?? [];
    return eye === undefined ? null : { eye: lessonPlace(eye), target: lessonPlace(target ?? '0,0,0'), up: up ?? '' };
}

export function writeLessonCamera({ eye, target, up }) {
    return `eye=${lessonList(eye)},target=${lessonList(target)}${up === '' ? '' : `,up=${up}`}`;
}
