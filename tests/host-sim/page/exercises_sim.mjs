// Usage: node exercises_sim.mjs PINHOLE-SIM INSTANCES STEP
// Compares answers of the exercises of the page's lesson with what pinhole-sim prints for the same numbers: so many instances
// of every STEPth exercise. Where Pinhole's own numbers are exact, its fractions must be the answers; elsewhere 1/1000 is allowed.
import { execFileSync } from 'node:child_process';
import { exercises } from '../../../host-sim/page/lesson/lesson_exercises.mjs';
import { fixed16, generator, plates, q } from './exercise_answers.mjs';

const [simulator, instances, step] = process.argv.slice(2);
const wrong = [];

// What a run prints: labels and their fractions, elements of matrices as NAME.ROW.COLUMN.
function run(options, ...flags) {
    const words = options.map(([name, value]) => `--${name}=${value}`), found = {};
    let matrix = '', row = 0;
    for (const line of execFileSync(simulator, ['--demo', 'cube', ...words, ...flags], { encoding: 'utf8', stdio: 'pipe' }).trim().split('\n')) {
        const list = line.split(' ');
        if (list.length === 1) {
            [matrix, row] = [line, 0];
        } else if (/^[A-Za-z]/.test(line)) {
            found[list[0]] = list[1] === '-' ? list[2] : list[1];
        } else {
            list.forEach((value, column) => (found[`${matrix}.${row}.${column}`] = value));
            row++;
        }
    }
    return found;
}

const numberOf = (text) => text.split('/').reduce((over, under) => over / under);
function compare(id, found, labels, answer, exact) {
    const words = String(answer).replaceAll(';', '').split(' ');
    labels.split(' ').forEach((label, i) => {
        const is = found[label] ?? '-', near = Math.abs(numberOf(is) - numberOf(words[i])) <= 0.001 * Math.max(1, Math.abs(numberOf(words[i])));
        if (exact ? is !== words[i] : !near) {
            wrong.push(`${id}: ${label} is ${is} in pinhole-sim, ${words[i]} in the exercise`);
        }
    });
}

const cells = (name, rows, columns) => rows.flatMap((row) => columns.map((column) => `${name}.${row}.${column}`)).join(' ');
const xyz = (stage) => ['x', 'y', 'z'].map((name) => `${stage}.${name}`).join(' ');
const without = (options, ...names) => options.filter(([name]) => !names.includes(name));
const rows = (answer, count) => answer.split('; ').slice(0, count).join(' ');

// id: (instance, answers, same(found, labels, answer, exact))
const reads = {
    'haw-1': ({ options }, [height, width], same) => same(run(options), 'size.y size.x', `${height} ${width}`, true),
    'haw-2': ({ options }, [matrix], same) => same(run(options, '--matrix', 'factors'), cells('camera', [0, 1, 2], [0, 1, 2, 3]), rows(matrix, 3)),
    'haw-3': ({ options }, [seen], same) => same(run(options), xyz('view'), seen, true),
    'haw-4': ({ options }, [, seen], same) => same(run(options), 'divided.x divided.y', seen),
    'haw-5': ({ options }, [, , ndc], same) => same(run(options), 'ndc.z', ndc, true),
    'haw-6': ({ options }, [matrix, ndc], same) => {
        const found = run(options, '--matrix');
        same(found, cells('projection', [0, 1, 2, 3], [0, 1, 2, 3]), rows(matrix, 4));
        same(found, xyz('ndc'), ndc, true);
    },
    pixel: ({ options }, [x, y], same) => same(run(options), 'pixel.x pixel.y', `${x} ${y}`, true),
    'hidden-camera': ({ options, text }, [x, y, z], same) => {
        const [, place, seen] = /A = \((.*)\) at the pixel \((.*)\)/.exec(text), camera = ['camera', `eye=${x},${y},${z},target=${x},${y},${z - 1}`];
        same(run(options), 'world.x', /-?\d+/.exec(place)[0], true); // the address does not say where it is, but shows A
        same(run([...without(options, 'camera', 'point'), camera, ['point', place.replaceAll(' ', '')]]), 'pixel.x pixel.y', seen.replace(',', ''), true);
    },
    near: ({ options, text }, [code, near], same) => {
        const { front, back, far } = plates(text), at = (plate, n) => run([...without(options, 'point', 'near'), ['near', numberOf(n)], ['point', `0,0,${-numberOf(plate.join('/'))}`]]);
        same(run(options), 'depth.fixed16', code, true);
        same(at(front, near), 'depth.fixed16', fixed16(q(near), far, front)[0], true);
        same(at(back, near), 'depth.fixed16', fixed16(q(near), far, back)[0], true);
    },
    clipping: () => {}, // pinhole-sim has no option for it
    'kaist-view': ({ options }, [, rotation, column], same) => {
        const found = run(options, '--matrix', 'factors');
        same(found, cells('R', [0, 1, 2], [0, 1, 2]), rotation);
        same(found, cells('view', [0, 1, 2], [3]), column);
    },
    flatten: ({ options }, [drop, byZ, w, seen], same) => {
        const found = run(options), parallel = (which) => run([...without(options, 'flatten'), ['flatten', which]]);
        same(parallel('kaist-4.7'), `${xyz('flatten')} flatten.w`, drop, true);
        same(parallel('kaist-4.11'), 'divided.x divided.y', byZ, true);
        same(found, 'flatten.w', w);
        same(found, xyz('divided'), seen);
    },
    4600: ({ options }, [tangent, , pq, depth, pixel], same) => {
        const found = run(options, '--matrix');
        same(found, 'projection.1.1', numberOf(tangent) ** -1);
        same(found, 'projection.2.2 projection.2.3', pq);
        same(found, 'ndc.z', depth, true);
        same(found, 'pixel.x pixel.y', pixel);
    },
    order: ({ options }, [, , seen], same) => same(run(options), xyz('view'), seen),
    sense: ({ options }, [, seen], same) => same(run(options), xyz('view'), seen),
    'eece-mistakes': ({ options, text }, [, column, corner, clip], same) => {
        const [l, r, b, t, , f] = /l = .*f = \d+/.exec(text)[0].match(/-?\d+/g), window = [...without(options, 'projection', 'point'), ['projection', `frustum=${l},${r},${b},${t}`]];
        const found = run(options, '--matrix'), at = (place) => run([...window, ['point', place]]);
        same(found, cells('projection', [0, 1, 2], [3]), column);
        same(found, xyz('ndc'), '-1 -1 -1');
        same(at(`${r},${t},${-f}`), `${xyz('clip')} clip.w`, clip);
        if (/^[-\d ]*$/.test(corner)) { // an option has no fraction
            same(at(corner.replaceAll(' ', ',')), xyz('ndc'), '1 1 1');
        }
    },
    chain: ({ options }, [, seen, w, ndc], same) => same(run(options), `${xyz('view')} clip.w ndc.x ndc.y`, `${seen} ${w} ${ndc}`),
    'half-distance': ({ options }, [, , height], same) => same(run(options), 'ndc.y', height, true),
    square: ({ options, text }, [, share], same) => {
        const [wide, high, distance] = text.match(/\d+/g), found = run(options);
        same(found, 'size.y fill.distance', `${high} ${distance}`);
        same(found, 'size.x', wide / numberOf(share));
    },
    'lmu-mistakes': ({ options }, [x, y, w], same) => same(run(options), 'ndc.x ndc.y clip.w', `${x} ${y} ${w}`, true),
};

for (const { id, make } of exercises.filter((_, i) => i % step === 0)) {
    const random = generator(2);
    for (let i = 0; i < instances; i++) {
        const made = make(random), instance = { ...made, options: [...new URLSearchParams(made.address.slice(1))].slice(1) };
        try {
            reads[id](instance, instance.parts.map((part) => part.answer), (...what) => compare(id, ...what));
        } catch (error) {
            wrong.push(`${id}: ${error.message}`);
        }
    }
}
console.log(wrong.slice(0, 20).join('\n') || `${instances} instances of each`);
process.exit(wrong.length === 0 && instances > 0 && step > 0 ? 0 : 1);
