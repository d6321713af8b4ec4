// buttons: those of the kit, on the screen and on the keyboard, with pinhole-sim's keys of --window.

const SELECT = 16; // enum hal_button of hal.h
const keys = { ArrowUp: 1, ArrowDown: 2, ArrowLeft: 4, ArrowRight: 8, Enter: SELECT, ' ': SELECT };

// Calls pressed() when a button goes down; others maps other keys to functions. Returns take(): the buttons that are
// held, or were pressed since the last call.
export function watchButtons(glass, screen, pressed, others) {
    let held = 0, since = 0;
    const set = (button, down) => {
        held = down ? held | button : held & ~button;
        since |= down ? button : 0;
        const of = screen.find((element) => +element.dataset.button === button);
        of.classList.toggle('held', down);
        if (down) {
            pressed();
        }
    };
    glass.addEventListener('keydown', (event) => {
        const button = keys[event.key], other = others[event.key];
        if ((button === undefined && other === undefined) || event.ctrlKey || event.altKey || event.metaKey) {
            return;
        }
        event.preventDefault();
        if (other !== undefined) {
            other();
        } else if (!event.repeat) {
            set(button, true);
        }
    });
    glass.addEventListener('keyup', (event) => keys[event.key] !== undefined && set(keys[event.key], false));
    glass.addEventListener('blur', () => Object.values(keys).forEach((button) => set(button, false)));
    for (const element of screen) {
        const button = +element.dataset.button;
        element.addEventListener('pointerdown', () => set(button, true));
        for (const end of ['pointerup', 'pointercancel', 'pointerleave']) {
            element.addEventListener(end, () => set(button, false));
        }
        element.addEventListener('click', (event) => { // by Enter or space, which have no pointer
            if (event.detail === 0) {
                set(button, true);
                set(button, false);
            }
        });
    }
    return () => {
        const all = held | since;
        since = 0;
        return all;
    };
}
