// files: those that a user drops, or chooses, as a Map of paths and bytes.

const MOST = 2 ** 28; // bytes of all files: each of them is in memory twice

// Lists the files of what was dropped, with those of its folders.
async function listDropped(items) {
    const found = [], open = [...items].map((item) => item.webkitGetAsEntry()).filter((entry) => entry !== null);
    while (open.length > 0) {
        const entry = open.shift();
        if (entry.isFile) {
            found.push([entry.fullPath.slice(1), await new Promise((done, failed) => entry.file(done, failed))]);
            continue;
        }
        const reader = entry.createReader();
        for (let some = [null]; some.length > 0; open.push(...some)) { // it gives a part of them at a time
            some = await new Promise((done, failed) => reader.readEntries(done, failed));
        }
    }
    return found;
}

async function read(list) {
    const size = list.reduce((sum, [, file]) => sum + file.size, 0);
    if (size > MOST) {
        throw new Error(`these files have ${size} bytes, and the page takes ${MOST}`);
    }
    return new Map(await Promise.all(list.map(async ([path, file]) => [path, new Uint8Array(await file.arrayBuffer())])));
}

// Calls given(files) when files are dropped on the element, or chosen by the inputs, and wrong(text) where they cannot be read.
export function watchFiles(element, inputs, given, wrong) {
    const take = (list) => list.then(read).then(given, (error) => wrong(error.message));
    element.addEventListener('dragover', (event) => {
        event.preventDefault();
        element.classList.add('over');
    });
    element.addEventListener('dragleave', () => element.classList.remove('over'));
    element.addEventListener('drop', (event) => {
        event.preventDefault();
        element.classList.remove('over');
        take(listDropped(event.dataTransfer.items));
    });
    for (const input of inputs) {
        input.addEventListener('change', () => {
            take(Promise.resolve([...input.files].map((file) => [file.webkitRelativePath || file.name, file])));
            input.value = ''; // the same file may be chosen again
        });
    }
}

export function saveFile(name, parts, type) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob(parts, { type }));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
