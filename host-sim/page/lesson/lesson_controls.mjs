// lesson_controls: sliders and choices of the lesson's camera, as options of pinhole-sim.
import { lessonNumber, lessonPlace, readLessonCamera, writeLessonCamera } from './lesson_state.mjs';

const lessonDegrees = (half) => 360 / Math.PI * Math.atan(half);
const lessonTangent = (degrees) => Math.tan(degrees * Math.PI / 360);
const LESSON_USUAL = { fov: '60', near: '0.5', far: '100', projection: 'perspective', convention: 'gl', size: '240x240', point: '', camera: '' };

// input(name) is the control of a name; set(changes) takes { option: value } of pinhole-sim; where() tells { eye, target } of the
// camera that is shown, and size() its picture. Returns what shows the state.
export function watchLessonControls(input, state, set, where, size) {
    const value = (name) => state().get(name) ?? LESSON_USUAL[name];
    const places = () => readLessonCamera(state().get('camera')) ?? { ...where(), up: '' };
    const distanceOf = ({ eye, target }) => Math.hypot(...eye.map((x, i) => x - target[i]));
    // The camera at another distance from its target.
    const moveTo = (distance) => {
        const camera = places(), by = distance / (distanceOf(camera) || 1);
        return writeLessonCamera({ ...camera, eye: camera.eye.map((x, i) => camera.target[i] + (x - camera.target[i]) * by) });
    };
    const isLocked = () => input('lock').checked && !value('projection').startsWith('fisheye');
    const take = {
        fov(text) {
            const distance = distanceOf(places()) * lessonTangent(value('fov')) / lessonTangent(text);
            set({ fov: text, ...(isLocked() ? { camera: moveTo(distance) } : {}) });
        },
        distance(text) {
            const fov = lessonDegrees(lessonTangent(value('fov')) * distanceOf(places()) / text);
            set({ camera: moveTo(+text), ...(isLocked() ? { fov: lessonNumber(fov) } : {}) });
        },
        aspect(text) {
            const [, height] = size();
            set({ size: `${Math.max(1, Math.min(1024, Math.round(height * text)))}x${height}` });
        },
    };
    // LMU writes both planes as coordinates, or both as distances.
    const takePlane = (name, other) => (text) => set({ [name]: value('convention') === 'lmu' && value(other).startsWith('-') ? lessonNumber(-Math.abs(text)) : text });
    take.near = takePlane('near', 'far');
    take.far = takePlane('far', 'near');
    for (const name of ['fov', 'near', 'far', 'distance', 'aspect']) {
        for (const part of [input(name), input(`${name}-text`)]) {
            part.addEventListener(part.type === 'range' ? 'input' : 'change', () => {
                take[name](lessonNumber(+part.value));
            });
        }
    }
    for (const name of ['projection', 'convention', 'size', 'point', 'camera']) {
        input(name).addEventListener('change', () => set({ [name]: input(name).value.trim() }));
    }
    input('show').addEventListener('change', () => set({ show: input('show').checked ? 'depth' : '' }));
    const showNumber = (name, number) => {
        for (const part of [input(name), input(`${name}-text`)]) {
            const must = part.type === 'range' ? Math.abs(number) : number;
            if (+part.value !== +must || part.value === '') {
                part.value = must;
            }
        }
    };
    return () => {
        const [width, height] = size();
        showNumber('fov', state().get('fov') ?? (value('projection') === 'fisheye' ? '180' : '60'));
        showNumber('near', value('near'));
        showNumber('far', value('far'));
        showNumber('distance', lessonNumber(distanceOf(places())));
        showNumber('aspect', lessonNumber(width / height));
        const kinds = [...input('projection').options].map((option) => option.value);
        if (!kinds.includes(value('projection'))) {
            input('projection').add(new Option(value('projection')));
        }
        for (const name of ['projection', 'convention', 'size', 'point', 'camera']) {
            input(name).value = value(name);
        }
        input('show').checked = value('show') === 'depth';
    };
}

// Turns an eye around its target by angles, and by a share of the distance.
export function lessonOrbit({ eye, target }, right, up, nearer) {
    const [x, y, z] = eye.map((c, i) => c - target[i]), flat = Math.hypot(x, z), length = Math.hypot(flat, y) * nearer;
    const yaw = Math.atan2(x, z) - right, pitch = Math.max(-1.5, Math.min(1.5, Math.atan2(y, flat) + up));
    return [Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch), Math.cos(yaw) * Math.cos(pitch)].map((c, i) => +(target[i] + c * length).toFixed(3));
}

export const lessonPoint = (state) => (/^-?[\d.]+(,-?[\d.]+){2}$/.test(state.get('point') ?? '') ? lessonPlace(state.get('point')) : null);
