// reader: the worker that reads models (page_worker.mjs), which starts from a Blob because a page may be opened from a file.

// wasm() is the module of the reader; progress(what, share) is called while it works.
export function makeReader(wasm, progress) {
    let worker = null, waiting = null, id = 0;
    const start = () => {
        const source = document.getElementById('worker').textContent;
        const address = URL.createObjectURL(new Blob([source], { type: 'text/javascript' }));
        worker = new Worker(address);
        worker.addEventListener('message', ({ data }) => {
            if (data.progress !== undefined) {
                progress(data.progress, data.share);
            } else if (waiting !== null && data.id === id) {
                waiting(data);
                waiting = null;
            }
        });
        worker.postMessage({ wasm: wasm() });
        setTimeout(() => URL.revokeObjectURL(address), 10000);
    };
    return {
        // Resolves to what the worker answers; { wrong } says why there is nothing.
        ask(message) {
            if (worker === null) {
                start();
            }
            id++;
            return new Promise((done) => {
                waiting = done;
                worker.postMessage({ id, ...message });
            });
        },
        isBusy: () => waiting !== null,
        // Ends the worker, and all memory that a model takes. What it was asked is never answered.
        stop() {
            worker?.terminate();
            worker = waiting = null;
        },
    };
}
