// main: starts the modules that stand in the page, and opens the tabs.
import { tabOf } from './page_address.mjs';
import { startCore } from './page_core.mjs';
import { unpack } from './page_files.mjs';
import { startFlash } from './page_flash.mjs';
import { openLesson } from './lesson/lesson_tab.mjs';
import { openKit } from './page_kit.mjs';
import { openModelTab } from './page_model.mjs';
import { showTabs } from './page_tabs.mjs';

const moduleOf = (id) => unpack(document.getElementById(id).textContent.trim());

try {
    const [wasm, model_wasm] = await Promise.all([moduleOf('wasm'), moduleOf('model_wasm')]);
    const core = await startCore(wasm);
    document.getElementById('kit').hidden = tabOf(location.hash) !== 'kit';
    const flasher = () => startFlash(wasm);
    openKit(core, flasher);
    openModelTab(core, () => startCore(wasm), () => model_wasm, flasher);
    openLesson(() => startCore(wasm));
    const show = showTabs(document.getElementById('tabs'), [{ id: 'kit', title: 'Kit' }, { id: 'model', title: 'Model' }, { id: 'lesson', title: 'Lesson' }]);
    const follow = () => show(tabOf(location.hash));
    window.addEventListener('hashchange', follow);
    follow();
} catch (error) {
    const said = document.getElementById('said');
    said.textContent = `the simulator does not start: ${error.message}`;
    said.classList.add('wrong');
}
