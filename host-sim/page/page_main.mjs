// main: starts the module that stands in the page, and opens the tabs.
import { startCore } from './page_core.mjs';
import { openKit } from './page_kit.mjs';
import { showTabs } from './page_tabs.mjs';

const tabs = [{ id: 'kit', title: 'Kit', open: openKit }];

try {
    const wasm = atob(document.getElementById('wasm').textContent.trim());
    const core = await startCore(Uint8Array.from(wasm, (letter) => letter.charCodeAt(0)));
    tabs.forEach((tab) => tab.open(core));
    showTabs(document.getElementById('tabs'), tabs);
} catch (error) {
    const said = document.getElementById('said');
    said.textContent = `the simulator does not start: ${error.message}`;
    said.classList.add('wrong');
}
