// lesson_exercise_eece: exercises on EECE 478: transforms and their order, and two slides with a mistake.
import { fractionOf, fractionsOf, matrixInverse, matrixOn, matrixTimes } from './lesson_fraction.mjs';
import { exerciseOf, matrixLines, oneFrom, optionPlace, placeWords, signedFrom, wholeFrom } from './lesson_exercise.mjs';
import { pythagorean } from './lesson_exercise_haw.mjs';

const axisNames = ['x', 'y', 'z'];

// A right-handed rotation about axis 0 .. 2, as a 3x3 matrix.
function rotationAbout(axis, sine, cosine) {
    const [next, last] = [(axis + 1) % 3, (axis + 2) % 3], rows = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(fractionsOf);
    rows[next][next] = rows[last][last] = fractionOf(cosine);
    rows[next][last] = fractionOf(sine).negative();
    rows[last][next] = fractionOf(sine);
    return rows;
}

const added = (one, other) => one.map((value, i) => fractionOf(value).plus(other[i]));
const subtracted = (one, other) => one.map((value, i) => fractionOf(value).minus(other[i]));
const smallPlace = (random) => [signedFrom(random, 6), signedFrom(random, 6), signedFrom(random, 6)];
// The quaternion of a rotation, as --camera takes it; the sine is not 0.
const quaternionOf = (axis, sine, cosine) => {
    const half = fractionOf(sine).by(fractionOf(cosine).plus(1)), parts = [half.under, 0n, 0n, 0n];
    parts[axis + 1] = half.over;
    return parts.join();
};

function makeOrder(random) {
    const axis = wholeFrom(random, 0, 2), sign = oneFrom(random, [1, -1]), turn = rotationAbout(axis, sign, 0), back = rotationAbout(axis, -sign, 0);
    const shift = smallPlace(random), point = smallPlace(random), turned = matrixOn(turn, point);
    const first = added(turned, shift), second = matrixOn(turn, added(point, shift)), third = matrixOn(back, subtracted(point, shift));
    return exerciseOf({
        text: `R turns by ${sign * 90} degrees about the ${axisNames[axis]} axis, by the right-hand rule. T translates by ${placeWords(shift)}. Points are columns: p stands on the right of its matrix. p = ${placeWords(point)}.`,
        parts: [
            {
                label: 'T R p: x y z', right: first, hint: 'The matrix next to p is applied first.', wrongs: [
                    [second, 'This is R T p: the order is reversed. The matrix next to p is applied first; with row vectors it would be the other one.'],
                    [added(matrixOn(back, point), shift), 'The rotation has the other sense.'],
                    [turned, 'This is only turned. The translation is missing.'],
                ],
            },
            {
                label: 'R T p: x y z', right: second, hint: 'First translate, then turn what comes out.', wrongs: [
                    [first, 'This is T R p: the order is reversed. The matrix next to p is applied first; with row vectors it would be the other one.'],
                    [matrixOn(back, added(point, shift)), 'The rotation has the other sense.'],
                    [added(point, shift), 'This is only translated. The rotation is missing.'],
                ],
            },
            {
                label: 'a camera is placed by T R. The point p of the world in its coordinates: x y z', right: third, hint: 'The view is the inverse: undo the translation, then the rotation.', wrongs: [
                    [subtracted(matrixOn(back, point), shift), 'The order is reversed: the inverse of T R is the inverse of R times the inverse of T.'],
                    [first, 'This moves the point as the camera was moved. The view is the inverse.'],
                    [matrixOn(turn, subtracted(point, shift)), 'The rotation has to be inverted, too.'],
                    [second, 'This is R T p. Both have to be inverted.'],
                ],
            },
        ],
        options: [['projection', 'ortho'], ['camera', `quat=${quaternionOf(axis, sign, 0)},eye=${shift.join()}`], ['point', point.join()]],
    });
}

function makeSense(random) {
    const axis = wholeFrom(random, 0, 2), [sine, cosine] = fractionsOf(oneFrom(random, pythagorean));
    const turn = rotationAbout(axis, sine, cosine), back = rotationAbout(axis, sine.negative(), cosine);
    const vector = smallPlace(random).map((value) => 5 * value), eye = smallPlace(random);
    const away = smallPlace(random).map((value) => 5 * value), point = added(eye, away).map((value) => Number(value.over));
    return exerciseOf({
        text: `R turns about the ${axisNames[axis]} axis by an angle with sine ${sine} and cosine ${cosine}. Its sense is the right-hand rule's: the thumb along the axis, the fingers turn. With a sine above 0, about y, it takes +z towards +x.`,
        parts: [
            {
                label: `R times ${placeWords(vector)}: x y z`, right: matrixOn(turn, vector), hint: `The ${axisNames[axis]} coordinate stays. Of the others, one row has -sine and one +sine.`, wrongs: [
                    [matrixOn(back, vector), 'The sense is the other one: the sign of the sine is in the wrong row.'],
                    [matrixOn(rotationAbout(axis, cosine, sine), vector), 'Sine and cosine are swapped: the cosine stands on the diagonal.'],
                    [matrixOn(rotationAbout((axis + 1) % 3, sine, cosine), vector), 'This turns about another axis.'],
                ],
            },
            {
                label: `a camera stands at ${placeWords(eye)} and is turned by R. The point ${placeWords(point)} in its coordinates: x y z`, right: matrixOn(back, away), hint: 'EECE\'s slide: rotate by minus the angle, after translating by minus the place.', wrongs: [
                    [matrixOn(turn, away), 'The point turns in the other sense than the camera: rotate by minus the angle.'],
                    [subtracted(matrixOn(back, point), eye), 'The order is reversed: first translate by minus the place, then rotate.'],
                    [away, 'This is only translated. The camera is turned, too.'],
                    [matrixOn(back, added(point, eye)), 'Translate by minus the place of the camera.'],
                ],
            },
        ],
        options: [['projection', 'ortho'], ['camera', `quat=${quaternionOf(axis, sine, cosine)},eye=${eye.join()}`], ['point', point.join()]],
    });
}

function makeMistakes(random) {
    const low = () => -wholeFrom(random, 1, 4), [left, bottom] = [low(), low()], right = -left + wholeFrom(random, 1, 4);
    const top = -bottom + wholeFrom(random, 1, 4);
    const near = wholeFrom(random, 1, 4), far = near * wholeFrom(random, 2, 5);
    const over = (sum, width) => fractionOf(sum).by(width);
    const column = [over(-right - left, right - left), over(-top - bottom, top - bottom), over(-far - near, far - near)];
    const slide = [[over(2, right - left), 0, 0, column[0].negative()], [0, over(2, top - bottom), 0, column[1].negative()], [0, 0, over(-2, far - near), column[2].negative()], [0, 0, 0, 1]];
    const times = fractionOf(far).by(near), corner = [times.times(right), times.times(top), fractionOf(-far)];
    const clip = [over(2 * near * right - (right + left) * far, right - left), over(2 * near * top - (top + bottom) * far, top - bottom), fractionOf(far), fractionOf(far)];
    return exerciseOf({
        text: `The view volume has l = ${left}, r = ${right}, b = ${bottom}, t = ${top}, n = ${near}, f = ${far}. EECE's slide Orthographic Projection (2) has this matrix for it. Find the mistake.\n\n${matrixLines(slide)}`,
        parts: [
            {
                label: 'to which x\' the slide\'s matrix takes x = l', right: over(3 * left + right, right - left), hint: 'The first row of the slide, as it is printed, times (l, ..., 1).', wrongs: [
                    [-1, 'So it should be: l is to go to -1. Work out what the slide\'s matrix really makes of it.'],
                    [over(2 * left, right - left), 'The last column belongs to it, too: the point ends with a 1.'],
                ],
            },
            {
                label: 'the right last column, without its 1: three numbers', right: column, hint: 'KAIST 4.9 checks it: l goes to -1, b to -1, and z = -n to -1.', wrongs: [
                    [column.map((value) => value.negative()), 'This is the slide\'s: with it the middle of the box does not go to 0. The signs are the other ones.'],
                    [[column[0], column[1], column[2].negative()], 'z has the same mistake: z = -n has to go to -1.'],
                    [[column[0].by(2), column[1].by(2), column[2].by(2)], 'This is half of it: the middle is half of the sum, but the scale is 2 over the width.'],
                ],
            },
            {
                label: 'View Frustum (3) takes (r, t, -f) for the far corner of the perspective frustum. The right corner: x y z', right: corner, hint: 'The frustum grows with the distance: r and t are at the near plane.', wrongs: [
                    [[right, top, -far], 'This is the slide\'s. r and t are measured at the near plane; the far plane is larger.'],
                    [[corner[0], corner[1], fractionOf(far)], 'z is negative in front of the camera.'],
                    [[over(right * near, far), over(top * near, far), fractionOf(-far)], 'The far plane is larger than the near one, not smaller: f over n.'],
                ],
            },
            {
                label: 'what glFrustum\'s matrix really makes of (r, t, -f), before the division: x y z w', right: clip, hint: 'The first row is 2n/(r-l), 0, (r+l)/(r-l), 0, and w is -z.', wrongs: [
                    [[near, near, near, near], 'This is what the slide says. But w is -z, which is f here.'],
                    [[far, far, far, far], 'This is where the real far corner goes.'],
                    [clip.map((value) => value.by(far)), 'This is already divided by w.'],
                    [[over(2 * near * right + (right + left) * far, right - left), over(2 * near * top + (top + bottom) * far, top - bottom), fractionOf(far), fractionOf(far)], 'The third column is multiplied by z, which is -f.'],
                ],
            },
        ],
        options: [['projection', `ortho=${[left, right, bottom, top].join()}`], ['near', `${near}`], ['far', `${far}`], ['camera', 'eye=0,0,0,target=0,0,-1'], ['point', `${left},${bottom},${-near}`]],
    });
}

function makeChain(random) {
    const scale = oneFrom(random, [2, 3]), sign = oneFrom(random, [1, -1]), turn = rotationAbout(1, sign, 0);
    const undo = rotationAbout(1, -sign, 0), shift = smallPlace(random), point = smallPlace(random);
    const sized = point.map((value) => value * scale), world = added(matrixOn(turn, sized), shift), around = oneFrom(random, [1, -1]);
    const camera = rotationAbout(1, around, 0), back = rotationAbout(1, -around, 0);
    const seen = [signedFrom(random, 5), signedFrom(random, 5), -wholeFrom(random, 6, 12)], eye = subtracted(world, matrixOn(camera, seen)), w = -seen[2];
    const model = matrixTimes([[1, 0, 0, shift[0]], [0, 1, 0, shift[1]], [0, 0, 1, shift[2]], [0, 0, 0, 1]], [...turn.map((row) => [...row.map((value) => value.times(scale)), 0]), [0, 0, 0, 1]]);
    return exerciseOf({
        text: `q = P V^-1 M p with M = T R S.\nS scales by ${scale}. R turns by ${sign * 90} degrees about y, by the right-hand rule. T translates by ${placeWords(shift)}. p = ${placeWords(point)}.\nThe camera V is turned by ${around * 90} degrees about y, and then moved to ${placeWords(eye)}. P has a vertical field of view of 90 degrees, and the picture is square.`,
        parts: [
            {
                label: 'M p, in the world: x y z', right: world, hint: 'S first, then R, then T.', wrongs: [
                    [matrixOn(turn, added(sized, shift)), 'T and R are in the reversed order: the matrix next to p is applied first.'],
                    [added(matrixOn(turn, point), shift).map((value) => value.times(scale)), 'S comes last here. It stands next to p, so it comes first: the shift is not scaled.'],
                    [added(matrixOn(undo, sized), shift), 'The rotation has the other sense.'],
                    [matrixOn(matrixInverse(model), [...point, 1]).slice(0, 3), 'This is the inverse of M. Only the camera is inverted.'],
                ],
            },
            {
                label: 'V^-1 M p, in the camera: x y z', right: seen, hint: 'Undo the move, then the turn.', wrongs: [
                    [added(matrixOn(camera, world), eye), 'This is V, not its inverse.'],
                    [subtracted(matrixOn(back, world), eye), 'The order is reversed: first translate by minus the place, then turn back.'],
                    [matrixOn(camera, subtracted(world, eye)), 'The rotation has to be inverted, too.'],
                    [subtracted(world, eye), 'This is only translated. The camera is turned, too.'],
                ],
            },
            {
                label: 'w of q', right: fractionOf(w), hint: 'The bottom row of P is 0 0 -1 0.', wrongs: [
                    [-w, 'w is -z: it is above 0 for what the camera sees.'],
                    [1, 'P makes w from z.'],
                ],
            },
            {
                label: 'x and y of q after the division', right: [fractionOf(seen[0]).by(w), fractionOf(seen[1]).by(w)], hint: 'With 90 degrees P leaves x and y as they are. Then divide by w.', wrongs: [
                    [seen.slice(0, 2), 'The division by w is missing.'],
                    [[fractionOf(-seen[0]).by(w), fractionOf(-seen[1]).by(w)], 'This is divided by z. w is -z.'],
                ],
            },
        ],
        options: [['size', '100x100'], ['fov', '90'], ['camera', `quat=${quaternionOf(1, around, 0)},eye=${optionPlace(eye)}`], ['point', world.join()]],
    });
}

export const exercisesEece = [
    { id: 'order', title: 'The order of transforms', source: 'EECE 478, moving camera (2); LMU tutorial 4, view transformation', make: makeOrder },
    { id: 'sense', title: 'The sense of a rotation', source: 'EECE 478, moving camera in OpenGL', make: makeSense },
    { id: 'eece-mistakes', title: 'Find the mistakes of two slides', source: 'EECE 478, orthographic projection (2) and view frustum (3)', make: makeMistakes },
    { id: 'chain', title: 'The whole chain: q = P V^-1 M p', source: 'EECE 478, moving camera (2)', make: makeChain },
];
