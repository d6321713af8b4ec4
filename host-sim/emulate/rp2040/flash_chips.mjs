// Serial flashes as data, and what one answers. The names and JEDEC ids are those of chips that are on Picos and their
// clones; that GD25Q16C has the short table of JESD216 of 2011 is known, what the others tell is chosen to differ.
//
//   const chip = makeChip(data, object);     object(text): the chip got what it does not know, or what wears it
//   chip.answer(bytes)                       the answer to the last byte of a transfer of bytes
//   chip.end(bytes)                          the transfer's end
//   chip.read(read)                          null, or what is wrong with a read: { command (null: none is sent), lines, mode (null: no
//                                            mode bits are sent), dummy, hz }. lines: of address and data, '1-1', '1-4' or '4-4'
//
// A chip: id; reads, by command: lines, clocks of mode bits, dummy clocks, Hz at most; qe, the bit QE at power-on;
// needs, the way to QE (JESD216B 6.4.18, QER); until, the bits of double word 16 that tell how a status is written; words,
// double words of its table (0: it has no parameters); continuous: mode bits A0h save the next read its command;
// tclqv and tclqx, ns. lies: it takes other dummy clocks than it tells.

const SERIAL = { 0x03: { lines: '1-1', mode: 0, dummy: 0, hz: 50e6 }, 0x0b: { lines: '1-1', mode: 0, dummy: 8, hz: 104e6 } };
const OUTPUT = { ...SERIAL, 0x6b: { lines: '1-4', mode: 0, dummy: 8, hz: 104e6 } };
const QUAD = { ...OUTPUT, 0xeb: { lines: '4-4', mode: 2, dummy: 4, hz: 104e6 } };
const UNKNOWN = { tclqv: 8, tclqx: 0 }; // of hal/chips/rp2/flash_margin.h
const FOR_GOOD = 0x01, UNTIL_POWER_OFF = 0x08; // double word 16
const CLONE = { reads: QUAD, qe: false, needs: 5, until: FOR_GOOD | UNTIL_POWER_OFF, words: 16, continuous: true, ...UNKNOWN };
const W25Q = { ...CLONE, id: [0xef, 0x40, 0x15], needs: 4, tclqv: 6, tclqx: 1.5 };

export const CHIPS = {
  w25q16jv: { ...W25Q, qe: true },
  'w25q16jv-im': { ...W25Q, id: [0xef, 0x70, 0x15] },
  w25x16: { ...W25Q, id: [0xef, 0x30, 0x15], reads: SERIAL, words: 0 },
  gd25q16c: { ...CLONE, id: [0xc8, 0x40, 0x15], words: 9 },
  xm25qh16: { ...CLONE, id: [0x20, 0x40, 0x15] },
  zb25vq16: { ...CLONE, id: [0x5e, 0x40, 0x15], needs: 4, continuous: false },
  p25q16h: { ...CLONE, id: [0x85, 0x60, 0x15], needs: 6 },
  is25lp016: { ...CLONE, id: [0x9d, 0x60, 0x15], needs: 2 },
  'no-qe': { ...CLONE, id: [0x20, 0xba, 0x15], needs: 0, until: FOR_GOOD },
  'output-only': { ...CLONE, id: [0x68, 0x40, 0x15], reads: OUTPUT },
  'qe-wears': { ...CLONE, id: [0xa1, 0x40, 0x15], until: FOR_GOOD },
  'qe-is-set': { ...CLONE, id: [0xa1, 0x40, 0x15], until: FOR_GOOD, qe: true },
  'short-table': { ...CLONE, id: [0xa1, 0x40, 0x15], words: 9 },
  liar: { ...CLONE, id: [0x0b, 0x40, 0x15], lies: true },
  plain: { ...CLONE, id: [0x1f, 0x46, 0x01], reads: SERIAL, words: 0 },
};

const TABLE = 0x30; // where the double words are

// The parameters, JESD216B: a header, one parameter header, the basic table.
function parametersOf(data) {
  const bytes = new Uint8Array(256).fill(0xff), view = new DataView(bytes.buffer);
  if (data.words === 0) {
    return bytes;
  }
  const put = (at, word) => view.setUint32(at, word >>> 0, true);
  const minor = data.words > 9 ? 6 : 0, told = (read) => (read ? read.dummy | read.mode << 5 : 0);
  const io = data.reads[0xeb], output = data.reads[0x6b];
  put(0, 0x50444653);
  put(4, 0xff000100 | minor);
  put(8, data.words << 24 | 0x010000 | minor << 8);
  put(12, 0xff000000 | TABLE);
  for (let i = 0; i < data.words; i++) {
    put(TABLE + 4 * i, 0);
  }
  put(TABLE, 0xff8020e5 | (io ? 1 << 21 : 0) | (output ? 1 << 22 : 0));
  put(TABLE + 4, 0x00ffffff); // 16 Mbit
  put(TABLE + 8, (output ? 0x6b000000 : 0) | told(output) << 16 | (io ? 0xeb00 : 0) | told(io));
  if (data.words >= 16) {
    put(TABLE + 56, data.needs << 20 | (data.continuous ? 1 << 18 | 1 << 9 : 0));
    put(TABLE + 60, data.until);
  }
  return bytes;
}

export function makeChip(data, object) {
  const parameters = parametersOf(data), second = data.needs !== 2, bit = second ? 0x02 : 0x40;
  const status = second ? [0, data.qe ? bit : 0] : [data.qe ? bit : 0, 0];
  const hasSecond = second && data.needs !== 0;
  let writable = '';
  const chip = { data, continuous: false };
  const quad = () => data.needs === 0 || (status[second ? 1 : 0] & bit) !== 0;
  const hex = (byte) => byte.toString(16).toUpperCase();

  const answerTo = {
    0x9f: (n) => data.id[n - 1] ?? 0,
    0x5a: (n, bytes) => n < 5 ? 0 : parameters[(bytes[1] << 16 | bytes[2] << 8 | bytes[3]) + n - 5 & 255],
    0x05: () => status[0],
    0x35: hasSecond ? () => status[1] : undefined,
    0x50: (data.until & 0x0c) !== 0 ? () => 0 : undefined,
    0x06: () => 0, 0x01: () => 0,
    0x31: data.needs === 6 ? () => 0 : undefined,
    0x00: () => 0, 0xff: () => 0,
  };
  chip.answer = (bytes) => {
    const n = bytes.length - 1, answer = answerTo[bytes[0]];
    if (answer === undefined) {
      object(`the flash got a command ${hex(bytes[0])}h, which it does not know`);
    }
    return n > 0 && answer !== undefined ? answer(n, bytes) : 0xff;
  };

  const write = (bytes) => {
    if (writable === '') {
      object(`the flash got a command ${hex(bytes[0])}h without 50h before`);
    } else if (writable === '06') {
      object("the flash's status is written for good: it wears, and a kit's other programs find it changed");
    } else if (bytes[0] === 0x31) {
      status[1] = bytes[1];
    } else if (bytes.length !== (second ? 3 : 2) || (data.needs === 6)) {
      object(`the flash got ${bytes.length - 1} bytes of status by command 01h`);
    } else {
      status.splice(0, bytes.length - 1, ...bytes.slice(1));
    }
  };
  chip.end = (bytes) => {
    if (bytes[0] === 0x01 || bytes[0] === 0x31) {
      write(bytes);
    }
    writable = bytes[0] === 0x50 ? '50' : bytes[0] === 0x06 ? '06' : '';
  };

  chip.read = ({ command, lines, mode, dummy, hz }) => {
    const read = data.reads[command ?? 0xeb];
    if (command === null && !chip.continuous) {
      return 'no command is sent, but the flash expects one';
    }
    if (command !== null && chip.continuous) {
      return `the command ${hex(command)}h is sent, but the flash expects an address`;
    }
    if (read === undefined) {
      return `the flash does not know the command ${hex(command)}h`;
    }
    if (lines !== read.lines || (mode !== null) !== (read.mode > 0)) {
      return `the flash takes address and data after ${hex(command ?? 0xeb)}h on ${read.lines} lines${read.mode > 0 ? ' and mode bits' : ''}`;
    }
    if (lines !== '1-1' && !quad()) {
      return `the flash gets ${hex(command ?? 0xeb)}h while its bit QE is 0`;
    }
    if (dummy !== read.dummy + (data.lies && command !== 0x03 ? 2 : 0)) {
      return `the flash takes ${read.dummy} dummy clocks after ${hex(command ?? 0xeb)}h, not ${dummy}`;
    }
    if (hz > read.hz) {
      return `the flash takes ${hex(command ?? 0xeb)}h at ${read.hz / 1e6} MHz at most`;
    }
    if (mode !== null) {
      chip.continuous = data.continuous && mode >>> 4 === 0xa;
    }
    return null;
  };
  return chip;
}
