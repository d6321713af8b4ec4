// lesson_exercise_view: the chapters as links, and the exercises that check themselves.
import { chapters } from './lesson_chapters.mjs';
import { exercises } from './lesson_exercises.mjs';

const exercisePart = (tag, texts, ...children) => {
    const element = Object.assign(document.createElement(tag), texts);
    element.append(...children);
    return element;
};

function showChapters(element, open) {
    for (const document of new Set(chapters.map((chapter) => chapter.document))) {
        const list = exercisePart('ol', {});
        for (const { slide, title, text, address } of chapters.filter((chapter) => chapter.document === document)) {
            const link = exercisePart('a', { href: address, textContent: title });
            link.addEventListener('click', (event) => {
                event.preventDefault();
                open(address);
            });
            list.append(exercisePart('li', {}, link, exercisePart('span', { className: 'hint', textContent: ` ${slide}. ${text}` })));
        }
        element.append(exercisePart('details', {}, exercisePart('summary', { textContent: document }), list));
    }
}

// open(address) shows an exercise's numbers above.
function showExercise({ title, source, make }, open) {
    const body = exercisePart('form', { className: 'lesson-exercise', noValidate: true }), details = exercisePart('details', {}, exercisePart('summary', { textContent: title }), body);
    let judge = () => {};
    const fill = () => {
        const { text, parts, address, check } = make(Math.random);
        const inputs = parts.map(() => exercisePart('input', { type: 'text', autocomplete: 'off', spellcheck: false })), said = parts.map(() => exercisePart('p', { className: 'said' }));
        const rows = parts.flatMap(({ label }, i) => [exercisePart('label', { textContent: `${label} ` }, inputs[i]), said[i]]);
        const buttons = [exercisePart('button', { type: 'submit', className: 'main', textContent: 'Check' }), exercisePart('button', { type: 'button', textContent: 'Other numbers', onclick: fill })];
        said.forEach((line) => line.setAttribute('role', 'status'));
        judge = () => check(inputs.map(({ value }) => value)).forEach(({ ok, say }, i) => {
            said[i].textContent = ok ? 'right' : say;
            said[i].classList.toggle('wrong', !ok);
        });
        if (address) {
            buttons.push(exercisePart('button', { type: 'button', textContent: 'Show it above', onclick: () => open(address) }));
        }
        body.replaceChildren(exercisePart('p', { className: 'lesson-task', textContent: text }), ...rows,
            exercisePart('div', { className: 'transport' }, ...buttons), exercisePart('p', { className: 'hint', textContent: source }));
    };
    body.addEventListener('submit', (event) => {
        event.preventDefault();
        judge();
    });
    details.addEventListener('toggle', () => details.open && body.childElementCount === 0 && fill());
    return details;
}

// Fills the element. open(address) is called with the address of a chapter, or of an exercise's numbers.
export function openLessonExercises(element, open) {
    const left = exercisePart('div', {}, exercisePart('h2', { textContent: 'Chapters' })), right = exercisePart('div', {}, exercisePart('h2', { textContent: 'Exercises' }));
    showChapters(left, open);
    right.append(...exercises.map((exercise) => showExercise(exercise, open)));
    element.append(left, right);
}
