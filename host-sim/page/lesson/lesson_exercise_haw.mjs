// lesson_exercise_haw: the six exercises of HAW, chapter 9.
import { fractionOf, fractionsOf, matrixInverse, matrixOn, matrixTranspose } from './lesson_fraction.mjs';
import { degreesTangent, exerciseOf, fullTangent, lensMatrix, lensOptions, lensWords, oneFrom, optionPlace, placeWords, signedFrom, wholeFrom } from './lesson_exercise.mjs';

export const lensTangents = ['1/2', '1', '2', '1/4'];
// Sizes whose aspect ratio divides exactly in Pinhole. None is 2, for which two mistakes give the same number.
export const lensSizes = [[400, 100], [100, 100], [100, 200], [320, 240], [160, 120], [480, 120]];
export const sizeOption = ([width, height]) => ['size', `${width}x${height}`];
export const pythagorean = [['3/5', '4/5'], ['4/5', '3/5'], ['-3/5', '4/5'], ['-4/5', '3/5'], ['3/5', '-4/5'], ['-4/5', '-3/5']];

function makeBall(random) {
    const tangent = fractionOf(oneFrom(random, lensTangents)), size = oneFrom(random, [[200, 100], [100, 200], [400, 100]]);
    const aspect = fractionOf(size[0]).by(size[1]), distance = wholeFrom(random, 8, 24), radius = fractionOf(oneFrom(random, ['1/4', '1/2', '3/4']));
    const height = tangent.times(2 * distance), width = height.times(aspect), limit = width.by(2).minus(radius), full = fullTangent(tangent);
    const degrees = degreesTangent(tangent);
    return exerciseOf({
        text: `A ball with the radius ${radius} bounces inside the view frustum. The camera has ${lensWords(tangent)}, and the picture is ${size[0]} pixels wide and ${size[1]} high. The ball is at z_c = -${distance} in camera space.`,
        parts: [
            {
                label: 'h_c, the height of the frustum there', right: height, hint: 'h_c is twice the distance times the tangent of half of the angle.', wrongs: [
                    [height.negative(), 'A height is above 0. z_c is negative in front of the camera, so the slide\'s formula needs |z_c|.'],
                    [height.by(2), 'This is half of the height: from the axis up to the top. The frustum also goes down from the axis.'],
                    [full?.times(2 * distance) ?? null, 'This takes the tangent of the whole angle. The triangle from the axis to the top has half of the angle.'],
                    [full?.size().times(2 * distance) ?? null, 'This takes the tangent of the whole angle. The triangle from the axis to the top has half of the angle.'],
                    [degrees?.times(2 * distance) ?? null, 'This multiplies by the angle in degrees. Take its tangent: that of 45 degrees is 1.'],
                    [degrees?.times(4 * distance) ?? null, 'This multiplies by the angle in degrees. Take the tangent of half of it.'],
                ],
            },
            {
                label: 'w_c, its width there', right: width, hint: 'The width is the aspect ratio times the height, and the aspect ratio is width over height.', wrongs: [
                    [height.by(aspect), 'The aspect ratio is width over height. Here it is used upside down.'],
                    [height, 'This is the height. The width is the aspect ratio times the height.'],
                    [width.negative(), 'A width is above 0: take |z_c|.'],
                ],
            },
            {
                label: 'the largest x_c of its centre (slide: w_c/2 - radius)', right: limit, hint: 'Half of the width, less the radius.', wrongs: [
                    [width.by(2), 'There the centre touches the border, and half of the ball is outside. Take off the radius.'],
                    [width.by(2).plus(radius), 'There the whole ball is outside. The radius is to be taken off.'],
                    [width.minus(radius), 'x_c counts from the axis, so only half of the width is on each side.'],
                    [limit.negative(), 'This is the limit at the left border.'],
                ],
            },
        ],
        options: [sizeOption(size), ...lensOptions(tangent), ['frustum', `${distance}`]],
    });
}

function makeLookAt(random) {
    const [sine, cosine] = fractionsOf(oneFrom(random, [[1, 0], [-1, 0], [0, -1], ...pythagorean])), whole = sine.under === 1n;
    const target = [wholeFrom(random, -3, 3), wholeFrom(random, -3, 3), wholeFrom(random, -3, 3)];
    const away = whole ? wholeFrom(random, 2, 9) : 5 * wholeFrom(random, 1, 3);
    const eye = [sine.times(away).plus(target[0]), fractionOf(target[1]), cosine.times(away).plus(target[2])];
    const matrixOf = (s, c, at) => [[c, 0, s, at[0]], [0, 1, 0, at[1]], [s.negative(), 0, c, at[2]], [0, 0, 0, 1]].map(fractionsOf);
    const right = matrixOf(sine, cosine, eye);
    return exerciseOf({
        text: `camera.position.set(${eye.join(', ')});\ncamera.lookAt(${target.join(', ')});\n\nWork out camera.matrix, which takes camera coordinates to world coordinates. Its columns are the camera's x, y and z axes and its position.`,
        parts: [{
            label: 'camera.matrix, 16 numbers, row by row', right, hint: 'z points from the target to the camera, and x is up times z.', wrongs: [
                [matrixTranspose(right), 'This is transposed. The axes and the position are columns, not rows.'],
                [matrixInverse(right), 'This is the inverse: matrixWorldInverse, which takes world coordinates to camera coordinates.'],
                [matrixOf(sine.negative(), cosine.negative(), eye), 'This puts the target on the positive z axis, as lookAt of an object does. A camera looks along its negative z axis.'],
                [matrixOf(sine.negative(), cosine, eye), 'The axes stand in the rows here: the rotation is transposed, so it turns in the other sense.'],
                [matrixOf(sine, cosine, eye.map((value) => value.negative())), 'The last column is the camera\'s place. -eye belongs to the inverse.'],
                [matrixOf(sine, cosine, target), 'The last column is the place of the camera, not of the target.'],
            ],
        }],
        options: [['camera', `eye=${optionPlace(eye)},target=${optionPlace(target)}`]],
    });
}

function makeSnake(random) {
    const [dx, dz] = oneFrom(random, [[1, 0], [-1, 0], [0, 1]]), eye = [signedFrom(random, 9), 1, signedFrom(random, 9)];
    const ahead = wholeFrom(random, 2, 9), aside = oneFrom(random, [1, -1]) * (1 + (ahead % 5));
    const apple = [eye[0] + ahead * dx - aside * dz, 0, eye[2] + ahead * dz + aside * dx], offset = [apple[0] - eye[0], -1, apple[2] - eye[2]];
    return exerciseOf({
        text: `The camera sits on the head of the snake, at ${placeWords(eye)}. The snake moves along (${dx}, 0, ${dz}), the camera looks the same way, and up is (0, 1, 0). An apple lies at ${placeWords(apple)}.`,
        parts: [{
            label: 'the apple in camera coordinates: x y z', right: [aside, -1, -ahead], hint: 'First subtract the place of the camera. Then take the dot products with right, up and back.', wrongs: [
                [[aside, -1, ahead], 'z has the other sign: the camera looks along its negative z axis.'],
                [[-aside, -1, -ahead], 'Left and right are swapped: right is the direction of view times up, not up times the direction of view.'],
                [offset, 'This is only translated. The camera is turned, too.'],
                [[apple[2] * dx - apple[0] * dz, 0, -apple[0] * dx - apple[2] * dz], 'This is turned, but not translated: first subtract the place of the camera.'],
                [[apple[2] * dx - apple[0] * dz - eye[0], -1, -apple[0] * dx - apple[2] * dz - eye[2]], 'Here the rotation comes first and the translation second. The view is R T: translate first.'],
                [[-dz * offset[0] - dx * offset[2], -1, dx * offset[0] - dz * offset[2]], 'The rotation has the other sense: this turns as the camera turns. The view takes the inverse.'],
            ],
        }],
        options: [['camera', `eye=${eye.join()},target=${[eye[0] + dx, 1, eye[2] + dz].join()}`], ['point', apple.join()]],
    });
}

// Whether rows of a projective matrix, or points of it, are the same but for a factor that is not 0.
function sameButForFactor(numbers, others) {
    const at = others.findIndex((value) => value.over !== 0n);
    return at >= 0 && numbers[at].over !== 0n && numbers.every((value, i) => value.times(others[at]).equals(others[i].times(numbers[at])));
}

function makePlane(random) {
    const a = wholeFrom(random, 1, 5), b = wholeFrom(random, 1, 5), share = fractionOf(oneFrom(random, ['1/2', '1/3', '2/3', '2', '-1']));
    const factor = fractionOf(oneFrom(random, ['2', '3', '4', '1/2', '-2']));
    const onLine = [share.times(a), share.minus(1).times(b)], point = onLine.map((value) => value.times(factor)), far = signedFrom(random, 4);
    const bottom = [fractionOf(1).by(a), fractionOf(-1).by(b), fractionOf(0)], right = [[1, 0, 0], [0, 1, 0], bottom], norm = 1 / Math.hypot(1 / a, 1 / b);
    return exerciseOf({
        text: `Project points of the plane from the camera at the origin onto the line through (${a}, 0) and (0, ${-b}).`,
        parts: [
            {
                label: 'the 3x3 matrix, row by row (any multiple of it will do)', right, same: sameButForFactor, hint: 'The bottom row makes w: for each point of the line it must be the number that stands in both upper rows.', wrongs: [
                    [matrixTranspose(right), 'This is transposed. The normal belongs into the bottom row.'],
                    [[[1, 0, 0], [0, 1, 0], bottom.map((value) => value.negative())], 'The bottom row has the other sign: this projects onto the line on the other side of the camera.'],
                    [[[1, 0, 0], [0, 1, 0], [bottom[0], bottom[1], 1]], 'The last number of the bottom row is 0: w comes from x and y alone.'],
                    [[[1, 0, 0], [0, 1, 0], [0, 0, 1]], 'This leaves each point where it is. The bottom row has to make w.'],
                ],
            },
            {
                label: `the projection of P = ${placeWords(point)}: x y`, right: onLine, hint: 'Multiply, then divide by the last component.', wrongs: [
                    [point, 'This is not divided by the last component.'],
                    [onLine.map((value) => value.negative()), 'This is on the other side of the camera: the bottom row has the other sign.'],
                    [point.map((value) => value.times(factor)), 'This is multiplied by w. Divide by it.'],
                ],
            },
            {
                label: `w of R = (${a * far}, ${b * far})`, right: fractionOf(0), hint: 'The bottom row times R.', wrongs: [
                    [1, 'w is 1 before the matrix. The bottom row makes another one.'],
                    [2 * far, 'The bottom row has a minus sign at y: R lies in the direction of the line, so its ray never meets it.'],
                ],
            },
        ],
        options: [['camera', 'eye=0,0,0,target=0,0,-1'], ['projection', 'ortho'], ['flatten', `plane=${(-1 / a).toFixed(8)},${(1 / b).toFixed(8)},0,${norm.toFixed(8)}`],
            ['point', `${point.map((value) => Number(value.over) / Number(value.under)).join()},0`]],
    });
}

function makeDepth(random) {
    const near = wholeFrom(random, 1, 4), far = near * wholeFrom(random, 3, 9), z = wholeFrom(random, near + 1, far - 1), range = fractionOf(far - near);
    const a = fractionOf(far + near).by(range), b = fractionOf(2 * near * far).by(range), right = a.minus(b.by(z));
    const nought = fractionOf(-2 * near * far).by(far + near);
    return exerciseOf({
        text: `g(z) = a + b/z maps the depth z of camera space, which is negative, to normalised device coordinates: g(-${near}) = -1 at the near plane, and g(-${far}) = 1 at the far plane.`,
        parts: [
            {
                label: 'a', right: a, hint: 'Subtract the two equations to lose a; that gives b.', wrongs: [
                    [a.negative(), 'The sign is the other one: this swaps near and far. z is negative in both equations.'],
                    [fractionOf(1).by(a), 'This is upside down.'],
                    [fractionOf(far).by(range), 'This a belongs to a depth from 0 to 1. Here the near plane goes to -1.'],
                ],
            },
            {
                label: 'b', right: b, hint: 'b (-1/n + 1/f) is g(-n) - g(-f).', wrongs: [
                    [b.negative(), 'The sign is the other one: z is negative, so b/z is, too.'],
                    [b.by(2), 'A factor of 2 is missing: from -1 to 1 the depth goes a way of 2.'],
                ],
            },
            {
                label: `g(-${z})`, right, hint: 'Put z, with its sign, into a + b/z.', wrongs: [
                    [a.plus(b.by(z)), 'z is negative here: -b over the distance.'],
                    [fractionOf(2 * (z - near)).by(range).minus(1), 'This is the straight line between both planes. The map has 1/z in it, so it is curved.'],
                    [right.plus(1).by(2), 'This depth goes from 0 to 1. HAW\'s goes from -1 to 1.'],
                ],
            },
            {
                label: 'the z at which g is 0', right: nought, hint: 'a + b/z = 0.', wrongs: [
                    [nought.negative(), 'What the camera sees has a negative z.'],
                    [fractionOf(-far - near).by(2), 'This is the middle between both planes. The middle of the depths comes much earlier.'],
                ],
            },
        ],
        options: [['fov', '90'], ['near', `${near}`], ['far', `${far}`], ['camera', 'eye=0,0,0,target=0,0,-1'], ['point', `0,0,-${z}`]],
    });
}

function makeMatrix(random) {
    const tangent = fractionOf(oneFrom(random, lensTangents)), size = oneFrom(random, [[200, 100], [100, 200], [400, 100]]);
    const aspect = fractionOf(size[0]).by(size[1]);
    const near = wholeFrom(random, 1, 4), far = near * wholeFrom(random, 2, 6), right = lensMatrix(tangent, aspect, near, far);
    const full = fullTangent(tangent), degrees = degreesTangent(tangent);
    const z = wholeFrom(random, near + 1, far), point = [signedFrom(random, 5), signedFrom(random, 5), -z];
    const clip = matrixOn(right, [...point, 1]), ndc = clip.slice(0, 3).map((value) => value.by(z));
    const changed = (...cells) => right.map((row, i) => row.map((value, j) => cells.find((cell) => cell[0] === i && cell[1] === j)?.[2] ?? value));
    return exerciseOf({
        text: `PerspectiveCamera(${tangent.equals(1) ? '90' : `2 atan(${tangent})`}, ${aspect}, ${near}, ${far})\nThe first number is the vertical field of view, then come aspect, near and far.`,
        parts: [
            {
                label: 'Q_ndc, 16 numbers, row by row', right, hint: 'Begin with the diagonal: 1/(a t), 1/t, (n + f)/(n - f), where t is the tangent of half of the angle.', wrongs: [
                    [matrixTranspose(right), 'This is transposed: the -1 belongs into the bottom row, which makes w.'],
                    [changed([3, 2, 1]), 'w would be z, which is negative in front of the camera. The bottom row has -1.'],
                    [changed([2, 2, right[2][2].negative()], [2, 3, right[2][3].negative()]), 'The third row has the other signs: near would go to 1 and far to -1. It has n - f below the line.'],
                    [changed([0, 0, right[1][1]], [1, 1, right[0][0]]), 'The aspect stands in the wrong row: it divides x.'],
                    [changed([0, 0, right[1][1].times(aspect)]), 'The aspect is width over height, and it divides x.'],
                    [full === null ? null : lensMatrix(full, aspect, near, far), 'This takes the tangent of the whole angle. The triangle has half of it.'],
                    [degrees === null ? null : lensMatrix(degrees, aspect, near, far), 'This divides by the angle in degrees. Take its tangent: that of 45 degrees is 1.'],
                    [lensMatrix(fractionOf(1).by(tangent), aspect, near, far), 'The tangent divides: a wider angle makes things smaller.'],
                    [changed([2, 2, fractionOf(far).by(near - far)], [2, 3, fractionOf(near * far).by(near - far)]), 'This depth goes from 0 to 1. HAW\'s goes from -1 to 1.'],
                ],
            },
            {
                label: `A' for A = ${placeWords(point)} of camera space: x y z`, right: ndc, hint: 'Q_ndc times (x, y, z, 1), then all three divided by w.', wrongs: [
                    [clip.slice(0, 3), 'These are clip coordinates. The division by w is missing.'],
                    [ndc.map((value) => value.negative()), 'This is divided by z. w is -z.'],
                    [[...ndc.slice(0, 2), ndc[2].negative()], 'z has the other sign: near goes to -1, far to 1.'],
                    [[...ndc.slice(0, 2), clip[2]], 'z is to be divided by w, too.'],
                ],
            },
        ],
        options: [sizeOption(size), ...lensOptions(tangent), ['near', `${near}`], ['far', `${far}`], ['camera', 'eye=0,0,0,target=0,0,-1'], ['point', point.join()]],
    });
}

export const exercisesHaw = [
    { id: 'haw-1', title: 'The ball in the frustum', source: 'HAW chapter 9, exercise 1', make: makeBall },
    { id: 'haw-2', title: 'camera.matrix of lookAt', source: 'HAW chapter 9, exercise 2', make: makeLookAt },
    { id: 'haw-3', title: 'From the head of the snake', source: 'HAW chapter 9, exercise 3', make: makeSnake },
    { id: 'haw-4', title: 'Projection onto a line', source: 'HAW chapter 9, exercise 4', make: makePlane },
    { id: 'haw-5', title: 'Depth as a + b/z', source: 'HAW chapter 9, exercise 5', make: makeDepth },
    { id: 'haw-6', title: 'Q_ndc and a point through it', source: 'HAW chapter 9, exercise 6', make: makeMatrix },
];
