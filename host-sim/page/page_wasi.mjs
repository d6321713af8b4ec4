// wasi: the calls of WASI that the C library of a module makes. What is printed is kept until it is taken; files are those
// that the page gives, and can only be read.

const BADF = 8, NOENT = 44, SPIPE = 70;
const DEVICE = 2, FOLDER = 3, FILE = 4;
const ROOT = 3; // the descriptor of the folder that has all files

// Takes "." and ".." out of a path.
function plain(path) {
    const names = [];
    for (const name of path.split('/')) {
        if (name === '..') {
            names.pop();
        } else if (name !== '' && name !== '.') {
            names.push(name);
        }
    }
    return names.join('/');
}

// Returns what a module imports, and take(file): what was printed on 1 or 2. memory() is the module's; files is a Map of
// paths and bytes. A file that is in no folder of that name is looked for by its name alone, because a user may give the
// pictures of a folder without the folder.
export function makeWasi(memory, files = new Map()) {
    const printed = ['', '', ''], opened = new Map();
    const text = new TextDecoder();
    const view = () => new DataView(memory().buffer);
    const bytes = (at, size) => new Uint8Array(memory().buffer, at, size);
    const find = (at, size) => {
        const path = plain(text.decode(bytes(at, size))), name = path.replace(/.*\//, '');
        return files.get(path) ?? [...files].find(([other]) => other.replace(/.*\//, '') === name)?.[1];
    };
    const lists = (list, count) => Array.from({ length: count }, (_, i) =>
        bytes(view().getUint32(list + 8 * i, true), view().getUint32(list + 8 * i + 4, true)));
    const wasi = {
        fd_write(file, list, count, written) {
            const parts = lists(list, count);
            parts.forEach((part) => {
                printed[file] += text.decode(part);
            });
            view().setUint32(written, parts.reduce((sum, part) => sum + part.length, 0), true);
            return 0;
        },
        fd_read(file, list, count, done) {
            const from = opened.get(file);
            let all = 0;
            for (const part of from !== undefined ? lists(list, count) : []) {
                const piece = from.bytes.subarray(from.at, from.at + part.length);
                part.set(piece);
                from.at += piece.length;
                all += piece.length;
            }
            view().setUint32(done, all, true);
            return from === undefined ? BADF : 0;
        },
        fd_fdstat_get(file, to) {
            bytes(to, 24).fill(0)[0] = opened.has(file) ? FILE : file === ROOT ? FOLDER : DEVICE;
            bytes(to + 8, 16).fill(255); // it may do all that there is
            return 0;
        },
        fd_fdstat_set_flags: () => 0,
        fd_seek(file, offset, whence, to) {
            const from = opened.get(file);
            if (from === undefined) {
                return SPIPE;
            }
            from.at = Math.max(0, Number(offset) + [0, from.at, from.bytes.length][whence]);
            view().setBigUint64(to, BigInt(from.at), true);
            return 0;
        },
        fd_close(file) {
            opened.delete(file);
            return 0;
        },
        fd_prestat_get(file, to) {
            bytes(to, 8).fill(0)[4] = 1; // the length of "/"
            return file === ROOT && files.size > 0 ? 0 : BADF;
        },
        fd_prestat_dir_name(file, to) {
            bytes(to, 1)[0] = '/'.charCodeAt(0);
            return 0;
        },
        path_filestat_get(folder, flags, at, size, to) {
            const found = find(at, size);
            bytes(to, 64).fill(0)[16] = FILE;
            view().setBigUint64(to + 32, BigInt(found?.length ?? 0), true);
            return found === undefined ? NOENT : 0;
        },
        path_open(folder, look, at, size, how, rights, inherited, flags, to) {
            const found = find(at, size);
            if (found === undefined) {
                return NOENT;
            }
            let file = ROOT + 1;
            while (opened.has(file)) {
                file++;
            }
            opened.set(file, { bytes: found, at: 0 });
            view().setUint32(to, file, true);
            return 0;
        },
        proc_exit() {
            throw new Error('the module ended');
        },
    };
    const take = (file) => {
        const all = printed[file];
        printed[file] = '';
        return all;
    };
    return { wasi, take };
}
