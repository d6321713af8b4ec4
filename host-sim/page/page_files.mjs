// files: those that a user drops, or chooses, as a Map of paths and bytes; those that are saved; and those in the page.

const MOST = 2 ** 28; // bytes of all files: each of them is in memory twice

// Lists a folder's files, as [path, file]. A page that was opened from a file gets no file of a FileSystemEntry, but one of a
// handle; browsers without handles have entries.
async function listHandle(folder, path, found) {
    for await (const item of folder.values()) {
        if (item.kind === 'directory') {
            await listHandle(item, `${path}${item.name}/`, found);
        } else {
            found.push([path + item.name, await item.getFile()]);
        }
    }
}

async function listEntry(folder, path, found) {
    const reader = folder.createReader();
    for (let some = [null]; some.length > 0;) { // it gives a part of them at a time
        some = await new Promise((done, failed) => reader.readEntries(done, failed));
        for (const item of some) {
            if (item.isDirectory) {
                await listEntry(item, `${path}${item.name}/`, found);
            } else {
                found.push([path + item.name, await new Promise((done, failed) => item.file(done, failed))]);
            }
        }
    }
}

// Lists the files of what was dropped, with those of its folders. The items are there only until the first await.
async function listDropped(items) {
    const found = [];
    const given = [...items].filter(({ kind }) => kind === 'file').map((item) => {
        const entry = item.webkitGetAsEntry(), is_folder = entry?.isDirectory;
        return { file: item.getAsFile(), entry: is_folder ? entry : null, handle: is_folder ? item.getAsFileSystemHandle?.() : null };
    });
    for (const { file, entry, handle } of given) {
        if (entry === null) {
            found.push([file.name, file]);
        } else if (handle !== undefined) {
            await listHandle(await handle, `${entry.name}/`, found);
        } else {
            await listEntry(entry, `${entry.name}/`, found);
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

// Resolves to the bytes that stand as base64 of gzip in the page, or beside it.
export async function unpack(text) {
    const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    return new Uint8Array(await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer());
}
