// Usage: node chapters.mjs PINHOLE-SIM STEP
// The chapters of the page's lesson: as many of each document as tests/host-sim/lesson.txt has things of it, each with words
// and an address of pinhole-sim's options, and each in the table for teachers in host-sim/README.md. Every STEPth address is given to pinhole-sim, and must run without a complaint.
import { execFileSync, spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { chapters } from '../../../host-sim/page/lesson/lesson_chapters.mjs';

const [simulator, step] = process.argv.slice(2);
const wrong = [];
const things = readFileSync(new URL('../lesson.txt', import.meta.url), 'utf8').match(/^(HAW|KAIST|EECE|4600|LMU) \d+(?= \|)/gm).map((line) => /(\w+) \d+$/.exec(line)[1]);
const counts = (list) => [...new Set(list)].map((document) => `${document} ${list.filter((item) => item === document).length}`).join();
if (counts(things) !== counts(chapters.map(({ document }) => document)) || chapters.length !== 55) {
    wrong.push(`${counts(chapters.map(({ document }) => document))}, not ${counts(things)}`);
}
const options = new Set(execFileSync(simulator, ['--help'], { encoding: 'utf8' }).match(/^ {2}--[a-z-]+/gm).map((line) => line.slice(4)));
chapters.forEach(({ document, slide, title, text, address }, i) => {
    const name = `${document}, ${title}`, words = [...new URLSearchParams(address.slice(1))];
    if (!address.startsWith('#tab=lesson&') || /[ "']/.test(address) || words.length < 2) {
        wrong.push(`${name}: ${address}`);
    }
    const unknown = words.slice(1).find(([option, value]) => !options.has(option) || value === '');
    if (unknown !== undefined || new Set(words.map(([option]) => option)).size !== words.length) {
        wrong.push(`${name}: ${unknown ?? 'an option twice'}`);
    }
    if (slide === '' || title === '' || text.length > 220 || !text.endsWith('.')) {
        wrong.push(`${name}: ${text}`);
    }
    if (i % step === 0) {
        const list = words.slice(1).map(([option, value]) => `--${option}=${value}`);
        const { status, stderr } = spawnSync(simulator, [...(words.some(([option]) => option === 'demo') ? [] : ['--demo', 'cube']), ...list, '--crc'], { encoding: 'utf8' });
        if (status !== 0 || stderr !== '') {
            wrong.push(`${name}: ${stderr || status}`);
        }
    }
});
// A cell such as `KAIST 5, 7, 8` or `LMU 1 to 8`
const teachers = /^## For teachers[^]*?^## pinhole-asset/m.exec(readFileSync(new URL('../../../host-sim/README.md', import.meta.url), 'utf8'))[0];
const named = [...teachers.matchAll(/ \| (HAW|KAIST|EECE|4600|LMU) (\d[\d, to]*) \| /g)].flatMap(([, document, cell]) => cell.split(', ').flatMap((part) => {
    const [first, last = first] = part.split(' to ').map(Number);
    return Array.from({ length: last - first + 1 }, (_, i) => `${document} ${first + i}`);
}));
const numbered = chapters.map(({ document }, i) => `${document} ${1 + i - chapters.findIndex((chapter) => chapter.document === document)}`);
wrong.push(...numbered.filter((name) => !named.includes(name)).map((name) => `README.md: ${name} is missing`), ...named.filter((name) => !numbered.includes(name)).map((name) => `README.md: ${name}: no such chapter`));
if (new Set(chapters.map(({ document, title }) => document + title)).size !== chapters.length) {
    wrong.push('a title twice');
}
console.log(wrong.join('\n') || `${chapters.length} chapters`);
process.exit(wrong.length === 0 && step > 0 ? 0 : 1);
