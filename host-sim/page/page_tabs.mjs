// tabs: one part of the page is shown at a time, by buttons that are there from two parts on. A part hears the event `leave`
// before it is hidden, and `enter` once it is shown. Returns show(id).

export function showTabs(nav, tabs) {
    const sections = tabs.map((tab) => document.getElementById(tab.id));
    const buttons = tabs.map((tab) => {
        const button = document.createElement('button');
        button.type = 'button';
        button.textContent = tab.title;
        button.setAttribute('role', 'tab');
        button.setAttribute('aria-controls', tab.id);
        return button;
    });
    const take = (chosen) => {
        buttons.forEach((button, i) => {
            if (i !== chosen && !sections[i].hidden) {
                sections[i].dispatchEvent(new Event('leave'));
            }
            button.setAttribute('aria-selected', i === chosen);
            button.tabIndex = i === chosen ? 0 : -1;
            sections[i].hidden = i !== chosen;
        });
        sections[chosen].dispatchEvent(new Event('enter'));
    };
    const show = (id) => take(tabs.findIndex((tab) => tab.id === id));
    buttons.forEach((button, i) => {
        button.addEventListener('click', () => take(i));
        button.addEventListener('keydown', (event) => {
            const to = i + (event.key === 'ArrowRight') - (event.key === 'ArrowLeft');
            if (to !== i && buttons[to] !== undefined) {
                take(to);
                buttons[to].focus();
            }
        });
    });
    nav.replaceChildren(...buttons);
    nav.hidden = tabs.length < 2;
    return show;
}
