// The flash of an RP2040 board, which in rp2040js is as fast as RAM: the serial unit that reads it (SSI, datasheet 4.10),
// the chip (Winbond W25Q16JV) and the cache before it (XIP, datasheet 2.6.3).
//
//   const flash = makeFlash(machine, id);       id: what the chip answers to 9Fh, e.g. [0xef, 0x40, 0x15]
//   core.cycles += flash.read(own, address);    cycles that a core waits for a word in flash
//
// The cache has 16 KB, two ways, lines of two words. A miss reads one word (the SSI's frame has 32 bits), the other word
// of the line stays unknown. Both cores share it; a core that misses while the other one's word is on its way waits for
// that, too. A miss takes the clocks of the SSI's command, times its divider: 64 x 4 with command 03h on one line,
// 20 x 2 and QUAD_MORE on four.
//
// Not known, and taken so: the older way of a set is replaced; the SSI adds nothing to its clocks on one line, and
// QUAD_MORE cycles on four; a core fetches no word that it does not run; the DMA reads no flash.

const SETS = 1024, WAYS = 2, TAG_SHIFT = 13;
const QUAD_MORE = 5;
const SSI = 0x18000, SSIENR = 0x08, SR = 0x28, DR0 = 0x60;
const SR_IDLE = 0x06; // TFE, TFNF
const RECEIVED = 0x08; // RFNE
const READ_TMOD = 3;
const QUAD = 2; // SPI_FRF
const INSTRUCTION_BITS = [0, 4, 8, 16];
const STATUS2_QE = 2;

// The chip: what it answers to the bytes of a transfer. `continuous`: it expects an address, no command, on four lines.
function makeChip(machine, id) {
  const chip = { status2: STATUS2_QE, continuous: false, volatileWrite: false };
  chip.answer = (bytes) => {
    const n = bytes.length - 1;
    switch (bytes[0]) {
      case 0x9f: return n > 0 ? id[n - 1] ?? 0 : 0;
      case 0x05: return 0;
      case 0x35: return n > 0 ? chip.status2 : 0;
      case 0x50: case 0x01: return 0;
      default:
        machine.warn(`the flash got a command ${bytes[0].toString(16)}`);
        return 0;
    }
  };
  chip.end = (bytes) => {
    if (bytes[0] === 0x01) {
      if (!chip.volatileWrite || bytes.length !== 3) {
        machine.warn('a write of the status registers that is not volatile, or not of two bytes');
      }
      chip.status2 = bytes[2];
    }
    chip.volatileWrite = bytes[0] === 0x50;
  };
  chip.quadRead = (command, address) => {
    if (command !== 0xeb || (chip.status2 & STATUS2_QE) === 0) {
      machine.warn(`the flash got a quad command ${command.toString(16)}, its QE is ${chip.status2 & STATUS2_QE}`);
    }
    chip.continuous = (address >>> 4 & 15) === 0xa;
  };
  return chip;
}

// The serial unit: transfers of bytes, or of a command and an address, go to the chip. A transfer ends when its FIFO is
// empty, which a program sees in SR.
function addSsi(ssi, chip, changed) {
  const read = ssi.readUint32.bind(ssi), write = ssi.writeUint32.bind(ssi);
  let sent = [], received = [];
  const end = () => {
    if (sent.length > 0 && (ssi.crtlr0 >>> 21 & 3) === 0) {
      chip.end(sent);
    }
    sent = [];
  };
  ssi.readUint32 = (offset) => {
    switch (offset) {
      case SR: end(); return SR_IDLE | (received.length > 0 ? RECEIVED : 0);
      case DR0: return received.shift() ?? 0;
      default: return read(offset);
    }
  };
  ssi.writeUint32 = (offset, value) => {
    write(offset, value);
    if (offset === SSIENR && value === 0) {
      end();
      received = [];
    } else if (offset === DR0) {
      sent.push(value);
      if ((ssi.crtlr0 >>> 21 & 3) === 0) {
        received.push(chip.answer(sent));
      } else if (sent.length === 2) {
        chip.quadRead(...sent);
      }
    }
    changed();
  };
}

export function makeFlash(machine, id) {
  const { mcu } = machine, ssi = mcu.peripherals[SSI], chip = makeChip(machine, id);
  const tags = new Int32Array(SETS * WAYS); // of each line: tag, and a bit for each word that is known; the newer way first
  let missCycles = 0, busyUntil = 0;

  // Cycles of a read as the SSI is set up now.
  const costOf = () => {
    const format = ssi.crtlr0 >>> 21 & 3, control = ssi.spictlr0, lines = format === QUAD ? 4 : 1;
    const instruction = INSTRUCTION_BITS[control >>> 8 & 3], address = 4 * (control >>> 2 & 15), command = control >>> 24;
    if (ssi.ssienr !== 1 || ssi.baudr < 2 || (ssi.crtlr0 >>> 8 & 3) !== READ_TMOD || (ssi.crtlr0 >>> 16 & 31) !== 31) {
      machine.warn('flash is read while the SSI is not set up for it');
    } else if (format === QUAD ? !chip.continuous || instruction !== 0 || (command >>> 4) !== 0xa || (control & 3) !== 2
                               : chip.continuous || instruction !== 8 || command !== 0x03) {
      machine.warn('the SSI reads flash in another way than the flash expects');
    }
    const clocks = instruction / lines + address / lines + (control >>> 11 & 31) + 32 / lines;
    return clocks * ssi.baudr + (format === QUAD ? QUAD_MORE : 0);
  };
  addSsi(ssi, chip, () => { missCycles = 0; });

  const miss = (own) => {
    missCycles ||= costOf();
    machine.misses++;
    const ns = 1e9 / mcu.clkSys, now = own.time + (own.core.cycles - own.counted) * ns;
    const wait = Math.max(0, Math.round((busyUntil - now) / ns)) + missCycles;
    busyUntil = now + wait * ns;
    return wait;
  };

  const look = (own, address) => {
    const set = (address >>> 3 & SETS - 1) * WAYS, known = 1 << (address >>> 2 & 1), tag = (address & 0xffffff) >>> TAG_SHIFT << 2;
    let line = tags[set];
    if ((line & ~3) !== tag || (line & 3) === 0) { // not in the newer way: the older one becomes the newer
      const other = tags[set + 1];
      tags[set + 1] = line;
      line = (other & ~3) === tag ? other : tag;
    }
    tags[set] = line | known;
    return (line & known) !== 0 ? 0 : miss(own);
  };

  return {
    chip,
    reset() { // the ROM ends the continuous mode before it reads boot2
      tags.fill(0);
      chip.continuous = false;
      busyUntil = 0;
    },
    read(own, address) {
      if (machine.freeFlash || address >>> 2 === own.word) {
        return 0;
      }
      own.word = address >>> 2;
      return look(own, address);
    },
  };
}
