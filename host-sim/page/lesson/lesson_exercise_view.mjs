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

function showExercise({ title, make }) {
    const body = exercisePart('form', { className: 'lesson-exercise', noValidate: true }), details = exercisePart('details', {}, exercisePart('summary', { textContent: title }), body);
    const fill = () => {
        const { text, parts, check } = make(Math.random);
        const inputs = parts.map(() => exercisePart('input', { type: 'text', autocomplete: 'off' })), said = parts.map(() => exercisePart('p', { className: 'said' }));
        const rows = parts.flatMap(({ label }, i) => [exercisePart('label', { textContent: `${label} ` }, inputs[i]), said[i]]);
        const other = exercisePart('button', { type: 'button', textContent: 'Other numbers' });
        said.forEach((line) => line.setAttribute('role', 'status'));
        other.addEventListener('click', fill);
        body.onsubmit = (event) => {
            event.preventDefault();
            check(inputs.map(({ value }) => value)).forEach(({ ok, say }, i) => {
                said[i].textContent = ok ? `right${say ? `: ${say}` : ''}` : say;
                said[i].classList.toggle('wrong', !ok);
            });
        };
        body.replaceChildren(exercisePart('p', { className: 'lesson-task', textContent: text }), ...rows,
            exercisePart('div', { className: 'transport' }, exercisePart('button', { type: 'submit', className: 'main', textContent: 'Check' }), other));
    };
    details.addEventListener('toggle', () => details.open && body.childElementCount === 0 && fill());
    return details;
}

// Fills the element. open(address) is called with the address of a chapter.
export function openLessonExercises(element, open) {
    element.hidden = chapters.length + exercises.length === 0;
    const left = exercisePart('div', {}, exercisePart('h2', { textContent: 'Chapters' })), right = exercisePart('div', {}, exercisePart('h2', { textContent: 'Exercises' }));
    showChapters(left, open);
    right.append(...exercises.map(showExercise));
    element.append(left, right);
}
