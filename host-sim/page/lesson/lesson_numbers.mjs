// lesson_numbers: what pinhole-sim prints of a camera, read, and shown as tables and matrices.

const LESSON_STAGES = ['object', 'world', 'view', 'clip', 'ndc', 'distance', 'angle', 'radius', 'pixel', 'depth', 'blur'];

// Reads what --matrix factors, --point and --frustum print: { matrices: { name: 4 rows of 4 texts }, lines: { label: [fraction,
// decimal, code, error] } }. A depth has a code and its share. Of several cameras it is the first.
export function readLessonText(text) {
    const matrices = {}, lines = {};
    let matrix = null;
    for (const line of text.split('\n')) {
        const words = line.split(' ');
        if (/^camera [2-9] of/.test(line)) {
            break;
        }
        if (/^[a-z]+$/.test(line)) {
            matrix = matrices[line] = [];
        } else if (words[0].startsWith('depth.')) {
            lines[words[0]] = ['', words[2], words[1], ''];
        } else if (/^[A-Za-z]/.test(line) && words.length === 5) {
            lines[words[0]] = words.slice(1);
        } else if (words.length === 4 && matrix !== null) {
            matrix.push(words);
        }
    }
    return { matrices, lines };
}

const lessonElement = (tag, texts) => Object.assign(document.createElement(tag), texts);

// A table whose rows are `labels`; set(lines) fills it. Rows that belong together begin with a line above them.
function lessonTable(caption, labels) {
    const table = lessonElement('table', { className: 'lesson-lines' }), cells = new Map();
    const head = lessonElement('thead', { innerHTML: '<tr><th scope="col"></th><th scope="col">fraction</th><th scope="col">decimal</th><th scope="col">Q16.16 code</th><th scope="col">error</th></tr>' });
    const body = lessonElement('tbody', {});
    let before = '';
    for (const label of labels) {
        const row = lessonElement('tr', {}), [kind] = label.split('.'), name = lessonElement('th', { scope: 'row', textContent: label });
        row.dataset.label = label;
        row.classList.toggle('first', kind !== before);
        before = kind;
        const four = Array.from({ length: 4 }, () => lessonElement('td', {}));
        row.append(name, ...four);
        body.append(row);
        cells.set(label, four);
    }
    table.append(lessonElement('caption', { textContent: caption }), head, body);
    return { table, set: (lines) => cells.forEach((four, label) => four.forEach((cell, i) => {
        const text = (lines[label]?.[i] ?? '').replace('-', '\u2212'); // a minus sign is as wide as a plus
        if (cell.textContent !== text) {
            cell.textContent = text;
            cell.title = i === 0 ? text : ''; // a long fraction is cut off
        }
    })) };
}

const isLessonStage = (label) => LESSON_STAGES.includes(label.split('.')[0]);

// Shows the lines in two elements: the vertex at every stage, and all else. The tables are made again only where other lines are.
export function makeLessonLines(stages, others) {
    let shown = null, tables = [];
    return (lines) => {
        const labels = Object.keys(lines);
        if (labels.join() !== shown) {
            shown = labels.join();
            tables = [lessonTable('The vertex at every stage; the error in steps of 1/65536', labels.filter(isLessonStage)),
                lessonTable('What the matrices are products of, and what the camera sees', labels.filter((label) => !isLessonStage(label)))];
            stages.replaceChildren(tables[0].table);
            others.replaceChildren(tables[1].table);
        }
        tables.forEach(({ set }) => set(lines));
    };
}

// A matrix of 16 cells in an element. edit(cells) is called with their texts when one was typed; without it they are plain text.
export function makeLessonMatrix(element, name, title, edit) {
    const heading = lessonElement('h3', { textContent: title }), grid = lessonElement('div', { className: 'lesson-matrix' });
    const cells = Array.from({ length: 16 }, (_, i) => {
        const cell = edit ? lessonElement('input', { type: 'text', inputMode: 'decimal', autocomplete: 'off', spellcheck: false }) : lessonElement('span', {});
        cell.dataset.label = `${name}.${i >> 2}.${i & 3}`;
        if (edit) {
            cell.setAttribute('aria-label', `${title}, row ${i >> 2}, column ${i & 3}`);
            cell.addEventListener('change', () => edit(cells.map((one) => one.value.trim().replace('\u2212', '-'))));
        }
        return cell;
    });
    grid.setAttribute('role', 'group');
    grid.setAttribute('aria-label', title);
    grid.append(...cells);
    element.replaceChildren(heading, grid);
    return (texts) => cells.forEach((cell, i) => { // texts: 16, or undefined
        const text = texts?.[i] ?? '', put = edit ? 'value' : 'textContent';
        if (cell[put] !== text) {
            cell[put] = text;
            cell.title = text;
        }
    });
}

// The 16 elements of a factor, whose lines are those that are not the unit matrix's.
export function lessonFactor(lines, name) {
    return Array.from({ length: 16 }, (_, i) => `${+(+(lines[`${name}.${i >> 2}.${i & 3}`]?.[1] ?? +(i % 5 === 0))).toFixed(5)}`);
}
