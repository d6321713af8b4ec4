// lesson_exercise: one instance of an exercise, and how it is graded.
//   text     what is asked for: plain text whose line breaks and columns are to be kept
//   parts    [{ label, answer, wrongs }]: what is to be typed. `answer` is one right answer, as text: a number, several
//            with spaces between them, a matrix whose rows have `; ` between them, or a word. wrongs: [{ answer, say }],
//            typical wrong answers and what is said to them; none of them is right, and no two are equal
//   address  opens the tab Lesson with these numbers, but not with the answers; empty where it has nothing to show
//   check    check(strings), one string a part, returns [{ ok, say }], one a part
import { Fraction, fractionOf, fractionsOf } from './lesson_fraction.mjs';

export const wholeFrom = (random, low, high) => low + Math.floor(random() * (high - low + 1));
export const oneFrom = (random, list) => list[wholeFrom(random, 0, list.length - 1)];
// A whole number that is not 0, at most `most` away from it.
export const signedFrom = (random, most) => wholeFrom(random, 1, most) * oneFrom(random, [1, -1]);

// The largest whole number below a fraction, at most 9: how far off the axis a vertex may be that is seen.
export const insideOf = (value) => Math.min(9, -1 - Number(value.negative().floor().over));

const isMatrix = (value) => Array.isArray(value) && Array.isArray(value[0]);
const flatAnswer = (value) => fractionsOf([value].flat(2));
const sameAnswer = (one, other) => one.length === other.length && one.every((value, i) => value.equals(other[i]));

export function answerText(value) {
    return isMatrix(value) ? value.map((row) => row.join(' ')).join('; ') : [value].flat().join(' ');
}

// Numbers that are typed, as fractions; brackets are passed over. null: something is no number.
function readNumbers(text, count) {
    const bare = text.replace(/[()[\]{}]/g, ' ').trim();
    const words = count === 1 ? [bare.replace(/^([^,./]*),(\d+)$/, '$1.$2')] : bare.replace(/\s*\/\s*/g, '/').split(/[\s,;]+/).filter((word) => word !== '');
    const numbers = words.map(Fraction.parse);
    return numbers.includes(null) ? null : numbers;
}

// Whether a decimal number is the right one, but cut off or rounded to its digits.
function isRounded(text, right) {
    const digits = /^[^./]*[.,](\d+)$/.exec(text.trim())?.[1].length ?? 0;
    const typed = readNumbers(text, 1)?.[0];
    return digits > 0 && typed !== undefined && typed.minus(right).size().compare(new Fraction(1n, 10n ** BigInt(digits))) < 0;
}

const nameOf = (part, i) => (isMatrix(part.right) ? `row ${Math.floor(i / part.right[0].length) + 1}, column ${(i % part.right[0].length) + 1}` : `number ${i + 1}`);

// What is said to numbers that are neither right nor typical.
function sayOfNumbers(part, numbers, text) {
    const right = part.numbers, off = right.findIndex((value, i) => !value.equals(numbers[i]));
    if (right.length === 1 && isRounded(text, right[0])) {
        return 'This is rounded. Type the exact number, as a fraction.';
    }
    if (right.every((value, i) => value.size().equals(numbers[i].size()))) {
        return right.length === 1 ? 'The size is right. The sign is not.' : `The sizes are right. Look at the sign of ${nameOf(part, off)}.`;
    }
    return right.length === 1 || part.same !== sameAnswer ? `Not yet. ${part.hint}` : `Not yet. ${part.hint} Look at ${nameOf(part, off)} first.`;
}

function judgeWord(part, text) {
    const word = text.trim().toLowerCase(), wrong = part.wrongs.find((item) => item.answer === word);
    return word === part.right ? { ok: true, say: '' } : { ok: false, say: wrong?.say ?? part.hint };
}

function judgePart(part, text) {
    if (text.trim() === '') {
        return { ok: false, say: 'Type an answer.' };
    }
    if (part.judge === undefined && typeof part.right === 'string') {
        return judgeWord(part, text);
    }
    const count = part.numbers.length, numbers = readNumbers(text, count);
    if (numbers === null) {
        return { ok: false, say: 'Type numbers such as 3/4, -2 or 0.75.' };
    }
    if (numbers.length !== count) {
        return { ok: false, say: `Type ${count} numbers with spaces between them; here are ${numbers.length}.` };
    }
    if (part.judge !== undefined) {
        return part.judge(numbers);
    }
    if (part.same(numbers, part.numbers)) {
        return { ok: true, say: '' };
    }
    const wrong = part.wrongs.find((item) => part.same(numbers, item.numbers));
    return { ok: false, say: wrong?.say ?? sayOfNumbers(part, numbers, text) };
}

// The address of the tab Lesson with options of pinhole-sim, [[name, value], ...]. No options: ''.
export const lessonAddress = (options) => (options.length === 0 ? '' : `#tab=lesson&${options.map(([name, value]) => `${name}=${encodeURIComponent(value)}`).join('&')}`);

// Makes an instance; options are those of pinhole-sim that show its numbers. A part is { label, right, hint, wrongs }, with
// wrongs [[value, say], ...]. `right` and a value are a Fraction or a whole number, an array of them, an array of rows, or a
// word. A value is left out if it is null, if it is right all the same, or if it came before. Optional: same(numbers,
// others) tells when two answers count as one, without it when all numbers are equal; judge(numbers) returns { ok, say } for
// a part that has many right answers, and wrongs are then those that it is to name.
export function exerciseOf({ text, parts, options }) {
    const made = parts.map(({ label, right, hint, wrongs, same = sameAnswer, judge }) => {
        const isWord = typeof right === 'string';
        const part = { label, answer: isWord ? right : answerText(right), wrongs: [], right, numbers: isWord ? [] : flatAnswer(right), hint, same, judge };
        for (const [value, say] of wrongs) {
            const numbers = isWord || value === null ? [] : flatAnswer(value);
            if (value !== null && (isWord || !same(numbers, part.numbers)) && !part.wrongs.some((item) => (isWord ? item.answer === value : same(item.numbers, numbers)))) {
                part.wrongs.push({ answer: isWord ? value : answerText(value), numbers, say });
            }
        }
        return part;
    });
    return { text, parts: made, address: lessonAddress(options), check: (strings) => made.map((part, i) => judgePart(part, strings[i] ?? '')) };
}

// ---- cameras and lenses of the exercises -----------------------------------------------------------------------------------

// A lens is told by the tangent of half of its vertical field of view: 1, or another one that a fraction can be.
export const lensWords = (tangent) => (tangent.equals(1) ? 'a vertical field of view of 90 degrees' : `a vertical field of view of 2 atan(${tangent})`);
export const lensOptions = (tangent) => (tangent.equals(1) ? [['fov', '90']] : [['focal', `${tangent.under},${2n * tangent.over}`]]);
// The tangent that comes out when the whole angle is taken for its half; null for 90 degrees, which has none.
export const fullTangent = (tangent) => (tangent.equals(1) ? null : tangent.times(2).by(fractionOf(1).minus(tangent.times(tangent))));
// The number that stands in the tangent's place when half of 90 degrees is taken for it; null for another angle.
export const degreesTangent = (tangent) => (tangent.equals(1) ? fractionOf(45) : null);
// A number as pinhole-sim's options take it: decimal. Its denominator is a product of twos and fives.
export const optionOf = (value) => `${Number(fractionOf(value).over) / Number(fractionOf(value).under)}`;
export const optionPlace = (place) => place.map(optionOf).join();
export const placeWords = (place) => `(${place.join(', ')})`;

// The matrix of a right-handed lens: HAW's Q_ndc and OpenGL's.
export function lensMatrix(tangent, aspect, near, far) {
    const range = fractionOf(near).minus(far);
    return [
        [fractionOf(1).by(tangent).by(aspect), 0, 0, 0],
        [0, fractionOf(1).by(tangent), 0, 0],
        [0, 0, fractionOf(near).plus(far).by(range), fractionOf(near).times(far).times(2).by(range)],
        [0, 0, -1, 0],
    ];
}

// A matrix as lines of text, in columns.
export function matrixLines(matrix) {
    const texts = matrix.map((row) => row.map(String));
    const width = Math.max(...texts.flat().map((text) => text.length)) + 2;
    return texts.map((row) => row.map((text) => text.padStart(width)).join('')).join('\n');
}
