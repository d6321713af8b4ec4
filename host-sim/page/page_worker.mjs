// worker: reads models and makes scenes of them, in a worker of its own (page_model.h). The page sends {id, call, ...} and
// gets {id, ...} when it is done; meanwhile {progress, share}. Its first message has the module.
import { makeWasi } from './page_wasi.mjs';

// Returns the calls of one instance of the module, which reads one model from these files.
export async function openModel(module, files, tell) {
    let calls = null;
    const { wasi, take } = makeWasi(() => calls.memory, files);
    const text = (at) => {
        const bytes = new Uint8Array(calls.memory.buffer, at, 64);
        return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
    };
    const instance = await WebAssembly.instantiate(module, {
        wasi_snapshot_preview1: wasi,
        page: { progress: (what, share) => tell(text(what), share) },
    });
    calls = instance.exports;
    calls._initialize();
    const said = () => take(2).trim().split('\n').at(-1).replace(/^pinhole: (model )?/, '');
    return {
        // up: '', 'y' or 'z'; filter, light: their numbers; background: 0xRRGGBB, or -1 for the usual. Returns '' or what is wrong.
        open(path, { up, filter, two_sided, background, light }) {
            const bytes = new TextEncoder().encode(`${path}\0`);
            if (bytes.length > 1024) { // PAGE_MODEL_PATH
                return 'the path of the file is too long';
            }
            new Uint8Array(calls.memory.buffer, calls.page_model_path(), bytes.length).set(bytes);
            return calls.page_model_open(up.charCodeAt(0) || 0, filter, two_sided, background, light) === 0 ? '' : said();
        },
        // Returns { scene, report }, or { wrong }.
        make({ board, triangles, texture_log2, turntable, clip }) {
            const size = calls.page_model_make(board, triangles, texture_log2, turntable, clip);
            if (size === 0) {
                return { wrong: said() };
            }
            const scene = new Uint8Array(calls.memory.buffer, calls.page_model_scene(), size).slice();
            calls.page_model_report();
            return { scene, report: JSON.parse(take(1)) };
        },
        c() {
            calls.page_model_c();
            return { text: take(1) };
        },
    };
}

if (typeof WorkerGlobalScope !== 'undefined') {
    let module = null, model = null, last = 0;
    const tell = (progress, share) => {
        if (performance.now() - last > 100) {
            last = performance.now();
            postMessage({ progress, share });
        }
    };
    const answer = async ({ call, files, path, options, goal }) => {
        if (call === 'open') {
            model = await openModel(module, files, tell);
            const wrong = model.open(path, options);
            return wrong !== '' ? { wrong } : {};
        }
        return call === 'make' ? model.make(goal) : model.c();
    };
    addEventListener('message', async ({ data }) => {
        if (data.wasm !== undefined) {
            module = WebAssembly.compile(data.wasm);
            return;
        }
        try {
            module = await module;
            postMessage({ id: data.id, ...await answer(data) });
        } catch (error) { // a hostile file has crashed the module, or taken all of its memory
            postMessage({ id: data.id, wrong: `it is broken, or too large for this page: the reader stopped (${error.message})` });
        }
    });
}
