// lesson_tab: the tab Lesson: the world, the glass and the numbers of one camera. All numbers and pixels are pinhole-sim's, which
// runs here as the module of the page with the command line that stands below them.
import { tabOf } from '../page_address.mjs';
import { at } from '../page_facts.mjs';
import { makeGlass } from '../page_glass.mjs';
import { lessonApply, lessonHand, lessonInverse, lessonLensAs, lessonViewAs } from './lesson_algebra.mjs';
import { lessonCode } from './lesson_code.mjs';
import { lessonOrbit, lessonPoint, watchLessonControls } from './lesson_controls.mjs';
import { openLessonExercises } from './lesson_exercise_view.mjs';
import { lessonFactor, makeLessonLines, makeLessonMatrix, readLessonText } from './lesson_numbers.mjs';
import { lessonCommand, lessonList, lessonPlace, lessonWords, readLessonAddress, readLessonCamera, readLessonOptions, setLessonOption, writeLessonAddress, writeLessonCamera } from './lesson_state.mjs';
import { lessonCube, lessonScene, makeLessonWorld } from './lesson_world.mjs';

const LESSON_CONTROLS = ['size', 'fov', 'near', 'far', 'camera', 'projection', 'convention', 'point', 'show', 'view-matrix', 'projection-matrix', 'anyway'];
const LESSON_ADDRESS_MS = 100; // the address follows so long after a change
const lessonFloats = (matrix) => matrix?.flat().map(Number) ?? null;

// startAnother() starts a module of its own, in which the glass of the tab Kit is not disturbed.
export function openLesson(startAnother) {
    const input = (name) => at(`lesson-${name}`), kept = new Map();
    let core = null, state = new Map(), read = readLessonText(''), words = [], size = [240, 240], writing = 0; // of the glass; the timer of the address

    const say = (text, wrong = false) => {
        input('said').textContent = text;
        input('said').classList.toggle('wrong', wrong);
    };
    const convention = () => state.get('convention') ?? 'gl';
    // A place of the world of --camera in that of the view that was printed, and back: where d3d's is left-handed, too.
    const turned = ([x, y, z]) => [x, y, convention() === 'd3d' && read.matrices.view && lessonHand(read.matrices.view) > 0 ? -z : z];
    // Where eye and target are: as the option says, or as the camera that was printed.
    const where = () => {
        const camera = readLessonCamera(state.get('camera')), cell = (i, j) => +(read.lines[`camera.${i}.${j}`]?.[1] ?? 0);
        if (camera !== null) {
            return camera;
        }
        const eye = [0, 1, 2].map((i) => cell(i, 3)), ahead = convention() === 'd3d' ? 1 : -1;
        return { eye: turned(eye), target: turned(eye.map((x, i) => x + 3 * ahead * cell(i, 2))), up: '' };
    };
    const showMatrices = ({ matrices, lines }) => {
        const typed = (name) => state.get(`${name}-matrix`)?.split(',');
        showView(typed('view') ?? matrices.view?.flat());
        showLens(typed('projection') ?? matrices.projection?.flat());
        showTurn(lines['R.0.0'] && lessonFactor(lines, 'R'));
        showShift(lines['T.0.3'] && lessonFactor(lines, 'T'));
        showViewport(matrices.viewport?.flat());
        for (const [name, show] of Object.entries(showMore)) {
            at(`lesson-${name}`).hidden = matrices[name] === undefined;
            show(matrices[name]?.flat());
        }
        input('view-back').hidden = !state.has('view-matrix');
        input('lens-back').hidden = !state.has('projection-matrix');
    };
    // The vertex as a cross on the glass, from the pixel that was printed.
    const showCross = ({ lines }) => {
        const [width, height] = size, x = lines['pixel.x'], y = lines['pixel.y'], w = lines['clip.w'];
        const before = lines.radius || (w && (w[1] > 0) === (convention() !== 'lmu' || lines.w1 === undefined)); // a fisheye sees all around
        const left = x && x[1] / width, top = y && (convention() === 'lmu' ? 1 - y[1] / height : y[1] / height);
        input('cross').hidden = !before || !(left >= 0 && left <= 1 && top >= 0 && top <= 1);
        input('cross').style.left = `${left * 100}%`;
        input('cross').style.top = `${top * 100}%`;
    };
    const showWorld = ({ matrices, lines }) => {
        const place = [0, 1, 2].map((i) => lines[`world.${'xyz'[i]}`]?.[1]).map(Number), { eye, target } = where();
        const point = lines['world.x'] ? place : lessonPoint(state), is_cube = state.get('demo') === 'cube' && !state.has('start');
        world.draw(lessonScene({
            view: lessonFloats(matrices.view), lens: lessonFloats(matrices.projection), convention: convention(), eye: turned(eye), target: turned(target),
            point, object: is_cube ? lessonCube(turned) : [],
        }));
    };
    // Runs the words. Where the camera can be drawn and a number cannot be printed, the words that ask for it are left out, so
    // that the command draws, too; the message stays.
    const run = () => {
        const all = lessonWords(state), point = ['--point', state.get('point')];
        const matrix = ['--matrix', 'factors', '--flatten', state.get('flatten'), '--frustum', state.get('frustum')];
        let result = null, said = '';
        for (const without of [[], point, matrix, [...point, ...matrix]]) {
            words = all.filter((word) => !without.includes(word));
            result = core.run(words);
            said = said === '' ? result.wrong : said;
            if (!/^--(matrix|point)[:,] /m.test(result.wrong)) {
                break;
            }
        }
        return { ...result, wrong: said };
    };
    const draw = () => {
        const { drawn, text, wrong } = run();
        read = readLessonText(text);
        say(wrong.replaceAll('\n', '; '), wrong !== '');
        if (drawn) {
            const picture = core.glass();
            size = [picture.width, picture.height];
            glass.show(picture);
            glass.describe(`The scene as the camera sees it, ${size.join(' by ')} pixels`);
        }
        showLines(read.lines);
        showMatrices(read);
        showCross(read);
        showWorld(read);
        showControls();
        input('more').value = [...state].filter(([name]) => !LESSON_CONTROLS.includes(name)).map(([name, value]) => `--${name}${value === 'on' ? '' : ` ${value}`}`).join(' ');
        input('command').textContent = lessonCommand(words);
        input('code').textContent = drawn ? lessonCode(state, size, read) : '';
        input('crc').textContent = drawn ? `crc32 ${core.crc()}` : '';
    };
    const remember = () => {
        clearTimeout(writing);
        if (!at('lesson').hidden) {
            history.replaceState(null, '', writeLessonAddress(state));
        }
    };
    const set = (changes) => {
        if (changes.convention !== undefined && changes.convention !== convention()) {
            rewrite(changes.convention);
        }
        for (const [name, value] of Object.entries(changes)) {
            setLessonOption(state, kept, name, value);
        }
        draw();
        clearTimeout(writing); // a browser takes few addresses in a second, and each holds up the picture: a slider writes its last one
        writing = setTimeout(remember, LESSON_ADDRESS_MS);
    };
    // Matrices that were typed, and planes that are coordinates, as another convention writes them.
    const rewrite = (to) => {
        for (const name of ['near', 'far'].filter((plane) => state.has(plane))) {
            state.set(name, state.get(name).replace('-', ''));
        }
        for (const [name, as] of [['view-matrix', lessonViewAs], ['projection-matrix', lessonLensAs]]) {
            const typed = state.has(name) && lessonPlace(state.get(name));
            if (typed && typed.every(Number.isFinite)) {
                state.set(name, as(typed, convention(), to).map((x) => x || 0).join());
            }
        }
    };
    const moveTo = (name, place) => set({ camera: writeLessonCamera({ ...where(), [name]: place }) });
    // A handle of the world was moved. The vertex is stated in its object's coordinates.
    const moved = (name, place) => {
        const object = lessonFloats(read.matrices.object), inverse = object && lessonInverse(object);
        if (name === 'point') {
            set({ point: lessonList(inverse ? lessonApply(inverse, turned(place)).slice(0, 3) : turned(place)) });
        } else {
            moveTo(name, turned(place));
        }
    };
    const world = makeLessonWorld(at('lesson-world'), moved);
    const glass = makeGlass(at('lesson-glass'), (right, down, notches) => {
        moveTo('eye', lessonOrbit(where(), right * Math.PI / 128, down * Math.PI / 128, 1 - notches / 16));
    });
    const showLines = makeLessonLines(at('lesson-stages'), at('lesson-others'));
    const showView = makeLessonMatrix(at('lesson-view'), 'view', 'V: view, world to camera', (cells) => set({ 'view-matrix': cells.join() }));
    const showLens = makeLessonMatrix(at('lesson-lens'), 'projection', 'P: projection, camera to clip', (cells) => set({ 'projection-matrix': cells.join() }));
    const showTurn = makeLessonMatrix(at('lesson-turn'), 'turn', 'R: rotation');
    const showShift = makeLessonMatrix(at('lesson-shift'), 'move', 'T: translation; V = R T');
    const showViewport = makeLessonMatrix(at('lesson-viewport'), 'viewport', 'viewport, NDC to pixels');
    const showMore = { object: makeLessonMatrix(at('lesson-object'), 'object', 'object, object to world'), flatten: makeLessonMatrix(at('lesson-flatten'), 'flatten', 'flatten: drops the depth') };
    const showControls = watchLessonControls(input, () => state, set, where, () => size);

    input('view-back').addEventListener('click', () => set({ camera: writeLessonCamera(where()) }));
    input('lens-back').addEventListener('click', () => set({ 'projection-matrix': '' }));
    input('more').addEventListener('change', () => {
        const { options, wrong } = readLessonOptions(input('more').value);
        for (const [name] of [...state].filter(([name]) => !LESSON_CONTROLS.includes(name))) {
            state.delete(name);
        }
        set(Object.fromEntries(options));
        if (wrong !== '') {
            say(wrong, true);
        }
    });
    input('morph').addEventListener('input', () => world.morph(+input('morph').value));
    for (const name of ['command', 'code']) {
        input(`copy-${name}`).addEventListener('click', () => navigator.clipboard.writeText(input(name).textContent).then(() => say('it is in the clipboard'), () => {
            getSelection().selectAllChildren(input(name));
            say('it is selected: copy it');
        }));
    }
    at('lesson-glass').addEventListener('keydown', (event) => {
        const way = { ArrowLeft: [-4, 0, 1], ArrowRight: [4, 0, 1], ArrowUp: [0, 0, 15 / 16], ArrowDown: [0, 0, 17 / 16] }[event.key];
        if (way !== undefined) {
            event.preventDefault();
            moveTo('eye', lessonOrbit(where(), way[0] * Math.PI / 128, 0, way[2]));
        }
    });
    const follow = async () => {
        core ??= await startAnother();
        state = tabOf(location.hash) === 'lesson' ? readLessonAddress(location.hash) : state.size > 0 ? state : readLessonAddress('');
        kept.clear();
        draw();
        remember();
    };
    at('lesson').addEventListener('enter', follow); // the tab, or another address in it
    openLessonExercises(at('lesson-exercises'), (address) => {
        location.hash = address;
        at('lesson').scrollIntoView();
    });
}
