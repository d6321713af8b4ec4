// lesson_exercise_pipeline: exercises on HAW's slides of the graphics pipeline: pixels, clipping and the depth buffer.
import { fractionOf } from './lesson_fraction.mjs';
import { exerciseOf, insideOf, lensOptions, lensWords, oneFrom, optionOf, optionPlace, placeWords, signedFrom, wholeFrom } from './lesson_exercise.mjs';
import { lensSizes, lensTangents, sizeOption } from './lesson_exercise_haw.mjs';

// A vertex in the picture of a camera that stands at (0, 0, e) and looks along -z: its pixel by HAW's formulas.
function makePixel(random) {
    const tangent = fractionOf(oneFrom(random, lensTangents)), size = oneFrom(random, lensSizes), [width, height] = size, aspect = fractionOf(width).by(height);
    const eye = wholeFrom(random, 9, 16), z = wholeFrom(random, -5, 0), w = eye - z, reach = tangent.times(w);
    const point = [signedFrom(random, insideOf(reach.times(aspect))), signedFrom(random, insideOf(reach)), z];
    const scaled = [fractionOf(point[0]).by(tangent).by(aspect), fractionOf(point[1]).by(tangent)], [x, y] = scaled.map((value) => value.by(w));
    const across = (ndc) => ndc.plus(1).times(width).by(2), down = (ndc) => fractionOf(1).minus(ndc).times(height).by(2), px = across(x), py = down(y);
    const nearest = (value) => value.plus(fractionOf('1/2')).floor();
    return exerciseOf({
        text: `The camera stands at (0, 0, ${eye}), looks along -z and has ${lensWords(tangent)}. The picture is ${width} pixels wide and ${height} high; its y counts downwards. Where is the vertex ${placeWords(point)}? Work it out first, then put the vertex there in the tab Lesson and look.`,
        parts: [
            {
                label: 'x_s in pixels', right: px, hint: 'Subtract the eye, divide x by aspect times tangent times distance, then x_s = w/2 x + w/2.', wrongs: [
                    [x, 'This is x in normalised device coordinates. The viewport transform is missing.'],
                    [x.times(width).by(2), 'The middle of the picture is at half of the width: add it.'],
                    [x.times(width).plus(fractionOf(width).by(2)), 'The picture is 2 wide in normalised device coordinates: scale with half of the width.'],
                    [across(scaled[0]), 'The division by w is missing.'],
                    [across(x.times(aspect)), 'x is also divided by the aspect ratio.'],
                    [across(x.negative()), 'Left and right are swapped: w is -z, which is above 0 for what the camera sees.'],
                    [px.minus(fractionOf('1/2')), 'The formula has no half pixel in it: x_s = 0 is the border of the picture, not the middle of a pixel.'],
                ],
            },
            {
                label: 'y_s in pixels', right: py, hint: 'Divide y by tangent times distance, then y_s = -h/2 y + h/2.', wrongs: [
                    [fractionOf(height).minus(py), 'y counts downwards on the screen: the formula has a minus sign.'],
                    [down(scaled[1]), 'The division by w is missing.'],
                    [y, 'This is y in normalised device coordinates. The viewport transform is missing.'],
                    [y.times(height).by(-2), 'The middle of the picture is at half of the height: add it.'],
                    [py.minus(fractionOf('1/2')), 'The formula has no half pixel in it: y_s = 0 is the border of the picture, not the middle of a pixel.'],
                ],
            },
            {
                label: 'column and row of the pixel in which it lies, from 0 on', right: [px.floor(), py.floor()], hint: 'Pixel k covers k to k + 1.', wrongs: [
                    [[nearest(px), nearest(py)], 'This is rounded. Pixel k covers k to k + 1, so take the whole part.'],
                    [[px.floor().plus(1), py.floor().plus(1)], 'Columns and rows count from 0 on.'],
                ],
            },
        ],
        options: [sizeOption(size), ...lensOptions(tangent), ['camera', `eye=0,0,${eye}`], ['point', point.join()]],
    });
}

function makeHidden(random) {
    const tangent = fractionOf(oneFrom(random, ['1/2', '1', '2'])), size = oneFrom(random, lensSizes), [width, height] = size;
    const aspect = fractionOf(width).by(height);
    const depth = wholeFrom(random, 8, 16), a = [wholeFrom(random, -4, 4), wholeFrom(random, -4, 4), wholeFrom(random, -4, 4)], reach = tangent.times(depth);
    const most = insideOf(reach.times(aspect)), left = wholeFrom(random, 1, most), side = oneFrom(random, [1, -1]);
    const apart = side * wholeFrom(random, 1, most + left);
    const eye = [a[0] + side * left, a[1] + signedFrom(random, insideOf(reach)), a[2] + depth];
    const seen = (x, y) => [
        fractionOf(x - eye[0]).by(tangent).by(aspect).by(depth).plus(1).times(width).by(2),
        fractionOf(1).minus(fractionOf(y - eye[1]).by(tangent).by(depth)).times(height).by(2),
    ];
    const b = [a[0] + apart, a[1], a[2]];
    return exerciseOf({
        text: `A hidden camera looks along -z, with y up and ${lensWords(tangent)}. Its picture is ${width} pixels wide and ${height} high; y counts downwards. It sees two vertices:\n\nA = ${placeWords(a)} at the pixel ${placeWords(seen(a[0], a[1]))}\nB = ${placeWords(b)} at the pixel ${placeWords(seen(b[0], b[1]))}\n\nWhere does it stand? Move a camera in the tab Lesson until the pixels agree.`,
        parts: [
            {
                label: 'x of the eye', right: fractionOf(eye[0]), hint: 'The distance w comes first: B - A is as many pixels as half of the width times the difference of x, over aspect times tangent times w.', wrongs: [
                    [2 * a[0] - eye[0], 'The other way: when the camera goes to the right, the picture goes to the left.'],
                    [a[0] - eye[0], 'This is x of A in camera space. The eye is at x of A less that.'],
                ],
            },
            {
                label: 'y of the eye', right: fractionOf(eye[1]), hint: 'Pixels count downwards, y in space upwards.', wrongs: [
                    [2 * a[1] - eye[1], 'Pixels count downwards: a vertex below the middle is lower than the eye.'],
                    [a[1] - eye[1], 'This is y of A in camera space. The eye is at y of A less that.'],
                ],
            },
            {
                label: 'z of the eye', right: fractionOf(eye[2]), hint: 'The difference of both pixels gives the distance.', wrongs: [
                    [a[2] - depth, 'The camera looks along -z, so it stands at a larger z than what it sees.'],
                    [depth, 'This is the distance to A. Add z of A.'],
                    [aspect.times(depth).plus(a[2]), 'The aspect is missing: x is divided by it.'],
                    [fractionOf(2 * depth + a[2]), 'The picture is 2 wide in normalised device coordinates, so a pixel is 2 over the width.'],
                ],
            },
        ],
        options: [sizeOption(size), ...lensOptions(tangent), ['camera', 'eye=0,0,9,target=0,0,8'], ['point', a.join()]],
    });
}

// The format fixed16, as firmware/core/render/depth.h defines it: the code of a distance w is floor(65536 d + 16 1/4) with
// d = N/w - N/f and N = (1 - 2^-9) n f / (f - n).
const fixed16Scale = (near, far) => fractionOf('511/512').times(near).times(far).by(far.minus(near)).times(65536);
function fixed16Code(near, far, distance) {
    const scale = fixed16Scale(near, far);
    return scale.by(distance).minus(scale.by(far)).plus(fractionOf('65/4')).floor();
}

// near is any that parts both plates, so there is no list of right answers: it is tried.
function judgeNear(near, { first, far, front, back }) {
    if (near.compare(0) <= 0) {
        return { ok: false, say: 'The near plane is at a distance above 0.' };
    }
    if (near.compare(front) > 0) {
        return { ok: false, say: 'The nearer plate lies before this near plane, so it is cut away.' };
    }
    const code = fixed16Code(near, far, front);
    if (!code.equals(fixed16Code(near, far, back))) {
        return { ok: true, say: `The codes are ${code} and ${fixed16Code(near, far, back)}.` };
    }
    const smaller = near.compare(first) <= 0 ? ' A smaller near plane makes it worse.' : ' Move the near plane further out.';
    return { ok: false, say: `Both plates have the code ${code} with it, so they still fight.${smaller}` };
}

// The largest gap of 1, 1/2, 1/4 .. behind a plate in which the code stays the same.
function gapWithin(near, far, front) {
    let gap = fractionOf(1);
    while (!fixed16Code(near, far, front.plus(gap)).equals(fixed16Code(near, far, front))) {
        gap = gap.by(2);
    }
    return gap;
}

function makeNear(random) {
    const first = fractionOf(oneFrom(random, ['1/8', '1/4', '1/2'])), far = fractionOf(100 * wholeFrom(random, 2, 5));
    let front = fractionOf(wholeFrom(random, 40, 90)), near = first;
    while (gapWithin(first, far, front).compare('1/64') < 0) { // a code ends just behind it
        front = front.plus(1);
    }
    const back = front.plus(gapWithin(first, far, front)), plates = { first, far, front, back }, code = fixed16Code(first, far, front);
    while (!judgeNear(near, plates).ok) {
        near = near.times(2);
    }
    const scale = fixed16Scale(first, far), exact = scale.by(front).minus(scale.by(far)), bias = fractionOf('65/4');
    const told = (value) => [judgeNear(value, plates).ok ? null : value, judgeNear(value, plates).say];
    return exerciseOf({
        text: `Two plates stand before the camera, at the distances ${front} and ${back}. Far is ${far}. The depth buffer has the format fixed16. With n = near, f = far and the distance w, its code is the whole part of\n\n65536 d + 16 1/4,   d = N/w - N/f,   N = 511/512 n f / (f - n)\n\nWith near ${first} both plates have the same code, so they fight for each pixel.`,
        parts: [
            {
                label: `the code of the nearer plate with near ${first}`, right: code, hint: 'N first, then d, then the code; only its whole part stays.', wrongs: [
                    [exact.plus(bias), 'Only the whole part of this is stored.'],
                    [exact.floor(), 'The 16 1/4 are missing.'],
                    [code.plus(1), 'The code is the whole part: it is not rounded up.'],
                    [scale.by(front).plus(bias).floor(), 'N/f is missing: at the far plane d is 0.'],
                    [fractionOf('511/512').times(first).times(65536).times(fractionOf(1).by(front).minus(fractionOf(1).by(far))).plus(bias).floor(), 'N has the factor f / (f - n), which makes d 511/512 at the near plane.'],
                ],
            },
            {
                label: 'a near plane with which their codes differ', right: near, hint: '', judge: ([number]) => judgeNear(number, plates),
                wrongs: [told(first), told(first.by(2)), told(front.plus(1)), told(first.negative())],
            },
        ],
        options: [['near', optionOf(first)], ['far', optionOf(far)], ['fov', '90'], ['depth', 'fixed16'], ['camera', 'eye=0,0,0,target=0,0,-1'], ['point', optionPlace([0, 0, front.negative()])]],
    });
}

// A triangle of clip space with corners inside and outside of one of the six planes, and inside of the other five.
function makeClip(random) {
    const axis = wholeFrom(random, 0, 2), side = oneFrom(random, [1, -1]), plane = `w ${side > 0 ? '-' : '+'} ${'xyz'[axis]}`;
    const corner = (distance) => {
        const w = wholeFrom(random, 4, 8), place = [signedFrom(random, w - 1), signedFrom(random, w - 1), signedFrom(random, w - 1), w];
        place[axis] = side * (w - distance);
        return place;
    };
    const da = wholeFrom(random, 1, 4), dc = -1 - ((da + wholeFrom(random, 0, 2)) % 4), twoInside = random() < 0.5; // not as far outside as inside
    const a = corner(da), b = corner(wholeFrom(random, 1, 4) * (twoInside ? 1 : -1)), c = corner(dc);
    const along = (from, to, share) => from.map((value, i) => share.times(to[i] - value).plus(value)), share = fractionOf(da).by(da - dc);
    const right = along(a, c, share);
    return exerciseOf({
        text: `A triangle has these corners in clip space, before the division: x, y, z, w.\n\nA = ${placeWords(a)}\nB = ${placeWords(b)}\nC = ${placeWords(c)}\n\nIt is clipped against all six planes: -w <= x <= w, and so for y and z.`,
        parts: [
            {
                label: 'how many corners what is left has', right: fractionOf(twoInside ? 4 : 3), hint: 'Count the corners inside, and one for each edge that crosses the plane.', wrongs: [
                    [twoInside ? 3 : 4, 'Each edge that crosses the plane gives a new corner, and each corner inside stays.'],
                    [twoInside ? 2 : 1, 'The corners outside go, but two edges cross the plane, and each gives a new corner.'],
                    [5, 'Only two edges cross the plane, and corners outside do not stay.'],
                    [0, 'A part of the triangle is inside. Only what is outside goes.'],
                ],
            },
            {
                label: 'the new corner on the edge from A to C: x y z w', right, hint: `${plane} is above 0 at A and below 0 at C. The new corner divides the edge where it is 0.`, wrongs: [
                    [along(c, a, share), 'The share is measured from the other end of the edge.'],
                    [along(a, c, fractionOf('1/2')), `This is the middle of the edge. Take the place where ${plane} is 0.`],
                    [c.map((value, i) => (i === axis ? side * c[3] : value)), 'This pushes C onto the plane, which gives the edge another direction. Follow the edge.'],
                    [right.map((value) => value.by(right[3])), 'This is already divided by w. Clipping comes before the division.'],
                    [da + dc === 0 ? null : along(a, c, fractionOf(da).by(da + dc)), `${plane} of C is below 0: mind its sign when you subtract.`],
                ],
            },
        ],
        options: [],
    });
}

export const exercisesPipeline = [
    { id: 'pixel', title: 'Predict the pixel, then drop the vertex', source: 'HAW chapter 9, the viewport transform', make: makePixel },
    { id: 'hidden-camera', title: 'A hidden camera', source: 'HAW chapter 9, the pipeline backwards', make: makeHidden },
    { id: 'near', title: 'Two plates stop fighting', source: 'HAW chapter 9, depth resolution; 4600, z-fighting', make: makeNear },
    { id: 'clipping', title: 'What clipping leaves', source: 'HAW chapter 9, face clipping; EECE, canonical clipping volume', make: makeClip },
];
