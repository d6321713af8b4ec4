// Usage: node exercises.mjs INSTANCES
// Makes so many instances of each exercise of the page's lesson, and prints what is wrong with any. The answers that the exercises
// state are compared with those that exercise_answers.mjs works out from their texts; right answers are typed in several
// spellings, and to each typical wrong answer its own sentence must be said, in at least one instance.
import { exercises } from '../../../host-sim/page/lesson/lesson_exercises.mjs';
import { answersOf, equal, generator, less, listOf, q, reduced, textOf } from './exercise_answers.mjs';

const instances = +process.argv[2];
const wrong = [];
const fault = (id, what) => wrong.length < 20 && wrong.push(`${id}: ${what}`);

const sameList = (one, other) => one.length === other.length && one.every((value, i) => equal(value, other[i]));
const readAnswer = (text) => text.replaceAll(';', ' ').trim().split(/\s+/).map((word) => q(word));
// A matrix of the plane may have any factor: then all its numbers are multiplied by it.
const sameButFactor = (one, other) => one.every(([a, b], i) => one.every(([c, d], j) => equal([a * other[j][0], b * other[j][1]], [c * other[i][0], d * other[i][1]])));

// The decimal number that is the fraction, or null where none ends.
function decimalOf([a, b]) {
    const digits = 12, scaled = (a < 0n ? -a : a) * 10n ** BigInt(digits);
    const whole = (scaled / b).toString().padStart(digits + 1, '0');
    return scaled % b === 0n ? `${a < 0n ? '-' : ''}${whole.slice(0, -digits)}.${whole.slice(-digits)}` : null;
}

function spellings(answer) {
    const list = readAnswer(answer), decimals = list.map(decimalOf);
    return [
        answer, list.map(([a, b]) => `${2n * a}/${2n * b}`).join(' '), `(${answer.replaceAll(';', '').split(' ').join(', ')})`, answer.replaceAll('-', '−'),
        ...(decimals.includes(null) ? [] : [decimals.join(' ')]), ...(list.length === 1 && decimals[0] !== null ? [decimals[0].replace('.', ',')] : []),
    ];
}

const say = (instance, part, text) => instance.check(instance.parts.map((_, i) => (i === part ? text : '')))[part];

function tryPart(id, instance, i, must, named) {
    const { label, answer, wrongs } = instance.parts[i], word = typeof must.answers[i] === 'string', count = word ? 1 : readAnswer(answer).length;
    const far = id === 'near' && i === 1 ? '0.00001' : '987654321/1000003'; // a near plane has no answer that is unrelated
    const unrelated = say(instance, i, word ? 'perhaps' : Array(count).fill(far).join(' '));
    if (unrelated.ok) {
        fault(id, `${label}: anything is right`);
    }
    const right = word ? answer === must.answers[i] : (id === 'haw-4' && i === 0 ? sameButFactor : sameList)(readAnswer(answer), listOf(must.answers[i]));
    if (!right) {
        fault(id, `${label}: ${answer}, not ${textOf(must.answers[i])}, in: ${instance.text}`);
    }
    for (const text of word ? [answer, ` ${answer.toUpperCase()} `] : spellings(answer)) {
        if (!say(instance, i, text).ok) {
            fault(id, `${label}: ${text} is refused: ${say(instance, i, text).say}`);
        }
    }
    for (const item of wrongs) {
        const told = say(instance, i, item.answer);
        if (told.ok || told.say !== item.say || told.say === unrelated.say) {
            fault(id, `${label}: to ${item.answer} it says ${told.say}`);
        }
    }
    must.wrongs.forEach(([part, value, pattern], at) => {
        if (part !== i || value === null) {
            return;
        }
        const text = textOf(value), told = say(instance, i, text);
        const itself = word ? text === answer : id === 'haw-4' && i === 0 ? false : sameList(listOf(value), readAnswer(answer));
        if (told.ok !== itself) {
            fault(id, `${label}: ${text} is taken for ${told.ok ? 'right' : 'wrong'} in: ${instance.text}`);
        }
        const shared = must.wrongs.some(([otherPart, other], k) => k !== at && otherPart === i && other !== null && textOf(other) === text);
        if (!told.ok && !shared && !pattern.test(told.say)) {
            fault(id, `${label}: to ${text} it says '${told.say}', nothing of ${pattern}, in: ${instance.text}`);
        }
        named[at] = (named[at] ?? 0) + (!told.ok && pattern.test(told.say) && told.say !== unrelated.say ? 1 : 0);
    });
    if (word) {
        return;
    }
    for (const [text, pattern] of [['', /Type an answer/], ['two', /Type numbers/], ['1/0', /Type numbers/], [`${answer} 1`, count === 1 ? /Type numbers/ : /Type \d+ numbers/]]) {
        const told = say(instance, i, text);
        if (told.ok || !pattern.test(told.say)) {
            fault(id, `${label}: to '${text}' it says ${told.say}`);
        }
    }
}

function tryExercise({ id, title, source, make }) {
    const random = generator(1), texts = new Set(), named = [];
    let rounded = 0, wrongs = [];
    for (let n = 0; n < instances; n++) {
        const instance = make(random), must = answersOf[id](instance.text, instance.parts.map((part) => part.label));
        texts.add(instance.text + instance.parts.map((part) => part.label));
        wrongs = must.wrongs;
        if (/NaN|undefined|null|object|\.\d{9}/.test(instance.text + JSON.stringify(instance.parts.map((part) => [part.label, part.answer, part.wrongs.map((item) => item.answer)])))) {
            fault(id, `what is that: ${instance.text}`);
        }
        if (instance.parts.length !== must.answers.length || instance.check([]).length !== instance.parts.length) {
            fault(id, `${instance.parts.length} parts, not ${must.answers.length}`);
            continue;
        }
        for (const [value, low, high] of must.within ?? []) {
            if (!less(q(low), value) || !less(value, q(high))) {
                fault(id, `${textOf(value)} is not between ${low} and ${high}, in: ${instance.text}`);
            }
        }
        instance.parts.forEach((part, i) => tryPart(id, instance, i, must, named));
        const thirds = instance.parts.findIndex((part) => /^-?\d+\/(3|7|9|11)$/.test(part.answer));
        if (thirds >= 0) {
            const [[a, b]] = readAnswer(instance.parts[thirds].answer);
            rounded += /rounded/.test(say(instance, thirds, (Number(a) / Number(b)).toFixed(4)).say) ? 1 : 0;
            rounded -= say(instance, thirds, (Number(a) / Number(b)).toFixed(4)).ok ? instances : 0;
        }
    }
    if (texts.size < Math.min(instances, 100) / 2) {
        fault(id, `only ${texts.size} different instances`);
    }
    wrongs.forEach(([part, , pattern], at) => {
        if (!(named[at] > 0)) {
            fault(id, `part ${part + 1}: nothing is said of ${pattern}`);
        }
    });
    if (title === '' || !/HAW|KAIST|EECE|LMU|4600/.test(source) || rounded < 0) {
        fault(id, 'no title or source, or a rounded number is right');
    }
    return rounded;
}

const rounded = exercises.map(tryExercise);
if (Math.max(...rounded) <= 0) {
    fault('all', 'nothing is said of rounding');
}
if (exercises.length !== 20 || new Set(exercises.map(({ id }) => id)).size !== 20) {
    fault('all', `${exercises.length} exercises`);
}
console.log(wrong.join('\n') || `${exercises.length} exercises, ${instances} instances each`);
process.exit(wrong.length === 0 && instances > 0 ? 0 : 1);
