// lesson_world: a second camera that sees the first one: eye, target, frustum, near plane, the object, the vertex and its sight
// line. Eye, target and vertex are buttons on the picture, which are dragged or moved by keys.
import { LESSON_ENDS, lessonApply, lessonBetween, lessonDistance, lessonDivided, lessonInverse, lessonProduct } from './lesson_algebra.mjs';
import { lessonNumber } from './lesson_state.mjs';

const WORLD_STEP = 1 / 8; // a coordinate that is dragged stays exact in Q16.16
const WORLD_PIECES = 12; // of a line while the frustum becomes a cube
const LESSON_CORNERS = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [i & 1 ? 1 : -1, i & 2 ? 1 : -1, i >> 2]); // the last: near, far
const LESSON_EDGES = LESSON_CORNERS.flatMap((_, i) => [1, 2, 4].filter((bit) => !(i & bit)).map((bit) => [i, i | bit]));
const WORLD_KEYS = { ArrowLeft: [-1, 0, 0], ArrowRight: [1, 0, 0], ArrowUp: [0, 1, 0], ArrowDown: [0, -1, 0], PageUp: [0, 0, -1], PageDown: [0, 0, 1] };

// The second camera, which goes around the middle of the scene. project() returns [x, y, units of a pixel], or null behind it.
function makeWorldCamera() {
    const camera = { yaw: 0.95, pitch: 0.35, near: 1, middle: [0, 0, 0], radius: 1, width: 0, height: 0 };
    camera.axes = () => {
        const { yaw, pitch } = camera, [sy, cy, sp, cp] = [Math.sin(yaw), Math.cos(yaw), Math.sin(pitch), Math.cos(pitch)];
        return [[cy, 0, -sy], [-sy * sp, cp, -cy * sp], [sy * cp, sp, cy * cp]]; // right, up, back
    };
    camera.project = (p) => {
        const from = p.map((x, i) => x - camera.middle[i]), [x, y, z] = camera.axes().map((axis) => axis.reduce((sum, a, i) => sum + a * from[i], 0));
        const away = camera.radius * 4 * camera.near, depth = away - z, focal = Math.min(camera.width, camera.height) * 1.5;
        return depth < away / 50 ? null : [camera.width / 2 + focal * x / depth, camera.height / 2 - focal * y / depth, depth / focal];
    };
    return camera;
}

// moved(name, [x, y, z]) is called when eye, target or point are moved. Returns draw(scene) and morph(share).
export function makeLessonWorld(element, moved) {
    const canvas = element.querySelector('canvas'), context = canvas.getContext('2d'), camera = makeWorldCamera();
    const handles = Object.fromEntries([...element.querySelectorAll('[data-handle]')].map((button) => [button.dataset.handle, button]));
    let scene = null, share = 0, colours = null;

    // Where a point of the world is while the frustum becomes the cube; null: nowhere.
    const placed = (p) => {
        if (share === 0 || scene.clip === null) {
            return p;
        }
        const v = lessonApply(scene.clip, p), w = scene.convention === 'lmu' && scene.perspective ? -v[3] : v[3];
        if (w < 1e-3) {
            return null;
        }
        const [x, y, z] = lessonDivided(v), size = camera.radius * 0.7;
        return lessonBetween(p, [camera.middle[0] + x * size, camera.middle[1] + y * size, camera.middle[2] + z * size * scene.away], share);
    };
    const path = (from, to) => {
        let open = false;
        const pieces = share === 0 ? 1 : WORLD_PIECES;
        for (let i = 0; i <= pieces; i++) {
            const place = placed(lessonBetween(from, to, i / pieces)), at = place && camera.project(place);
            if (at) {
                context[open ? 'lineTo' : 'moveTo'](at[0], at[1]);
            }
            open = Boolean(at);
        }
    };
    const lines = (colour, width, list, dash = []) => {
        context.strokeStyle = colour;
        context.lineWidth = width;
        context.setLineDash(dash);
        context.beginPath();
        list.forEach(([from, to]) => path(from, to));
        context.stroke();
    };
    const letter = (text, p, colour) => {
        const place = placed(p), at = place && camera.project(place);
        if (at) {
            context.fillStyle = colour;
            context.fillText(text, at[0] + 6, at[1] - 6);
        }
    };
    const drawFrustum = () => {
        const from_clip = lessonInverse(scene.clip), ends = LESSON_ENDS[scene.convention];
        if (from_clip === null) {
            return;
        }
        const at = (x, y, z) => lessonDivided(lessonApply(from_clip, [x, y, z]));
        const corners = LESSON_CORNERS.map(([x, y, far]) => at(x, y, ends[far]));
        if (!corners.flat().every(Number.isFinite)) {
            return;
        }
        context.beginPath();
        [0, 1, 3, 2].forEach((corner, i) => {
            const place = placed(corners[corner]), seen = place && camera.project(place);
            if (seen) {
                context[i === 0 ? 'moveTo' : 'lineTo'](seen[0], seen[1]);
            }
        });
        context.fillStyle = colours.near;
        context.globalAlpha = 0.18;
        context.fill();
        context.globalAlpha = 1;
        lines(colours.frustum, 1.5, LESSON_EDGES.map(([a, b]) => [corners[a], corners[b]]));
        lines(colours.near, 2.5, [[0, 1], [1, 3], [3, 2], [2, 0]].map(([a, b]) => [corners[a], corners[b]]));
        letter('near', corners[1], colours.near);
        letter('far', corners[5], colours.frustum);
        if (scene.perspective && share === 0) {
            lines(colours.dim, 1, [0, 1, 2, 3].map((i) => [scene.eye, corners[i]]), [2, 4]);
        }
        if (scene.point) {
            const [x, y] = lessonDivided(lessonApply(scene.clip, scene.point)), hit = at(x, y, ends[0]);
            const from = scene.perspective && share === 0 ? scene.eye : hit;
            lines(colours.point, 2, [[from, scene.point]], [6, 4]);
            lines(colours.point, 2, [[hit, hit.map((c, i) => c + (i === 0 ? camera.radius / 60 : 0))]]);
        }
    };
    const showHandles = () => {
        for (const [name, button] of Object.entries(handles)) {
            const place = scene[name] && placed(scene[name]), at = place && camera.project(place);
            button.hidden = !at || (share > 0 && name !== 'point') || at[0] < 0 || at[1] < 0 || at[0] > camera.width || at[1] > camera.height;
            if (at) {
                button.style.left = `${at[0]}px`;
                button.style.top = `${at[1]}px`;
                button.setAttribute('aria-label', `${name === 'point' ? 'vertex' : name} at ${scene[name].map(lessonNumber).join(', ')}`);
            }
        }
    };
    const readColours = () => { // asking for them at each picture would compute the page's styles each time
        const style = getComputedStyle(element), colour = (name) => style.getPropertyValue(name).trim();
        colours = { dim: colour('--line'), ink: colour('--ink'), object: colour('--ink'), frustum: colour('--accent'), near: colour('--near'), point: colour('--warn') };
    };
    const paint = () => {
        if (scene === null || camera.width === 0) {
            return;
        }
        const ratio = window.devicePixelRatio;
        if (canvas.width !== Math.round(camera.width * ratio) || canvas.height !== Math.round(camera.height * ratio)) {
            canvas.width = Math.round(camera.width * ratio);
            canvas.height = Math.round(camera.height * ratio);
        }
        context.setTransform(ratio, 0, 0, ratio, 0, 0);
        context.clearRect(0, 0, camera.width, camera.height);
        context.font = '13px system-ui, sans-serif';
        const grid = Array.from({ length: 11 }, (_, i) => i - 5), floor = scene.floor;
        if (share === 0) {
            lines(colours.dim, 1, grid.flatMap((i) => [[[i, floor, -5], [i, floor, 5]], [[-5, floor, i], [5, floor, i]]].map((line) => line.map(([x, y, z]) => [x, y, z - 3]))));
            [[1, 0, 0], [0, 1, 0], [0, 0, 1]].forEach((axis, i) => {
                lines(colours.ink, 1, [[[0, 0, 0], axis]]);
                letter('xyz'[i], axis, colours.ink);
            });
        }
        lines(colours.object, 1.5, scene.object);
        if (scene.clip !== null) {
            drawFrustum();
        }
        if (share === 0) {
            lines(colours.dim, 1.5, [[scene.eye, scene.target]], [2, 4]);
        }
        showHandles();
    };
    const turn = (right, up) => {
        camera.yaw -= right;
        camera.pitch = Math.max(-1.5, Math.min(1.5, camera.pitch + up));
        paint();
    };
    const grab = (target, move) => {
        let last = null;
        target.addEventListener('pointerdown', (event) => {
            if (event.button === 0 && event.target === target) {
                target.setPointerCapture(event.pointerId);
                last = [event.clientX, event.clientY];
            }
        });
        target.addEventListener('pointermove', (event) => {
            if (last !== null) {
                move(event.clientX - last[0], event.clientY - last[1], last);
                last = [event.clientX, event.clientY];
            }
        });
        for (const end of ['pointerup', 'pointercancel']) {
            target.addEventListener(end, () => {
                last = null;
            });
        }
    };
    for (const [name, button] of Object.entries(handles)) {
        let exact = null; // where the pointer is; the point itself goes by steps
        button.addEventListener('pointerdown', () => {
            exact = scene[name];
        });
        grab(button, (right, down) => {
            const at = camera.project(exact), [x, y] = camera.axes();
            if (share === 0 && at) {
                exact = exact.map((c, i) => c + (x[i] * right - y[i] * down) * at[2]);
                moved(name, exact.map((c) => Math.round(c / WORLD_STEP) * WORLD_STEP));
            }
        });
        button.addEventListener('keydown', (event) => {
            const way = WORLD_KEYS[event.key];
            if (way !== undefined) {
                event.preventDefault();
                moved(name, scene[name].map((c, i) => c + way[i] * WORLD_STEP));
            }
        });
    }
    grab(canvas, (right, down) => turn(right / 120, down / 120));
    canvas.addEventListener('keydown', (event) => {
        const way = WORLD_KEYS[event.key];
        if (way !== undefined) {
            event.preventDefault();
            turn(-way[0] / 12, way[1] / 12);
            camera.near = Math.max(0.25, Math.min(4, camera.near * (1 + way[2] / 10)));
            paint();
        }
    });
    canvas.addEventListener('wheel', (event) => {
        event.preventDefault();
        camera.near = Math.max(0.25, Math.min(4, camera.near * Math.exp(event.deltaY / 1000)));
        paint();
    }, { passive: false });
    new ResizeObserver(([{ contentRect }]) => { // asking for a size each time would lay out the page each time
        camera.width = contentRect.width;
        camera.height = contentRect.height;
        paint();
    }).observe(element);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
        readColours();
        paint();
    });
    readColours();
    return {
        draw(next) {
            scene = next;
            camera.middle = lessonBetween(scene.eye, scene.target, 0.5);
            camera.radius = Math.max(2, lessonDistance(scene.eye, scene.target));
            paint();
        },
        morph(to) {
            share = to;
            paint();
        },
    };
}

// What is drawn of a state. view, lens: 16 numbers each as the convention writes them, or null; object: pairs of places.
export function lessonScene({ view, lens, convention, eye, target, point, object }) {
    const clip = view !== null && lens !== null ? lessonProduct(lens, view) : null;
    return { clip, convention, eye, target, point, object, perspective: lens === null || Math.abs(lens[14]) > 1e-6, away: convention === 'gl' || convention === 'd3d' ? -1 : 1, floor: -1 };
}

// The edges of the demo cube, which is 2 units wide.
export const lessonCube = (corner = (p) => p) => LESSON_EDGES.map((edge) => edge.map((i) => corner([LESSON_CORNERS[i][0], LESSON_CORNERS[i][1], -2 - 2 * LESSON_CORNERS[i][2]])));
