// lesson_exercise_lmu: exercises on LMU's tutorial 4: the Hitchcock zoom, and two statements that do not go together.
import { fractionOf } from './lesson_fraction.mjs';
import { exerciseOf, fullTangent, lensOptions, lensWords, oneFrom, optionPlace, placeWords, signedFrom, wholeFrom } from './lesson_exercise.mjs';
import { sizeOption } from './lesson_exercise_haw.mjs';

function makeHalf(random) {
    const tangent = fractionOf(oneFrom(random, ['1/4', '1/2', '1', '1/8'])), distance = 2 * wholeFrom(random, 2, 8);
    const behind = wholeFrom(random, 1, 9), height = wholeFrom(random, 1, 3);
    const near = tangent.times(2), focal = fractionOf(1).by(tangent), after = focal.by(2).times(height).by(distance / 2 + behind);
    const before = focal.times(height).by(distance + behind);
    return exerciseOf({
        text: `A subject is at the distance ${distance}. The camera has ${lensWords(tangent)}: as a pinhole camera with an image 2 high, its focal length is ${focal}. It goes to half of the distance, and the subject is to keep its size in the picture.`,
        parts: [
            {
                label: 'the new tangent of half of the field of view', right: near, hint: 'The subject\'s size is its height over distance times tangent.', wrongs: [
                    [tangent.by(2), 'The other way: nearer, the subject fills more of the picture, so the angle must become wider.'],
                    [fullTangent(tangent), 'This doubles the angle. It is the tangent of its half that is to be doubled.'],
                    [tangent, 'With the same lens the subject becomes twice as large.'],
                    [tangent.times(4), 'This is twice too much: the size goes with the distance, not with its square.'],
                ],
            },
            {
                label: 'the new focal length', right: focal.by(2), hint: 'The focal length is 1 over that tangent.', wrongs: [
                    [focal.times(2), 'A longer focal length makes things larger. They are already larger because the camera is nearer.'],
                    [focal, 'With the same lens the subject becomes twice as large.'],
                    [near, 'This is the tangent. The focal length is 1 over it.'],
                ],
            },
            {
                label: `a column ${height} high stands ${behind} behind the subject. Its height in normalised device coordinates, after the move`, right: after, hint: 'Focal length times height over the distance of the column, both new.', wrongs: [
                    [before, 'This is its height before the move. Only the subject keeps its size: what is behind becomes smaller.'],
                    [focal.times(height).by(distance / 2 + behind), 'The lens has changed, too.'],
                    [focal.by(2).times(height).by(distance + behind), 'The camera has come nearer to the column, too.'],
                    [focal.by(2).times(height).by(fractionOf(distance + behind).by(2)), 'The column\'s distance is not halved: only the subject\'s is. The gap between them stays.'],
                ],
            },
        ],
        options: [['size', '100x100'], ...lensOptions(near), ['camera', `eye=0,0,${distance / 2}`], ['point', optionPlace([0, height, -behind])]],
    });
}

function makeSquare(random) {
    const size = oneFrom(random, [[240, 120], [120, 240], [480, 120]]), [width, height] = size, aspect = fractionOf(width).by(height);
    const high = wholeFrom(random, 1, 4), wide = high + oneFrom(random, [1, 2, 3]), distance = oneFrom(random, [2, 4, 8]);
    const tangent = fractionOf(high).by(2 * distance), share = fractionOf(wide).by(aspect.times(high));
    return exerciseOf({
        text: `A subject is ${wide} wide and ${high} high, at the distance ${distance}. The picture is ${width} pixels wide and ${height} high. The lens is chosen so that the subject's height fills the picture's.`,
        parts: [
            {
                label: 'the tangent of half of the vertical field of view', right: tangent, hint: 'Half of the height over the distance.', wrongs: [
                    [tangent.times(2), 'The angle is halved, so the height is to be halved, too.'],
                    [fractionOf(1).by(tangent), 'This is upside down: the tangent is half of the height over the distance.'],
                    [fractionOf(wide).by(2 * distance), 'This is made from the width. The vertical field of view belongs to the height.'],
                ],
            },
            {
                label: 'the subject\'s width over the width that the picture shows there', right: share, hint: 'The picture shows aspect times the height.', wrongs: [
                    [aspect.times(wide).by(high), 'The aspect ratio divides: a wider picture shows more beside the subject.'],
                    [fractionOf(wide).by(high), 'The aspect ratio of the picture is missing.'],
                    [fractionOf(1).by(share), 'This is upside down.'],
                    [1, 'It is 1 only where subject and picture have the same ratio of width to height, as two squares have.'],
                ],
            },
            {
                label: `how many pixels wide a picture ${height} high must be, so that the whole subject fills it exactly`, right: fractionOf(height * wide).by(high), hint: 'Picture and subject need the same ratio of width to height.', wrongs: [
                    [fractionOf(height * high).by(wide), 'The ratio is upside down: the subject is wider than high.'],
                    [height, 'A square picture is right for a square subject. This one is no square.'],
                    [fractionOf(width), 'This is the picture as it is. Its ratio is not the subject\'s.'],
                ],
            },
        ],
        options: [sizeOption(size), ['focal', `${2 * distance},${2 * high}`], ['camera', `eye=0,0,${distance}`], ['frustum', `${distance},${high}`]],
    });
}

function makeLmuMistakes(random) {
    const tangent = fractionOf(oneFrom(random, ['1/2', '1', '2'])), size = oneFrom(random, [[200, 100], [100, 200], [400, 100]]);
    const aspect = fractionOf(size[0]).by(size[1]);
    const near = -wholeFrom(random, 1, 3), far = near * wholeFrom(random, 8, 12), z = -wholeFrom(random, 1 - near, 1 - far);
    const point = [oneFrom(random, [1, -1]) * wholeFrom(random, 2, 9), oneFrom(random, [1, -1]) * wholeFrom(random, 2, 9), z];
    const row = fractionOf(-1).by(tangent).by(aspect), clip = row.times(point[0]), x = clip.by(z);
    const y = fractionOf(-point[1]).by(tangent).by(z), outside = clip.size().compare(-z) > 0;
    return exerciseOf({
        text: `LMU's T_persp, with n = ${near} and f = ${far} as coordinates, ${lensWords(tangent)}, and lambda (the aspect ratio) = ${aspect}:\n\nx' = -x/(lambda t), y' = -y/t, w = z, with t the tangent of half of the angle.\n\nThe slides of the Hitchcock zoom print its product with (x, y, z, 1) as -1/(lambda t), -1/t, ..., z. The point is ${placeWords(point)}.`,
        parts: [
            {
                label: 'x\' after the division', right: x, hint: 'The first row times the point, divided by w = z.', wrongs: [
                    [row.by(z), 'This is the slide\'s, which has lost x: the row is multiplied by x.'],
                    [x.negative(), 'z is negative, and so is the first row: both signs go.'],
                    [clip, 'The division by w is missing.'],
                    [x.times(aspect), 'The aspect ratio is missing: lambda stands below x.'],
                ],
            },
            {
                label: 'y\' after the division', right: y, hint: 'The second row times the point, divided by w = z.', wrongs: [
                    [fractionOf(-1).by(tangent).by(z), 'This is the slide\'s, which has lost y: the row is multiplied by y.'],
                    [y.negative(), 'z is negative, and so is the second row: both signs go.'],
                    [y.by(aspect), 'The aspect ratio belongs to x alone.'],
                    [y.times(z), 'The division by w is missing.'],
                ],
            },
            {
                label: 'w', right: fractionOf(z), hint: 'The bottom row is 0 0 1 0.', wrongs: [
                    [-z, 'This is OpenGL\'s. LMU\'s w is z itself, below 0 for what is seen.'],
                    [1, 'w is 1 before the matrix. The bottom row makes it z.'],
                ],
            },
            {
                label: 'HAW calls a vertex outside if |x| > w. Does that test call this one outside? yes or no', right: 'yes', hint: 'Type yes or no.', wrongs: [
                    ['no', 'w is below 0 here, and |x| is not. So |x| > w holds for every point.'],
                ],
            },
            {
                label: 'is it really to the left or the right of what the camera sees? yes or no', right: outside ? 'yes' : 'no', hint: 'Type yes or no.', wrongs: [
                    [outside ? 'no' : 'yes', 'Compare |x| with |w|, both before the division; or |x\'| with 1.'],
                ],
            },
        ],
        options: [['convention', 'lmu'], sizeOption(size), ...lensOptions(tangent), ['near', `${near}`], ['far', `${far}`], ['camera', 'eye=0,0,0,target=0,0,-1'], ['point', point.join()]],
    });
}

export const exercisesLmu = [
    { id: 'half-distance', title: 'The same size from half of the distance', source: 'LMU tutorial 4, Hitchcock zoom', make: makeHalf },
    { id: 'square', title: 'The square condition', source: 'LMU tutorial 4, more math behind the Hitchcock zoom', make: makeSquare },
    { id: 'lmu-mistakes', title: 'Find the mistake: lost x and y, and |x| > w', source: 'LMU tutorial 4, math behind the Hitchcock zoom; HAW chapter 9, after step 3', make: makeLmuMistakes },
];
