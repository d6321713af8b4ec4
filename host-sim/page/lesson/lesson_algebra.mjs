// lesson_algebra: matrices of 16 numbers, rows first, for what the page draws itself; the numbers that it shows are pinhole-sim's.

export const lessonProduct = (a, b) => Array.from({ length: 16 }, (_, i) => [0, 1, 2, 3].reduce((sum, k) => sum + a[(i & 12) + k] * b[4 * k + (i & 3)], 0));
export const lessonApply = (a, v) => [0, 4, 8, 12].map((row) => a[row] * v[0] + a[row + 1] * v[1] + a[row + 2] * v[2] + a[row + 3] * (v[3] ?? 1));
export const lessonDivided = ([x, y, z, w]) => [x / w, y / w, z / w];
export const lessonBetween = (a, b, t) => a.map((x, i) => x + (b[i] - x) * t);
export const lessonDistance = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));

// The determinant of the rotation in rows of numbers or texts: below 0 it changes hands.
export function lessonHand(rows) {
    const [a, b, c] = rows.map((row) => row.map(Number));
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// The inverse, or null.
export function lessonInverse(from) {
    const rows = [0, 4, 8, 12].map((at, i) => [...from.slice(at, at + 4), ...[0, 1, 2, 3].map((j) => +(i === j))]);
    for (let i = 0; i < 4; i++) {
        const best = [0, 1, 2, 3].filter((k) => k >= i).reduce((a, b) => (Math.abs(rows[b][i]) > Math.abs(rows[a][i]) ? b : a));
        [rows[i], rows[best]] = [rows[best], rows[i]];
        if (Math.abs(rows[i][i]) < 1e-12) {
            return null;
        }
        rows[i] = rows[i].map((x) => x / rows[i][i]);
        rows.forEach((row, k) => {
            rows[k] = k === i ? row : row.map((x, j) => x - row[i] * rows[i][j]);
        });
    }
    return rows.flatMap((row) => row.slice(4));
}

// Each convention beside gl: what it does to a clip coordinate of gl, as 4 x 4 numbers: the depth of d3d is (z + w) / 2, of
// reversed (w - z) / 2; lmu has all signs the other way, and its depth once more.
const LESSON_CLIPS = {
    gl: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
    d3d: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.5, 0.5, 0, 0, 0, 1],
    lmu: [-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1],
    reversed: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -0.5, 0.5, 0, 0, 0, 1],
};
const LESSON_MIRROR = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1]; // of z: the camera of d3d, the depth of lmu in parallel

// A lens, or a view, of one convention as another one writes it.
export function lessonLensAs(matrix, from, to) {
    const parallel = Math.abs(matrix[14]) < 1e-6, clip = (name) => (name === 'lmu' && parallel ? LESSON_MIRROR : LESSON_CLIPS[name]);
    const turned = (from === 'd3d') !== (to === 'd3d') ? lessonProduct(matrix, LESSON_MIRROR) : matrix;
    return lessonProduct(clip(to), lessonProduct(lessonInverse(clip(from)), turned));
}

export function lessonViewAs(matrix, from, to) {
    return (from === 'd3d') !== (to === 'd3d') ? lessonProduct(LESSON_MIRROR, matrix) : matrix;
}

// The depths of the near and of the far plane.
export const LESSON_ENDS = { gl: [-1, 1], d3d: [0, 1], lmu: [1, -1], reversed: [1, 0] };
