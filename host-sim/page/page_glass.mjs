// glass: the glass of a kit on a canvas, enlarged by whole pixels of the screen, and the pointers that drag on it.

const WHEEL_NOTCH = 100; // pixels that a browser scrolls for a notch of the wheel, as a rule
const LINE = 33; // pixels, where it counts lines
const PINCH_NOTCHES = 16; // a pinch by a factor of e is as many notches; each is 1/16 of the distance

// Tells drags on the element: moved(right, down, notches) in pixels of the picture, whole numbers.
function watchPointers(element, scale, moved) {
    const pointers = new Map();
    let right = 0, down = 0, notches = 0;
    const tell = () => {
        const whole = [right, down, notches].map(Math.trunc);
        if (whole.some((n) => n !== 0)) {
            right -= whole[0];
            down -= whole[1];
            notches -= whole[2];
            moved(...whole.map((n) => Math.max(-64, Math.min(64, n))));
        }
    };
    const spread = () => {
        const [a, b] = [...pointers.values()];
        return Math.max(1, Math.hypot(a.x - b.x, a.y - b.y));
    };
    element.addEventListener('pointerdown', (event) => {
        if (event.button === 0) {
            element.setPointerCapture(event.pointerId);
            pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        }
    });
    element.addEventListener('pointermove', (event) => {
        const before = pointers.get(event.pointerId);
        if (before === undefined) {
            return;
        }
        const apart = pointers.size === 2 ? spread() : 0;
        pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        if (apart > 0) {
            notches += Math.log(spread() / apart) * PINCH_NOTCHES;
        } else {
            right += (event.clientX - before.x) / scale();
            down += (event.clientY - before.y) / scale();
        }
        tell();
    });
    for (const end of ['pointerup', 'pointercancel']) {
        element.addEventListener(end, (event) => pointers.delete(event.pointerId));
    }
    element.addEventListener('wheel', (event) => {
        event.preventDefault();
        notches -= event.deltaY * (event.deltaMode === 0 ? 1 : LINE) / WHEEL_NOTCH;
        tell();
    }, { passive: false });
}

// Returns show(glass), which paints what core.glass() gives, and save(name), which saves it as a PNG of its own size.
export function makeGlass(element, moved) {
    const canvas = element.querySelector('canvas'), stage = element.parentElement;
    const context = canvas.getContext('2d', { alpha: false });
    let image = null;

    // The glass takes the stage's width and most of the window's height.
    const fit = () => {
        const ratio = window.devicePixelRatio, style = getComputedStyle(stage);
        const wide = stage.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight) - 6;
        const high = Math.max(240, 0.7 * window.innerHeight);
        const room = Math.min(wide / canvas.width, high / canvas.height);
        const scale = room * ratio >= 1 ? Math.floor(room * ratio) / ratio : room;
        canvas.style.width = `${canvas.width * scale}px`;
        canvas.style.height = `${canvas.height * scale}px`;
        canvas.classList.toggle('enlarged', scale * ratio >= 1);
    };
    new ResizeObserver(fit).observe(stage);
    window.addEventListener('resize', fit);
    watchPointers(element, () => canvas.clientWidth / canvas.width, moved);

    const show = ({ width, height, rgb, round }) => {
        if (image === null || canvas.width !== width || canvas.height !== height) {
            canvas.width = width;
            canvas.height = height;
            image = context.createImageData(width, height);
            fit();
        }
        element.classList.toggle('round', round);
        const to = image.data;
        for (let i = 0, k = 0; i < rgb.length; i += 3, k += 4) {
            to[k] = rgb[i];
            to[k + 1] = rgb[i + 1];
            to[k + 2] = rgb[i + 2];
            to[k + 3] = 255;
        }
        context.putImageData(image, 0, 0);
    };
    const save = (name) => canvas.toBlob((blob) => {
        const link = document.createElement('a');
        link.href = URL.createObjectURL(blob);
        link.download = name;
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    });
    return { show, save, describe: (text) => canvas.setAttribute('aria-label', text) };
}
