// The flash of an RP2040 board, which in rp2040js is as fast as RAM: the serial unit that reads it (SSI, datasheet 4.10), the
// chip (flash_chips.mjs) and the cache before it (XIP, datasheet 2.6.3).
//
//   const flash = makeFlash(machine, data);     data: one of CHIPS
//   core.cycles += flash.read(own, address);    cycles that a core waits for a word in flash
//   value = flash.probe(own, value);            the same past the cache: what the SSI makes of the word there
//
// The SSI is strict: a write that the SSI disregards, a bit whose effect is not modelled, a read that the flash does not
// take, and one whose bits are not sampled by hal/chips/rp2/flash_margin.h are objections. A read past the cache may try out what is
// safe: where the bits are not sampled in time it gets wrong ones, and nobody objects.
//
// The cache has 16 KB, two ways, lines of two words. A miss reads one word (the SSI's frame has 32 bits), the other word
// of the line stays unknown. Both cores share it; a core that misses while the other one's word is on its way waits for
// that, too. A miss takes the clocks of the SSI's command, times its divider: 64 x 4 with command 03h on one line,
// 20 x 2 and QUAD_MORE on four.
//
// What the datasheet leaves open is assumed: the older way of a set is replaced; the SSI adds nothing to its clocks on one line, and
// QUAD_MORE cycles on four; a core fetches no word that it does not run; the DMA reads no flash.

import { makeChip } from './flash_chips.mjs';

const SETS = 1024, WAYS = 2, TAG_SHIFT = 13;
const QUAD_MORE = 5;
const SSI = 0x18000, CLOCKS = 0x40008, PLL_SYS = 0x40028, SSIENR = 0x08, SR = 0x28, DR0 = 0x60;
const SR_IDLE = 0x06; // TFE, TFNF
const RECEIVED = 0x08; // RFNE
const FIFO_ENTRIES = 16;
const READ_TMOD = 3;
const STANDARD = 0, QUAD = 2; // SPI_FRF
const PADS_AFTER_RESET = [0x56, 0x52, 0x52, 0x52, 0x52, 0x5a]; // clock, data, select
const MARGIN_NS = 3, PADS_NS = [1.11 + 0.47, 2.5 + 1.5]; // see hal/chips/rp2/flash_margin.h

// Registers that may be written (datasheet 4.10.13): their bits, and whether they may be written while SSIENR is 1. Other
// bits that exist have effects that are not modelled.
const REGISTERS = {
  0x00: { name: 'CTRLR0', bits: 0x007f0300, whileOn: false, values: (v) => [STANDARD, QUAD].includes(v >>> 21 & 3) && [7, 31].includes(v >>> 16 & 31) && [0, READ_TMOD].includes(v >>> 8 & 3) },
  0x04: { name: 'CTRLR1', bits: 0, whileOn: false }, // one frame a read
  0x08: { name: 'SSIENR', bits: 1, whileOn: true },
  0x14: { name: 'BAUDR', bits: 0xfffe, whileOn: false, values: (v) => v >= 2 }, // an odd divider counts as the even one below
  0x60: { name: 'DR0', bits: 0xffffffff, whileOn: true },
  0xf0: { name: 'RX_SAMPLE_DLY', bits: 0xff, whileOn: false },
  0xf4: { name: 'SPI_CTRLR0', bits: 0xff00fb3f, whileOn: false, values: (v) => (v & 3) !== 3 && [0, 2].includes(v >>> 8 & 3) },
};

// How the SSI is set up to read: see chip.read.
function readOf(ssi, clkSys) {
  const quad = (ssi.crtlr0 >>> 21 & 3) === QUAD, control = ssi.spictlr0, bits = 4 * (control >>> 2 & 15);
  const addressLines = quad && (control & 3) > 0 ? 4 : 1, dataLines = quad ? 4 : 1, noCommand = (control >>> 8 & 3) === 0;
  return {
    command: noCommand ? null : control >>> 24, lines: `${addressLines}-${dataLines}`, bits,
    mode: bits === 32 ? control >>> 24 : null, dummy: control >>> 11 & 31, hz: clkSys / ssi.baudr,
    commandOnFour: !noCommand && quad && (control & 3) === 2,
    clocks: (noCommand ? 0 : 8) + bits / addressLines + (control >>> 11 & 31) + 32 / dataLines,
  };
}

// The serial unit: transfers of bytes, or of a command and an address, go to the chip. A transfer ends when its FIFO is
// empty, which a program sees in SR, or when it was too slow to fill it.
function addSsi(machine, ssi, chip, changed) {
  const read = ssi.readUint32.bind(ssi);
  const forward = ssi.writeUint32.bind(ssi);
  let sent = [], received = [], begun = 0;
  const core = machine.cores[0].core;
  const inBytes = () => (ssi.crtlr0 >>> 8 & 3) === 0;
  const end = () => {
    if (sent.length > 0 && inBytes()) {
      chip.end(sent);
    }
    sent = [];
  };
  const quadRead = (words) => { // the whole of a read by hand: its command, unless the flash expects none, and its address
    const how = readOf(ssi, machine.mcu.clkSys), command = how.command === null ? null : words[0];
    if (words.length < (command === null ? 1 : 2)) {
      return;
    }
    const wrong = how.bits !== 32 ? 'address and mode bits have 32 bits' : chip.read({ ...how, command, mode: words[words.length - 1] & 255 });
    if (wrong !== null && !chip.data.lies && !(command === null && words[0] >>> 0 === 0xffffffff)) { // all ones end a read, whatever the flash expects
      machine.warn(`a read of the flash by DR0: ${wrong}`);
    }
    received.push(0);
  };
  const push = (value) => {
    if (sent.length > 0 && core.cycles > begun + sent.length * 8 * ssi.baudr) {
      end(); // all was out: the flash was no longer selected
    }
    begun = sent.length === 0 ? core.cycles : begun;
    sent.push(value);
    if (ssi.ssienr !== 1 || ssi.baudr < 2) {
      machine.warn('DR0 is written while the SSI is off or has no clock');
    } else if (sent.length > FIFO_ENTRIES) {
      machine.warn(`more than ${FIFO_ENTRIES} words in the FIFO of the SSI`);
    } else if (inBytes()) {
      received.push(chip.answer(sent));
    } else {
      quadRead(sent);
    }
  };
  ssi.readUint32 = (offset) => {
    switch (offset) {
      case SR: end(); return SR_IDLE | (received.length > 0 ? RECEIVED : 0);
      case DR0:
        if (received.length === 0) {
          machine.warn('DR0 is read, but nothing was received');
        }
        return received.shift() ?? 0;
      default: return read(offset);
    }
  };
  ssi.writeUint32 = (offset, signed) => {
    const value = signed >>> 0, register = REGISTERS[offset];
    if (register === undefined) {
      machine.warn(`the SSI's register at ${offset.toString(16)}h is written, which is not modelled`);
      return;
    }
    if (!register.whileOn && ssi.ssienr === 1) {
      machine.warn(`${register.name} is written while SSIENR is 1: the SSI disregards it`);
      return;
    }
    if ((value & ~register.bits) !== 0 || (register.values && !register.values(value))) {
      machine.warn(`${register.name} is set to ${value.toString(16)}h: bits or a value that do not exist or are not modelled`);
    }
    if (offset === SSIENR && value === 0) {
      end();
      received = [];
    }
    if (offset === DR0) {
      push(value);
    } else {
      forward(offset, offset === 0x14 ? value & ~1 : value);
    }
    changed();
  };
}

// Whether the bits are sampled in time, in ns: see hal/chips/rp2/flash_margin.h, whose arithmetic it is.
function marginsOf(ssi, data, clkSys) {
  const cycle = 1e9 / clkSys, sampled = (ssi.baudr / 2 + ssi.rxsampldly) * cycle;
  return { setup: sampled - data.tclqv - PADS_NS[1], hold: ssi.baudr * cycle + data.tclqx + PADS_NS[0] - sampled };
}

// The pads for which hal/chips/rp2/flash_margin.h has delays (PADS_QSPI, datasheet 2.19.6.4): the clock's is fast and has 8 mA or
// more, those of the data have no Schmitt trigger.
function slowPads([clock, ...data]) {
  if ((clock.padValue & 0xa1) !== 0x21) {
    return `GPIO_QSPI_SCLK is ${clock.padValue.toString(16)}h: not fast, weaker than 8 mA or off`;
  }
  const slow = data.slice(0, 4).findIndex((pad) => (pad.padValue & 0xc2) !== 0x40);
  return slow < 0 ? null : `GPIO_QSPI_SD${slow} is ${data[slow].padValue.toString(16)}h: no input, or one with a Schmitt trigger`;
}

export function makeFlash(machine, data) {
  const { mcu } = machine, ssi = mcu.peripherals[SSI], chip = makeChip(data, machine.warn);
  const tags = new Int32Array(SETS * WAYS); // of each line: tag, and a bit for each word that is known; the newer way first
  let missCycles = 0, busyUntil = 0;

  // What is wrong with a read as the SSI is set up now, or null; and its cycles.
  const wrongWith = (how) => ssi.ssienr !== 1 || ssi.baudr < 2 || (ssi.crtlr0 >>> 8 & 3) !== READ_TMOD || (ssi.crtlr0 >>> 16 & 31) !== 31
    ? 'the SSI is not set up for it' : how.commandOnFour ? 'the command is on four lines'
      : how.command !== null && how.bits !== 24 ? 'the address has not 24 bits' : chip.read(how);
  const cyclesOf = (how) => how.clocks * ssi.baudr + ((ssi.crtlr0 >>> 21 & 3) === QUAD ? QUAD_MORE : 0);
  const costOf = () => {
    const how = readOf(ssi, mcu.clkSys), wrong = wrongWith(how) ?? slowPads(mcu.qspi), { setup, hold } = marginsOf(ssi, data, mcu.clkSys);
    if (wrong !== null) {
      machine.warn(`flash is read, and ${wrong}`);
    } else if (how.command === null && !chip.continuous) {
      machine.warn(`SPI_CTRLR0 has mode bits ${how.mode.toString(16)}h, after which the flash expects a command`);
    } else if (setup < MARGIN_NS || hold < MARGIN_NS) {
      machine.warn(`flash is read with BAUDR ${ssi.baudr} and RX_SAMPLE_DLY ${ssi.rxsampldly} at ${mcu.clkSys / 1e6} MHz: ` +
                   `setup ${setup.toFixed(2)} ns, hold ${hold.toFixed(2)} ns`);
    }
    return cyclesOf(how);
  };
  const changed = () => { missCycles = 0; };
  addSsi(machine, ssi, chip, changed);
  for (const place of [CLOCKS, PLL_SYS]) {
    const unit = mcu.peripherals[place], write = unit.writeUint32.bind(unit);
    unit.writeUint32 = (offset, value) => { write(offset, value); changed(); };
  }

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
      mcu.qspi.forEach((pad, i) => { pad.padValue = PADS_AFTER_RESET[i]; });
    },
    get way() { // how flash is read now, for people: command, divider, delay
      const how = readOf(ssi, mcu.clkSys);
      return `${(how.command ?? 0xeb).toString(16).toUpperCase()}h, divider ${ssi.baudr}, delay ${ssi.rxsampldly}`;
    },
    read(own, address) {
      if (machine.freeFlash || address >>> 2 === own.word) {
        return 0;
      }
      own.word = address >>> 2;
      return look(own, address);
    },
    probe(own, value) { // a flash that takes no read without a command, or other dummy clocks than it tells, is found out so
      const how = readOf(ssi, mcu.clkSys), wrong = wrongWith(how), { setup, hold } = marginsOf(ssi, data, mcu.clkSys);
      own.core.cycles += cyclesOf(how);
      if (wrong !== null && !(how.command === null && !data.continuous) && !data.lies) {
        machine.warn(`flash is read past the cache, and ${wrong}`);
      }
      return wrong !== null || setup < 0 || hold < 0 ? value >>> 4 : value;
    },
  };
}
