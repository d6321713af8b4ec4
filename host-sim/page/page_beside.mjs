// beside: the unsimplified model, on a glass of the board's size that has memory for it.
import { at, count } from './page_facts.mjs';
import { makeGlass } from './page_glass.mjs';

// startAnother() starts a module of its own; move(...way) moves both cameras.
export function makeBeside(startAnother, move) {
    let core = null, shown = false;
    const glass = makeGlass(at('model-whole'), move);
    const beside = {
        // Shows this scene from frame 0 on. Resolves to '' or to what is wrong.
        async show(scene, { width, height }, triangles) {
            core ??= await startAnother();
            const wrong = core.scene(scene) || (core.open({ width, height, demo: -1 }) ? '' : core.messages());
            shown = wrong === '';
            at('model-beside').hidden = !shown;
            at('model-whole-title').textContent = `unsimplified: ${count(triangles)} triangles`;
            return wrong;
        },
        hide() {
            shown = false;
            at('model-beside').hidden = true;
        },
        drag: (...way) => shown && core.drag(...way),
        draw(frame) {
            if (shown && core.frame(frame)) {
                glass.show(core.glass());
            }
        },
    };
    return beside;
}
