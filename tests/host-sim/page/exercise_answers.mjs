// exercise_answers: the answers of the exercises of the page's lesson, and typical wrong ones with a word of what is to be said
// to each. They are worked out from the text that a student reads, by arithmetic of its own: pairs of BigInts, matrices of
// OpenGL's glFrustum, cross products. A wrong answer is made as a student makes it, by the wrong transform.

// ---- arithmetic ------------------------------------------------------------------------------------------------------------

export const q = (value, under = 1) => {
    if (Array.isArray(value)) {
        return div(value, q(under));
    }
    const [over, below = '1'] = String(value).split('/');
    return div([BigInt(over), BigInt(below)], [BigInt(under), 1n]);
};
const div = ([a, b], [c, d]) => (c < 0n ? [-a * d, -b * c] : [a * d, b * c]);
const mul = (...values) => values.map((value) => (Array.isArray(value) ? value : q(value))).reduce(([a, b], [c, d]) => [a * c, b * d]);
const add = (...values) => values.map((value) => (Array.isArray(value) ? value : q(value))).reduce(([a, b], [c, d]) => [a * d + c * b, b * d]);
const neg = (value) => mul(-1, value);
const over = (value, under) => div(mul(value), mul(under));
export const equal = ([a, b], [c, d]) => a * d === c * b;
export const less = (one, other) => add(one, neg(other))[0] < 0n;
const floor = ([a, b]) => q((a - (((a % b) + b) % b)) / b);
const divisor = (a, b) => (b === 0n ? (a < 0n ? -a : a) : divisor(b, a % b));
export const reduced = ([a, b]) => [a / divisor(a, b), b / divisor(a, b)];
// An answer, or a wrong one, as a list of fractions, and as a student types it.
export const listOf = (value) => (Array.isArray(value) && !(typeof value[0] === 'bigint') ? value.map((item) => (Array.isArray(item) ? item : q(item))) : [Array.isArray(value) ? value : q(value)]);
export const textOf = (value) => (typeof value === 'string' ? value : listOf(value).map(reduced).map(([a, b]) => `${a}/${b}`).join(' '));
const root = (value) => over(...reduced(value).map((part) => q(Math.sqrt(Number(part)))));
const times = (left, right) => left.map((row) => right[0].map((_, j) => add(...row.map((value, k) => mul(value, right[k][j])))));
const on = (matrix, point) => times(matrix, point.map((value) => [value])).map(([value]) => value);
const transposed = (matrix) => matrix[0].map((_, j) => matrix.map((row) => row[j]));
const cross = (a, b) => [0, 1, 2].map((i) => add(mul(a[(i + 1) % 3], b[(i + 2) % 3]), neg(mul(a[(i + 2) % 3], b[(i + 1) % 3]))));
const unit = (a) => a.map((value) => over(value, root(add(...a.map((part) => mul(part, part))))));
const minus = (a, b) => a.map((value, i) => add(value, neg(b[i])));
const plus = (a, b) => a.map((value, i) => add(value, b[i]));
const flip = (values, ...which) => values.map((value, i) => (which.includes(i) ? neg(value) : mul(value)));
const divided = (clip) => clip.slice(0, 3).map((value) => over(value, clip[3]));
const UP = [0, 1, 0];

// Columns x, y, z and the position of a camera at eye that looks at target.
function cameraAxes(eye, target) {
    const forward = unit(minus(target, eye)), right = unit(cross(forward, UP));
    return [right, cross(right, forward), forward.map(neg)];
}
const withPlace = (columns, place) => [...transposed([...columns, place]), [0, 0, 0, 1]];
const rigidInverse = (columns, place) => [...columns.map((axis) => [...axis, neg(add(...axis.map((value, i) => mul(value, place[i]))))]), [0, 0, 0, 1]];

// glFrustum's matrix, and gluPerspective's as one of its windows.
const frustum = (l, r, b, t, n, f) => [
    [over(mul(2, n), add(r, neg(l))), 0, over(add(r, l), add(r, neg(l))), 0],
    [0, over(mul(2, n), add(t, neg(b))), over(add(t, b), add(t, neg(b))), 0],
    [0, 0, over(add(f, n), add(n, neg(f))), over(mul(2, f, n), add(n, neg(f)))],
    [0, 0, -1, 0],
];
const perspective = (tangent, aspect, n, f) => {
    const top = mul(tangent, n), right = mul(top, aspect);
    return frustum(neg(right), right, neg(top), top, n, f);
};
// A right-handed rotation by an angle with this sine and cosine, by the formula of Rodrigues.
function turn(axis, sine, cosine, point) {
    const along = mul(point[axis], add(1, neg(cosine))), direction = [0, 1, 2].map((i) => (i === axis ? 1 : 0)), around = cross(direction, point);
    return point.map((value, i) => add(mul(value, cosine), mul(around[i], sine), mul(direction[i], along)));
}

// ---- random numbers, the same in each run -----------------------------------------------------------------------------------

export function generator(seed) { // mulberry32
    return () => {
        seed = (seed + 0x6d2b79f5) | 0;
        let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
        t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
        return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
    };
}

// ---- what the texts say ----------------------------------------------------------------------------------------------------

const numbers = (text) => [...text.matchAll(/-?\d+(?:\/\d+)?/g)].map(([number]) => q(number));
const after = (text, pattern) => numbers(text.slice(text.search(pattern)).replace(pattern, ''));
const tangentOf = (text) => (/field of view of 90/.test(text) ? q(1) : after(text, /2 atan\(/)[0]);
const sizeOf = (text) => /(\d+) pixels wide and (\d+) high/.exec(text).slice(1).map((number) => q(number));
const doubled = (tangent) => (equal(tangent, q(1)) ? null : over(mul(2, tangent), add(1, neg(mul(tangent, tangent)))));
const axisOf = (text) => 'xyz'.indexOf(/about (?:the )?([xyz])/.exec(text)[1]);

// ---- the exercises ---------------------------------------------------------------------------------------------------------
// id: (text, labels) => { answers: [...], wrongs: [[part, value, pattern], ...] }. A value is a number, an array of them or a
// word; null where it does not exist. within: [[value, low, high], ...], what must lie between two numbers for the text to be true.

const ball = (text) => {
    const tangent = tangentOf(text), [w, h] = sizeOf(text), [z] = after(text, /z_c = -/), [radius] = after(text, /radius /);
    const height = over(2, divided(on(perspective(tangent, q(1), q(1), q(100)), [0, 1, neg(z), 1]))[1]); // what is 1 high has this share
    const wide = over(mul(height, w), h), limit = add(over(wide, 2), neg(radius)), full = doubled(tangent);
    return {
        answers: [height, wide, limit],
        wrongs: [[0, neg(height), /z_c is negative/], [0, over(height, 2), /half of the height/], [0, full && mul(full, 2, z), /whole angle/],
            [0, full ? null : mul(45, 2, z), /degrees/], [0, full ? null : mul(90, 2, z), /degrees/], [1, over(mul(height, h), w), /upside down/],
            [1, height, /is the height/], [2, over(wide, 2), /radius/], [2, add(wide, neg(radius)), /half of the width/],
            [2, add(over(wide, 2), radius), /outside/]],
    };
};

const lookAt = (text) => {
    const list = numbers(text), eye = list.slice(0, 3), target = list.slice(3, 6), axes = cameraAxes(eye, target), right = withPlace(axes, eye);
    return {
        answers: [right.flat()],
        wrongs: [[0, transposed(right).flat(), /transposed/], [0, rigidInverse(axes, eye).flat(), /inverse/],
            [0, withPlace([flip(axes[0], 0, 1, 2), axes[1], flip(axes[2], 0, 1, 2)], eye).flat(), /positive z/],
            [0, withPlace(transposed(axes), eye).flat(), /other sense/], [0, withPlace(axes, eye.map(neg)).flat(), /-eye/]],
    };
};

const snake = (text) => {
    const list = numbers(text), eye = list.slice(0, 3), forward = list.slice(3, 6), apple = list.slice(9, 12);
    const axes = cameraAxes(eye, plus(eye, forward)), seen = on(axes, minus(apple, eye));
    return {
        answers: [seen],
        wrongs: [[0, flip(seen, 2), /negative z/], [0, flip(seen, 0), /Left and right/], [0, minus(apple, eye), /only translated/],
            [0, on(axes, apple), /not translated/], [0, minus(on(axes, apple), eye), /translate first/],
            [0, on(transposed(axes), minus(apple, eye)), /other sense/]],
    };
};

// Through the normal and the distance of the line, times the length of that normal.
const line = (text, labels) => {
    const [a, , , b] = numbers(text), point = numbers(labels[1]), r = numbers(labels[2]), normal = [b, a], distance = mul(a, b); // b x + a y = a b, where b is below 0
    const matrix = [[distance, 0, 0], [0, distance, 0], [...normal, 0]], [x, y, w] = on(matrix, [...point, 1]), seen = [over(x, w), over(y, w)];
    return {
        answers: [matrix.flat(), seen, on(matrix, [...r, 1])[2]],
        wrongs: [[0, transposed(matrix).flat(), /transposed/], [0, [...matrix[0], ...matrix[1], ...flip(matrix[2], 0, 1)], /other sign/],
            [1, point, /not divided/], [1, seen.map(neg), /other side/],
            [2, add(mul(r[0], over(1, a)), mul(r[1], over(-1, b))), /minus sign/], [2, 1, /before the matrix/]],
    };
};

const depth = (text, labels) => {
    const n = after(text, /g\(-/)[0], f = after(text, /plane, and g\(-/)[0], z = numbers(labels[2])[0];
    const [, , row] = frustum(-1, 1, -1, 1, n, f), [a, b] = [neg(row[2]), neg(row[3])];
    const right = divided(on(frustum(-1, 1, -1, 1, n, f), [0, 0, z, 1]))[2], nought = over(neg(b), a);
    return {
        answers: [a, b, right, nought],
        within: [[right, -1, 1]],
        wrongs: [[0, neg(a), /sign/], [0, over(1, a), /upside down/], [1, neg(b), /sign/], [1, over(b, 2), /factor of 2/],
            [2, add(a, over(b, neg(z))), /negative/],
            [2, add(-1, over(mul(2, add(neg(z), neg(n))), add(f, neg(n)))), /curved/], [2, over(add(right, 1), 2), /0 to 1/],
            [3, neg(nought), /negative z/], [3, over(add(n, f), -2), /middle/]],
    };
};

const lens = (text, labels) => {
    const list = numbers(text), wide = /Camera\(90/.test(text), tangent = wide ? q(1) : list[1], [aspect, n, f] = list.slice(wide ? 1 : 2);
    const a = numbers(labels[1]);
    const matrix = perspective(tangent, aspect, n, f), clip = on(matrix, [...a, 1]), ndc = divided(clip), full = doubled(tangent);
    const other = (rows) => matrix.map((row, i) => rows[i] ?? row).flat();
    return {
        answers: [matrix.flat(), ndc],
        wrongs: [[0, transposed(matrix).flat(), /transposed/], [0, other({ 3: [0, 0, 1, 0] }), /w would be z/],
            [0, other({ 2: flip(matrix[2], 0, 1, 2, 3) }), /third row/],
            [0, other({ 0: [matrix[1][1], 0, 0, 0], 1: [0, matrix[0][0], 0, 0] }), /wrong row/],
            [0, full && perspective(full, aspect, n, f).flat(), /whole angle/], [0, full ? null : perspective(q(45), aspect, n, f).flat(), /degrees/],
            [0, other({ 2: [0, 0, over(f, add(n, neg(f))), over(mul(n, f), add(n, neg(f)))] }), /0 to 1/], [1, clip.slice(0, 3), /division/],
            [1, ndc.map(neg), /divided by z/], [1, flip(ndc, 2), /other sign/]],
    };
};

const pixelOf = (ndc, [w, h]) => [over(mul(w, add(1, ndc[0])), 2), over(mul(h, add(1, neg(ndc[1]))), 2)];

const pixel = (text) => {
    const size = sizeOf(text), tangent = tangentOf(text), eye = numbers(text)[2], point = after(text, /the vertex \(/);
    const view = [point[0], point[1], add(point[2], neg(eye))];
    const clip = on(perspective(tangent, over(...size), q(1), q(100)), [...view, 1]), ndc = divided(clip), [x, y] = pixelOf(ndc, size);
    const [badX, badY] = pixelOf(clip, size), half = q('1/2');
    return {
        answers: [x, y, [floor(x), floor(y)]],
        within: [[x, 0, size[0]], [y, 0, size[1]]],
        wrongs: [[0, ndc[0], /viewport/], [0, add(x, neg(over(size[0], 2))), /middle/], [0, badX, /division by w/],
            [0, pixelOf([mul(ndc[0], over(...size)), 0], size)[0], /aspect/], [0, pixelOf(flip(ndc, 0), size)[0], /swapped/],
            [0, add(x, neg(half)), /half pixel/], [1, pixelOf(flip(ndc, 1), size)[1], /downwards/], [1, badY, /division by w/],
            [1, add(y, neg(over(size[1], 2))), /middle/], [1, add(y, neg(half)), /half pixel/],
            [2, [floor(add(x, half)), floor(add(y, half))], /whole part/]],
    };
};

// The distance from two rays, each from its pixel.
const hidden = (text) => {
    const size = sizeOf(text), tangent = tangentOf(text), [ax, ay, az, apx, apy] = after(text, /A = \(/), [bx, , , bpx] = after(text, /B = \(/);
    const slope = (px, side) => mul(add(over(mul(2, px), size[side]), -1), tangent, side === 0 ? over(...size) : 1), dx = slope(apx, 0);
    const dy = neg(slope(apy, 1));
    const w = over(add(bx, neg(ax)), add(slope(bpx, 0), neg(dx))), x = add(ax, neg(mul(dx, w))), y = add(ay, neg(mul(dy, w)));
    return {
        answers: [x, y, add(az, w)],
        within: [[apx, 0, size[0]], [bpx, 0, size[0]], [apy, 0, size[1]]],
        wrongs: [[0, add(ax, mul(dx, w)), /other way/], [1, add(ay, mul(dy, w)), /downwards/], [2, add(az, neg(w)), /-z/], [2, w, /distance to A/],
            [2, add(az, mul(w, over(...size))), /aspect/], [2, add(az, w, w), /2 over/]],
    };
};

export const fixed16 = (n, f, w) => floor(add(mul(65536, over(511, 512), over(mul(n, f), add(f, neg(n))), add(over(1, w), neg(over(1, f)))), q('65/4')));
// The distances that the exercise `near` states.
export function plates(text) {
    const [front, back, far] = after(text, /distances /);
    return { front, back, far, first: after(text, /With near /)[0] };
}
const near = (text) => {
    const { front, back, far, first } = plates(text), scale = mul(65536, q('511/512'), first);
    let found = first;
    while (equal(fixed16(found, far, front), fixed16(found, far, back))) {
        found = mul(2, found);
    }
    return {
        answers: [fixed16(first, far, front), found],
        wrongs: [[0, floor(mul(scale, over(far, add(far, neg(first))), add(over(1, front), neg(over(1, far))))), /16 1\/4/],
            [0, add(1, fixed16(first, far, front)), /not rounded/],
            [0, floor(add(mul(scale, over(1, front), over(far, add(far, neg(first)))), q('65/4'))), /N\/f is missing/], [1, first, /makes it worse/],
            [1, add(front, q('1/8')), /cut away/], [1, q(-1), /above 0/], [1, q(0), /above 0/]],
    };
};

// Clips by all six planes, one after the other (Sutherland and Hodgman).
const clipping = (text) => {
    const list = after(text, /A = \(/), corners = [0, 4, 8].map((i) => list.slice(i, i + 4));
    const planes = [0, 1, 2].flatMap((axis) => [1, -1].map((side) => (p) => add(p[3], neg(mul(side, p[axis])))));
    const between = (a, b, share) => a.map((value, i) => add(value, mul(share, add(b[i], neg(value)))));
    const left = planes.reduce((polygon, plane) => polygon.flatMap((a, i) => {
        const b = polygon[(i + 1) % polygon.length], [da, db] = [plane(a), plane(b)], inA = da[0] >= 0n, inB = db[0] >= 0n;
        return [...(inA ? [a] : []), ...(inA !== inB ? [between(a, b, over(da, add(da, neg(db))))] : [])];
    }), corners);
    const [a, , c] = corners, at = planes.findIndex((plane) => plane(c)[0] < 0n), [da, dc] = [a, c].map(planes[at]);
    const share = over(da, add(da, neg(dc))), corner = between(a, c, share);
    return {
        answers: [q(left.length), corner],
        wrongs: [[0, q(7 - left.length), /edge that crosses/], [0, q(5), /two edges/], [1, between(c, a, share), /other end/],
            [1, between(a, c, q('1/2')), /middle/],
            [1, c.map((value, i) => (i === at >> 1 ? mul(at % 2 === 0 ? 1 : -1, c[3]) : value)), /another direction/],
            [1, corner.map((value) => over(value, corner[3])), /before the division/]],
    };
};

const factors = (text) => {
    const list = numbers(text), eye = list.slice(0, 3), target = list.slice(3, 6), rows = cameraAxes(eye, target), column = on(rows, eye).map(neg);
    return {
        answers: [rows[1], rows.flat(), column],
        wrongs: [[0, UP, /given up vector/], [0, rows[1].map(neg), /l x r/], [1, transposed(rows).flat(), /transposed/],
            [1, [...rows[0], ...rows[1], ...rows[2].map(neg)], /third row is -l/],
            [2, eye.map(neg), /T R/], [2, column.map(neg), /-eye/], [2, on(transposed(rows), eye).map(neg), /transposed/]],
    };
};

const flatten = (text, labels) => {
    const [x, y, z] = numbers(text), d = after(text, /d = /)[0], step = after(labels[4], /back by /)[0];
    const drop = on([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0], [0, 0, 0, 1]], [x, y, z, 1]);
    const eece = on([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, over(1, d), 0]], [x, y, z, 1]), seen = divided(eece);
    return {
        answers: [drop, [over(x, z), over(y, z)], eece[3], seen, over(mul(y, d), add(z, step))],
        wrongs: [[0, [x, y, z, 1], /z is dropped/], [0, [x, y, 0, z], /stays 1/], [1, [x, y], /division/],
            [1, [over(x, neg(z)), over(y, neg(z))], /-z/], [2, over(d, z), /upside down/], [2, z, /KAIST's w/],
            [3, [x, y, z], /division/], [3, [seen[0], seen[1], z], /z is divided, too/], [4, over(mul(y, d), add(z, neg(step))), /further away/],
            [4, over(mul(y, add(d, step)), add(z, step)), /internal/]],
    };
};

const notes = (text) => {
    const size = sizeOf(text), [screen, focal, n, f] = after(text, /screen is /), [x, y, z] = after(text, /The point is \(/);
    const tangent = over(screen, mul(2, focal)), gl = perspective(tangent, over(...size), n, f);
    const ndc = divided(on(gl, [x, y, neg(z), 1])), depth01 = over(add(1, ndc[2]), 2), p = over(f, add(f, neg(n))), qq = neg(mul(p, n));
    const [px, py] = pixelOf(ndc, size);
    return {
        answers: [tangent, over(mul(y, focal), z), [p, qq], depth01, [px, py]],
        within: [[px, 0, size[0]], [py, 0, size[1]], [depth01, 0, 1]],
        wrongs: [[0, mul(2, tangent), /halved/], [0, over(1, tangent), /upside down/], [1, over(y, z), /focal length/],
            [2, [p, neg(qq)], /minus sign/], [2, [neg(gl[2][2]), gl[2][3]], /-1 to 1/], [2, [qq, p], /swapped/],
            [3, over(add(z, neg(n)), add(f, neg(n))), /curved/], [3, ndc[2], /-1 to 1/], [4, [px, add(size[1], neg(py))], /downwards/],
            [4, [pixelOf([mul(ndc[0], over(...size)), 0], size)[0], py], /aspect/]],
    };
};

const order = (text) => {
    const axis = axisOf(text), [degrees] = numbers(text), sine = over(degrees, 90), [x, y, z, ...rest] = after(text, /translates by \(/);
    const shift = [x, y, z], point = rest.slice(0, 3);
    const turned = (p, sense = 1) => turn(axis, mul(sense, sine), q(0), p), trp = plus(turned(point), shift);
    const rtp = turned(plus(point, shift)), view = turned(minus(point, shift), -1);
    return {
        answers: [trp, rtp, view],
        wrongs: [[0, rtp, /reversed/], [0, plus(turned(point, -1), shift), /other sense/], [1, trp, /reversed/],
            [1, turned(plus(point, shift), -1), /other sense/], [2, minus(turned(point, -1), shift), /reversed/], [2, trp, /inverse/],
            [2, turned(minus(point, shift)), /inverted/]],
    };
};

const sense = (text, labels) => {
    const axis = axisOf(text), [sine, cosine] = after(text, /with sine /), vector = numbers(labels[0]).slice(0, 3);
    const list = numbers(labels[1]), eye = list.slice(0, 3), point = list.slice(3, 6);
    return {
        answers: [turn(axis, sine, cosine, vector), turn(axis, neg(sine), cosine, minus(point, eye))],
        wrongs: [[0, turn(axis, neg(sine), cosine, vector), /sense/], [0, turn(axis, cosine, sine, vector), /swapped/],
            [1, turn(axis, sine, cosine, minus(point, eye)), /other sense/], [1, minus(turn(axis, neg(sine), cosine, point), eye), /reversed/],
            [1, minus(point, eye), /only translated/]],
    };
};

const eeceMistakes = (text) => {
    const [l, r, b, t, n, f] = numbers(text.slice(text.search(/l = /))), middle = (low, high) => over(add(low, high), add(low, neg(high)));
    const column = [middle(l, r), middle(b, t), middle(n, f)];
    const clip = on(frustum(l, r, b, t, n, f), [r, t, neg(f), 1]), corner = [over(mul(r, f), n), over(mul(t, f), n), neg(f)];
    return {
        answers: [add(over(mul(2, l), add(r, neg(l))), neg(column[0])), column, corner, clip],
        wrongs: [[0, q(-1), /should be/], [1, column.map(neg), /slide's/], [1, flip(column, 2), /z has the same/], [2, [r, t, neg(f)], /slide's/],
            [2, flip(corner, 2), /z is negative/], [3, [n, n, n, n], /slide says/], [3, [f, f, f, f], /real far corner/],
            [3, clip.map((value) => over(value, f)), /divided by w/]],
    };
};

const chain = (text) => {
    const scale = after(text, /scales by /)[0], sine = over(after(text, /R turns by /)[0], 90);
    const shift = after(text, /T translates by \(/).slice(0, 3), point = after(text, /p = \(/).slice(0, 3);
    const around = over(after(text, /V is turned by /)[0], 90), eye = after(text, /moved to \(/).slice(0, 3);
    const scaled = (p) => p.map((value) => mul(value, scale));
    const world = plus(turn(1, sine, q(0), scaled(point)), shift), seen = turn(1, neg(around), q(0), minus(world, eye));
    const clip = on(perspective(q(1), q(1), q(1), q(100)), [...seen, 1]), ndc = divided(clip).slice(0, 2);
    return {
        answers: [world, seen, clip[3], ndc],
        wrongs: [[0, turn(1, sine, q(0), plus(scaled(point), shift)), /reversed/],
            [0, scaled(plus(turn(1, sine, q(0), point), shift)), /S comes last/],
            [0, plus(turn(1, neg(sine), q(0), scaled(point)), shift), /other sense/],
            [1, plus(turn(1, around, q(0), world), eye), /not its inverse/], [1, minus(turn(1, neg(around), q(0), world), eye), /reversed/],
            [1, turn(1, around, q(0), minus(world, eye)), /inverted/], [2, neg(clip[3]), /-z/],
            [3, seen.slice(0, 2), /division/], [3, ndc.map(neg), /divided by z/]],
    };
};

const half = (text, labels) => {
    const distance = after(text, /at the distance /)[0], tangent = tangentOf(text), [height, behind] = numbers(labels[2]), there = over(distance, 2);
    const fresh = over(mul(tangent, distance), there), sizeAt = (t, far) => divided(on(perspective(t, q(1), q('1/8'), q(100)), [0, height, neg(far), 1]))[1];
    return {
        answers: [fresh, over(1, fresh), sizeAt(fresh, add(there, behind))],
        wrongs: [[0, over(tangent, 2), /other way/], [0, doubled(tangent), /doubles the angle/], [0, tangent, /same lens/],
            [1, over(2, tangent), /longer focal/], [1, over(1, tangent), /same lens/],
            [2, sizeAt(tangent, add(distance, behind)), /before the move/], [2, sizeAt(tangent, add(there, behind)), /lens has changed/],
            [2, sizeAt(fresh, add(distance, behind)), /nearer to the column/]],
    };
};

const square = (text) => {
    const [wide, high, distance] = numbers(text), [w, h] = sizeOf(text), tangent = over(over(high, 2), distance), shown = mul(2, distance, tangent, over(w, h));
    return {
        answers: [tangent, over(wide, shown), over(mul(h, wide), high)],
        wrongs: [[0, mul(2, tangent), /halved/], [0, over(1, tangent), /upside down/], [1, mul(over(wide, high), over(w, h)), /aspect ratio divides/],
            [1, over(wide, high), /missing/], [2, h, /square/], [2, over(mul(h, high), wide), /upside down/]],
    };
};

const lmuMistakes = (text) => {
    const [n, f] = numbers(text.slice(text.search(/n = /))), tangent = tangentOf(text), aspect = after(text, /ratio\) = /)[0];
    const [x, y, z] = after(text, /The point is \(/);
    const clip = on(perspective(tangent, aspect, neg(n), neg(f)), [x, y, z, 1]), ndc = divided(clip), outside = less(q(1), ndc[0]) || less(ndc[0], q(-1));
    return {
        answers: [ndc[0], ndc[1], z, 'yes', outside ? 'yes' : 'no'],
        wrongs: [[0, over(ndc[0], x), /lost x/], [0, neg(ndc[0]), /negative/], [0, mul(ndc[0], z), /division/], [0, mul(ndc[0], aspect), /aspect/],
            [1, over(ndc[1], y), /lost y/], [1, neg(ndc[1]), /negative/], [2, neg(z), /OpenGL/],
            [3, 'no', /every point/], [4, outside ? 'no' : 'yes', /\|w\|/]],
    };
};

export const answersOf = {
    'haw-1': ball, 'haw-2': lookAt, 'haw-3': snake, 'haw-4': line, 'haw-5': depth, 'haw-6': lens, pixel, 'hidden-camera': hidden, near, clipping, 'kaist-view': factors, flatten, 4600: notes, order, sense,
    'eece-mistakes': eeceMistakes, chain, 'half-distance': half, square, 'lmu-mistakes': lmuMistakes,
};
