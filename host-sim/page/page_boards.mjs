// boards: the table of what a scene needs on each board.
import { count } from './page_facts.mjs';

// choose(index) is called when the user takes a board.
export function showBoards(body, boards, report, chosen, choose) {
    body.replaceChildren(...boards.map((board, i) => {
        const row = document.createElement('tr'), { needs, has } = report.boards[i];
        const button = document.createElement('button');
        button.type = 'button';
        button.textContent = board.name;
        button.addEventListener('click', () => choose(i));
        const name = document.createElement('th');
        name.scope = 'row';
        name.append(button);
        const texts = [`${board.width}x${board.height}`, count(needs), count(has), needs <= has ? 'fits' : `${count(needs - has)} too many`];
        row.append(name, ...texts.map((text) => Object.assign(document.createElement('td'), { textContent: text })));
        row.classList.toggle('chosen', i === chosen);
        row.classList.toggle('lacks', needs > has);
        return row;
    }));
}
