// lesson_exercise_kaist: exercises on KAIST's chapter 4 and on the notes 4.1 of 4600.
import { fractionOf, fractionsOf, matrixOn, matrixTranspose } from './lesson_fraction.mjs';
import { exerciseOf, insideOf, oneFrom, optionPlace, placeWords, signedFrom, wholeFrom } from './lesson_exercise.mjs';
import { lensSizes, pythagorean, sizeOption } from './lesson_exercise_haw.mjs';

// A camera whose direction of view lies in the plane of y and z, so that the given up vector has to be adjusted.
function makeFactors(random) {
    const [sine, cosine] = fractionsOf(oneFrom(random, pythagorean)), side = cosine.over < 0n ? -1 : 1;
    const target = [wholeFrom(random, -3, 3), wholeFrom(random, -3, 3), wholeFrom(random, -3, 3)];
    const away = 5 * wholeFrom(random, 1, 3), eye = [fractionOf(target[0]), sine.times(away).plus(target[1]), cosine.times(away).plus(target[2])];
    const up = [0, cosine.size(), sine.times(-side)], rows = [[side, 0, 0], up, [0, sine, cosine]].map(fractionsOf);
    const column = matrixOn(rows, eye).map((value) => value.negative());
    const flipped = [rows[0], rows[1], rows[2].map((value) => value.negative())];
    const turned = matrixOn(matrixTranspose(rows), eye).map((value) => value.negative());
    return exerciseOf({
        text: `The eye is at ${placeWords(eye)}, the look-at point at ${placeWords(target)}, and the up vector is (0, 1, 0).\nl is the direction of view, r = l x up, u = r x l, each of length 1. V = R T: R turns, T translates by -eye.`,
        parts: [
            {
                label: 'u, the adjusted up vector: x y z', right: up, hint: 'It is at right angles to l, and its y is above 0.', wrongs: [
                    [[0, 1, 0], 'This is the given up vector. It is not at right angles to l.'],
                    [up.map((value) => fractionOf(value).negative()), 'This is l x r. u is r x l.'],
                    [[0, sine, cosine], 'This is -l, the third row of R.'],
                ],
            },
            {
                label: 'R, 9 numbers, row by row', right: rows, hint: 'The rows are r, u and -l.', wrongs: [
                    [matrixTranspose(rows), 'This is transposed: the axes are the rows of R. As columns they make its inverse.'],
                    [flipped, 'The third row is -l: the camera looks along -z.'],
                    [[rows[0].map((value) => value.negative()), rows[1], rows[2]], 'r is l x up, not up x l.'],
                ],
            },
            {
                label: 'the last column of V, without its 1: three numbers', right: column, hint: 'It is -R times the eye.', wrongs: [
                    [eye.map((value) => value.negative()), 'This is the last column of T R: turned first, then translated. V is R T.'],
                    [column.map((value) => value.negative()), 'T translates by -eye.'],
                    [turned, 'Here the transposed R is used.'],
                    [eye, 'This is the place of the camera in the world: the last column of the inverse of V.'],
                ],
            },
        ],
        options: [['camera', `eye=${optionPlace(eye)},target=${optionPlace(target)}`]],
    });
}

function makeFlatten(random) {
    const d = oneFrom(random, [2, 3, 4]), z = d * wholeFrom(random, 2, 5), step = wholeFrom(random, 1, 3);
    const [x, y] = [signedFrom(random, 9), signedFrom(random, 9)], by = (value, under) => fractionOf(value).by(under);
    const near = fractionOf(z).by(d), seen = [by(x, near), by(y, near), fractionOf(d)], back = by(y * d, z + step);
    return exerciseOf({
        text: `The point is ${placeWords([x, y, z])} in camera space, and the camera looks along +z. KAIST 4.7 drops z in parallel, KAIST 4.11 makes w = z, EECE's pinhole has the focal length d = ${d} and w = z/d.`,
        parts: [
            {
                label: 'KAIST 4.7: x y z w', right: [x, y, 0, 1], hint: 'The third row is 0.', wrongs: [
                    [[x, y, z, 1], 'z is dropped: the third row of the matrix is 0.'],
                    [[x, y, 0, z], 'In parallel w stays 1: nothing becomes smaller with the distance.'],
                ],
            },
            {
                label: 'KAIST 4.11, after the division: x y', right: [by(x, z), by(y, z)], hint: 'Both divided by w = z.', wrongs: [
                    [[x, y], 'The division by w is missing.'],
                    [[by(-x, z), by(-y, z)], 'This divides by -z. In KAIST\'s matrix w is z.'],
                    [[by(z, x), by(z, y)], 'This is upside down.'],
                    [seen.slice(0, 2), 'This is the projection onto the plane z = d. 4.11 has no d.'],
                ],
            },
            {
                label: 'EECE\'s w', right: near, hint: 'z over d.', wrongs: [
                    [by(d, z), 'This is upside down: w is z/d, so far points have a large w.'],
                    [z, 'This is KAIST\'s w. EECE\'s is z/d.'],
                    [z * d, 'z is divided by d, not multiplied.'],
                ],
            },
            {
                label: 'EECE, after the division: x y z', right: seen, hint: 'All three divided by w.', wrongs: [
                    [[x, y, z], 'The division by w is missing.'],
                    [[...seen.slice(0, 2), z], 'z is divided, too: it becomes d, for every point.'],
                    [[by(x, z), by(y, z), 1], 'This divides by z. w is z/d, so the picture is on the plane z = d.'],
                    [[near.times(x), near.times(y), near.times(z)], 'This multiplies by w. Divide by it.'],
                ],
            },
            {
                label: `an external parameter changes: the camera goes back by ${step}. The new y after EECE's division`, right: back, hint: 'z grows by the step; d, an internal parameter, stays.', wrongs: [
                    [by(y * d, z - step), 'The camera goes back, so the point is further away.'],
                    [by(y * (d + step), z + step), 'd is an internal parameter: moving the camera does not change it.'],
                    [seen[1], 'Nothing has changed here. The point is further away now.'],
                ],
            },
        ],
        options: [['camera', 'eye=0,0,0,target=0,0,-1'], ['flatten', `eece=${d}`], ['point', `${x},${y},${z}`]],
    });
}

function makeNotes(random) {
    const [width, height] = oneFrom(random, lensSizes), aspect = fractionOf(width).by(height), screen = oneFrom(random, [2, 4]);
    const focal = fractionOf(oneFrom(random, [screen / 2, screen])), tangent = fractionOf(screen).by(2).by(focal);
    const near = wholeFrom(random, 2, 4), far = near * wholeFrom(random, 4, 8), range = far - near, z = wholeFrom(random, 5, far - 1), reach = tangent.times(z);
    const x = signedFrom(random, insideOf(reach.times(aspect))), y = signedFrom(random, insideOf(reach));
    const ndc = [fractionOf(x).by(tangent).by(aspect).by(z), fractionOf(y).by(tangent).by(z)];
    const pixel = [ndc[0].plus(1).times(width).by(2), fractionOf(1).minus(ndc[1]).times(height).by(2)], p = fractionOf(far).by(range);
    const q = fractionOf(-far * near).by(range), depth = q.by(z).plus(p);
    return exerciseOf({
        text: `A camera as the notes have it looks along +z. Its screen is ${screen} high, at the focal length ${focal}. Near is ${near}, far ${far}. The picture is ${width} pixels wide and ${height} high. The point is ${placeWords([x, y, z])} in camera space.`,
        parts: [
            {
                label: 'tan(FOV/2)', right: tangent, hint: 'Half of the screen over the focal length.', wrongs: [
                    [tangent.times(2), 'The angle is halved, so the screen is to be halved, too.'],
                    [fractionOf(1).by(tangent), 'This is upside down: a longer focal length sees less.'],
                ],
            },
            {
                label: 'y on the screen (similar triangles: y f / z)', right: focal.times(y).by(z), hint: 'f is the focal length here.', wrongs: [
                    [fractionOf(y * z).by(focal), 'This is upside down: far points come nearer to the middle.'],
                    [fractionOf(y).by(z), 'The screen is at the focal length: multiply by it.'],
                    [focal.times(y), 'The division by z is missing.'],
                ],
            },
            {
                label: 'P and Q', right: [p, q], hint: 'z\' = P + Q/z is 0 at near and 1 at far.', wrongs: [
                    [[p, q.negative()], 'Q has a minus sign, so that near goes to 0.'],
                    [[fractionOf(far + near).by(range), q.times(2)], 'This depth goes from -1 to 1. The notes\' goes from 0 to 1.'],
                    [[q, p], 'P and Q are swapped: P is multiplied by z, Q by 1.'],
                    [[p.negative(), q], 'P has the other sign: these notes look along +z.'],
                ],
            },
            {
                label: 'z\' after the division', right: depth, hint: 'P + Q/z.', wrongs: [
                    [fractionOf(z - near).by(range), 'This is the straight line from near to far. z\' has Q/z in it, so it is curved.'],
                    [p.times(z).plus(q), 'The division by w = z is missing.'],
                    [depth.times(2).minus(1), 'This depth goes from -1 to 1. The notes\' goes from 0 to 1.'],
                ],
            },
            {
                label: 'Pixel.x and Pixel.y', right: pixel, hint: '(NDC.x + 1) w/2 and (1 - NDC.y) h/2, with NDC.x = x / (A tan z).', wrongs: [
                    [[pixel[0], fractionOf(height).minus(pixel[1])], 'y counts downwards: 1 - NDC.y.'],
                    [[ndc[0].times(aspect).plus(1).times(width).by(2), pixel[1]], 'The aspect ratio is missing in x.'],
                    [ndc, 'These are normalised coordinates. The step to pixels is missing.'],
                    [[pixel[0].minus(fractionOf(width).by(2)), pixel[1].minus(fractionOf(height).by(2))], 'The middle of the picture is at half of its width and height.'],
                    [[pixel[0].times(2), pixel[1].times(2)], 'Normalised coordinates go from -1 to 1, so half of the width and of the height scale them.'],
                ],
            },
        ],
        options: [['convention', 'd3d'], sizeOption([width, height]), ['focal', `${focal},${screen}`], ['near', `${near}`], ['far', `${far}`], ['view-matrix', '1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1'], ['point', `${x},${y},${-z}`]],
    });
}

export const exercisesKaist = [
    { id: 'kaist-view', title: 'The view as two factors', source: 'KAIST chapter 4, equations 4.1 to 4.6', make: makeFactors },
    { id: 'flatten', title: 'Matrices that flatten', source: 'KAIST chapter 4, equations 4.7, 4.10 and 4.11; EECE 478, pinhole algebra', make: makeFlatten },
    { id: '4600', title: 'From the lens to the pixel', source: '4600, notes 4.1: focal length, projection matrix, pixel coordinates', make: makeNotes },
];
