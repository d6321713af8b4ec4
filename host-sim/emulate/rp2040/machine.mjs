// An RP2040 with the parts that rp2040js lacks: a wire that takes time, flash behind a cache (flash.mjs), a second core, a
// few words of the boot ROM, an MPU, lockup, and a watchdog that resets.
//
//   const machine = makeMachine(rp2040js, { cores, warn, chip, facts, i2c });    warn(text): the emulator objects to something;
//                                              chip: a name of flash_chips.mjs; facts: see facts.mjs; i2c: see i2c.mjs, or null
//   machine.load(image);                                       Uint8Array from the first byte of flash
//   machine.run(() => stop);                                   until stop() is true or the image has ended
//
// The user sets hooks: onWord(value, bits, start, end, hz, mode) at the last bit of an SPI word, onLevels(levels) when a pin that
// the chip drives changes, onUart(byte), onTrouble(text): a core locked up or the watchdog reset the chip. machine.calls is a Map from an address to a function, which gets
// r0 .. r3 and the word on the stack when core 0 comes there: the five arguments. With machine.freeWire words take no
// time, as in rp2040js; the cores' own time is left. With machine.freeFlash flash is as fast as RAM. A pin reads low until machine.chargeUs after its pull-up was turned
// on, as with a capacitor. machine.resting is the time in ns that all cores slept at once. machine.delay(core) says how many
// ns a core waits after an instruction (0). onAccess(core, address, value, bytes, writes): a core has read or will write a
// register; onRestart(): they are as after a reset.

import { addFacts } from './facts.mjs';
import { makeFlash } from './flash.mjs';
import { CHIPS } from './flash_chips.mjs';
import { addI2c } from './i2c.mjs';

const BOOT2_BYTES = 256;
const BOOT2_PLACE = 0x20041f00;
const FLASH = 0x10, FLASH_PAST_CACHE = 0x13, SSI = 0x18; // highest byte of an address
const CPUID = 0x00, FIFO_ST = 0x50, FIFO_WR = 0x54, FIFO_RD = 0x58, SHARED_END = 0x50, SPINLOCK0 = 0x100;
const FIFO_READABLE = 1, FIFO_WRITABLE = 2;
const FIFO_WORDS = 8;
const MPU_CTRL = 0xd94, MPU_RNR = 0xd98, MPU_RBAR = 0xd9c, MPU_RASR = 0xda0;
const MPU_TYPE_ACCESS = 0x7 << 24, MPU_ON_WITH_BACKGROUND = 5;
const HARD_FAULT = 3;
const FORBIDDEN = Symbol('the MPU forbids this access');
const WATCHDOG = 0x40058, PSM = 0x40010, ALL_BUT_OSCILLATORS = 0x1fffc;
const PAD_AFTER_RESET = 0x56, FUNCTION_AFTER_RESET = 0x1f; // datasheet 2.19.6
const QSPI_PADS_AFTER_RESET = [0x56, 0x52, 0x52, 0x52, 0x52, 0x5a];
const PULLED_UP = 3; // GPIOPinState.InputPullUp

// Cortex-M0+ TRM: cycles of instructions (3.3) that rp2040js counts one too few, because LR and PC are registers of the
// list, too; cycles until an interrupt's first instruction (3.1). Of the way back only the nine loads are known.
const MORE_CYCLES = new Uint8Array(65536).fill(1, 0xb500, 0xb600).fill(1, 0xbd00, 0xbe00); // push lr, pop pc
const EXCEPTION_ENTRY_CYCLES = 15, EXCEPTION_EXIT_CYCLES = 10;

function crc32mpeg2(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte << 24;
    for (let bit = 0; bit < 8; bit++) {
      crc = crc < 0 ? (crc << 1) ^ 0x04c11db7 : crc << 1;
    }
  }
  return crc >>> 0;
}

// The FIFOs between the cores, and core 1 in its ROM: it echoes 0, 0, 1, vectors, stack, entry and then starts there.
function addFifos(machine) {
  const queues = [[], []]; // by the core that reads
  const started = [];
  const fromRom = (word) => {
    const expected = [0, 0, 1][started.length];
    if (expected !== undefined && word !== expected) {
      started.length = 0;
    } else {
      started.push(word);
    }
    queues[0].push(word);
    if (started.length === 6) {
      machine.startCore1(started[3], started[4], started[5]);
    }
  };
  const push = (core, word) => {
    if (core === 0 && machine.cores.length > 1 && !machine.cores[1].started) {
      fromRom(word);
    } else if (queues[1 - core].length < FIFO_WORDS) {
      queues[1 - core].push(word);
    } else {
      machine.warn(`core ${core} wrote into a full FIFO`);
    }
  };
  const pull = (core) => {
    if (queues[core].length === 0) {
      machine.warn(`core ${core} read an empty FIFO`);
      return 0;
    }
    return queues[core].shift();
  };
  const status = (core) =>
    (queues[core].length > 0 ? FIFO_READABLE : 0) | (queues[1 - core].length < FIFO_WORDS ? FIFO_WRITABLE : 0);
  const reset = () => { [...queues, started].forEach((list) => { list.length = 0; }); };
  return { push, pull, status, reset };
}

// Each core sees its own number, divider and FIFO end; pins and spin locks are shared.
function wrapSio(sio, shared, core, fifos) {
  const read = sio.readUint32.bind(sio), write = sio.writeUint32.bind(sio);
  const isShared = (offset) => sio !== shared && ((offset > CPUID && offset < SHARED_END) || offset >= SPINLOCK0);
  sio.readUint32 = (offset) => {
    switch (offset) {
      case CPUID: return core;
      case FIFO_ST: return fifos.status(core);
      case FIFO_RD: return fifos.pull(core);
      default: return isShared(offset) ? shared.readUint32(offset) : read(offset);
    }
  };
  sio.writeUint32 = (offset, value) => {
    if (offset === FIFO_WR) {
      fifos.push(core, value >>> 0);
    } else if (isShared(offset)) {
      shared.writeUint32(offset, value);
    } else {
      write(offset, value);
    }
  };
}

// Region 0 of a core's MPU, without access for anybody; NMI and hard fault run without the MPU. Returns a function that
// throws if the core must not access an address.
function addMpu(machine, own, ppb) {
  const { core } = own;
  const register = { [MPU_CTRL]: 0, [MPU_RNR]: 0, [MPU_RBAR]: 0, [MPU_RASR]: 0 };
  const read = ppb.readUint32.bind(ppb), write = ppb.writeUint32.bind(ppb), reset = ppb.reset.bind(ppb);
  let from = 0, end = 0;
  const update = () => {
    const rasr = register[MPU_RASR], bytes = 2 ** ((rasr >> 1 & 31) + 1), on = (register[MPU_CTRL] & rasr & 1) !== 0;
    from = on ? register[MPU_RBAR] : 0;
    end = on ? from + bytes : 0;
    if (on && (register[MPU_RNR] !== 0 || register[MPU_CTRL] !== MPU_ON_WITH_BACKGROUND || rasr & (MPU_TYPE_ACCESS | 0xff00) ||
        bytes < 256 || from % bytes !== 0)) {
      machine.warn('the MPU is used in a way that is not modelled');
    }
  };
  ppb.readUint32 = (offset) => register[offset] ?? read(offset);
  ppb.writeUint32 = (offset, value) => {
    if (offset in register) {
      register[offset] = value >>> 0;
      update();
    } else {
      write(offset, value);
    }
  };
  own.resetPpb = () => {
    Object.keys(register).forEach((offset) => { register[offset] = 0; });
    update();
    reset();
  };
  return (address) => {
    if (address < end && address >= from && (core.IPSR < 2 || core.IPSR > HARD_FAULT)) {
      throw FORBIDDEN;
    }
  };
}

// Registers lie from 0x40000000 on; those of the SSI lie below.
const isRegister = (address) => address >>> 28 >= 4 || address >>> 24 === SSI;

// What a core reads and writes passes its MPU; what it reads of flash takes time. Instructions are read as halfwords.
function addMemory(machine, own, check) {
  const { core } = own, chip = core.rp2040, { flash } = machine;
  for (const [access, bytes] of [['readUint32', 4], ['readUint8', 1]]) {
    const read = chip[access].bind(chip);
    core[access] = (signed) => {
      const address = signed >>> 0;
      check(address);
      if (address >>> 24 === FLASH) {
        core.cycles += flash.read(own, address);
      }
      const value = address >>> 24 === FLASH_PAST_CACHE ? flash.probe(own, read(address)) : read(address);
      if (isRegister(address)) {
        machine.onAccess(own, address, value, bytes, false);
      }
      return value;
    };
  }
  core.readUint16 = (signed) => {
    const address = signed >>> 0;
    check(address);
    if (address >>> 24 === FLASH) {
      core.cycles += flash.read(own, address);
    }
    const value = chip.readUint16(address);
    core.cycles += address === core.registers[15] ? MORE_CYCLES[value] : 0;
    return value;
  };
  for (const [access, bytes] of [['writeUint32', 4], ['writeUint16', 2], ['writeUint8', 1]]) {
    const write = chip[access].bind(chip);
    core[access] = (signed, value) => {
      const address = signed >>> 0;
      check(address);
      if (isRegister(address)) {
        machine.onAccess(own, address, value, bytes, true);
      }
      write(signed, value);
    };
  }
  const enter = core.exceptionEntry.bind(core), leave = core.exceptionReturn.bind(core);
  core.exceptionEntry = (number) => {
    core.cycles += EXCEPTION_ENTRY_CYCLES;
    enter(number);
  };
  core.exceptionReturn = (value) => {
    core.cycles += EXCEPTION_EXIT_CYCLES;
    leave(value);
  };
}

// What a reset by the watchdog leaves of the chip: memory, and the watchdog's own registers.
function resetChip(machine, fifos) {
  const { mcu, cores } = machine;
  fifos.reset();
  cores.forEach((own, i) => {
    Object.assign(own.core, { PM: false, IPSR: 0, SPSEL: 0, currentMode: 0, waiting: false, eventRegistered: false, VTOR: 0,
                              pendingInterrupts: 0, enabledInterrupts: 0, pendingSystick: false });
    Object.assign(own, { locked: false, asleep: false, started: i === 0, time: mcu.clock.nanos });
    own.resetPpb();
  });
  mcu.dma.channels.forEach((channel) => channel.reset());
  mcu.sio.gpioOutputEnable = mcu.sio.gpioValue = 0;
  mcu.gpio.forEach((pin) => {
    Object.assign(pin, { padValue: PAD_AFTER_RESET, ctrl: FUNCTION_AFTER_RESET });
    pin.checkForUpdates();
  });
}

function addWatchdog(machine, fifos) {
  const watchdog = machine.mcu.peripherals[WATCHDOG];
  watchdog.onWatchdogTrigger = () => {
    watchdog.writeUint32(0, 0); // CTRL: off, or it fires for ever
    machine.onTrouble('the watchdog resets the chip');
    if (machine.mcu.peripherals[PSM].wdsel !== ALL_BUT_OSCILLATORS) {
      machine.warn('the watchdog does not reset all of the chip');
    }
    resetChip(machine, fifos);
    machine.onRestart();
    machine.boot();
  };
}

// In rp2040js SPI takes no time. Here a word is out after the time of its bits at the unit's clock, and, unless SPH is set,
// of the unit's pause (hal/chips/spi_clock.h).
function addWireTime(machine, spi) {
  const { clock } = machine.mcu;
  let word = null;
  const alarm = clock.createAlarm(() => {
    const done = word;
    word = null;
    machine.wordInFlight = false;
    machine.onWord(done.value, done.bits, done.start, clock.nanos, done.hz, done.mode);
    spi.completeTransmit(0);
  });
  spi.onTransmit = (value) => {
    const hz = spi.clockFrequency, bits = spi.dataBits, sph = spi.control0 >>> 7 & 1, spo = spi.control0 >>> 6 & 1;
    if (!spi.enabled || hz === 0) {
      machine.warn('a word was written to an SPI unit that is off or has no clock');
    }
    word = { value, bits, hz, mode: 2 * spo + sph, start: clock.nanos };
    machine.wordInFlight = true;
    machine.onWordStart();
    alarm.schedule(machine.freeWire ? 0 : ((bits + (sph === 0 ? 1.5 : 0)) * 1e9) / hz);
  };
}

// The ROM's function table as an image finds it: a lookup function that returns reset_usb_boot().
function addRom(machine) {
  const { mcu } = machine;
  const rom = new DataView(mcu.bootrom.buffer);
  rom.setUint16(0x14, 0x30, true); // table
  rom.setUint16(0x18, 0x41, true); // lookup(table, code)
  [0xbe41, 0x4801, 0x4770].forEach((opcode, i) => rom.setUint16(0x40 + 2 * i, opcode, true)); // bkpt; ldr r0; bx lr
  rom.setUint32(0x48, 0x51, true);
  [0xbe42, 0xe7fe].forEach((opcode, i) => rom.setUint16(0x50 + 2 * i, opcode, true)); // bkpt; b .
  mcu.onBreak = (number) => {
    const [r0, r1] = mcu.core.registers;
    if (number === 0x41 && r1 !== 0x4255) {
      machine.warn(`the ROM was asked for a function ${r1.toString(16)}`);
    } else if (number === 0x42) {
      machine.end('boot loader');
    } else if (number === 0xab && r0 === 0x18) {
      machine.end(r1 === 0x20026 ? 'exit' : 'exit with an error');
    } else if (number !== 0x41) {
      machine.warn(`breakpoint ${number}`);
    }
  };
}

function watchPins(machine) {
  machine.mcu.gpio.forEach((pin, index) => {
    pin.setInputValue(machine.chargeUs === 0);
    const charged = machine.mcu.clock.createAlarm(() => pin.setInputValue(true));
    pin.addListener((state) => {
      if (state === PULLED_UP && machine.chargeUs > 0) {
        charged.schedule(machine.chargeUs * 1e3);
      }
      const bit = 2 ** index;
      const high = state === 1;
      if (state > 1 || high === ((machine.levels & bit) !== 0)) {
        return;
      }
      machine.levels = (high ? machine.levels | bit : machine.levels & ~bit) >>> 0;
      machine.onLevels(machine.levels);
    });
  });
}

function addCore(machine, lib, index) {
  const { mcu } = machine;
  if (index === 0) {
    return { core: mcu.core, ppb: mcu.ppb, started: true, asleep: false, locked: false, time: 0, counted: 0, word: 0, idle: 0, lowest: 2 ** 32 };
  }
  const own = Object.create(mcu); // the same memory and peripherals, but its own core, SIO and PPB
  own.core = new lib.CortexM0Core(own);
  own.sio = new lib.RPSIO(own);
  own.ppb = new lib.RPPPB(own, 'PPB1');
  return { core: own.core, sio: own.sio, ppb: own.ppb, started: false, asleep: false, locked: false, time: 0, counted: 0, word: 0, idle: 0, lowest: 2 ** 32 };
}

function addLogger(machine) {
  const loud = (component, text) => machine.warn(`${component}: ${text}`);
  const sev = () => {
    for (const { core } of machine.cores) {
      core.eventRegistered = !core.waiting;
      core.waiting = false;
    }
  };
  machine.mcu.logger = {
    debug() {},
    info(component, text) { if (text === 'SEV') { sev(); } },
    warn: loud,
    error: loud,
  };
  console.warn = (...text) => machine.warn(text.join(' '));
}

export function makeMachine(lib, { cores = 1, warn, chip = 'w25q16jv', facts = {}, i2c = null }) {
  const mcu = new lib.RP2040();
  const { clock } = mcu;
  const machine = {
    mcu, warn, calls: new Map(), freeWire: false, freeFlash: false, resting: 0, misses: 0, chargeUs: 0, levels: 0, wordInFlight: false, ended: null, cores: [],
    onWord() {}, onWordStart() {}, onMessage() {}, holdData() {}, onLevels() {}, onUart() {}, onTrouble() {}, onAccess() {}, onRestart() {}, delay: () => 0,
    end(why) { machine.ended = why; },
    get time() { return clock.nanos; },
  };
  for (let i = 0; i < cores; i++) {
    machine.cores.push(addCore(machine, lib, i));
  }
  addLogger(machine);
  const fifos = addFifos(machine);
  wrapSio(mcu.sio, mcu.sio, 0, fifos);
  if (cores > 1) {
    wrapSio(machine.cores[1].sio, mcu.sio, 1, fifos);
  }
  machine.flash = makeFlash(machine, CHIPS[chip]);
  machine.cores.forEach((own) => addMemory(machine, own, addMpu(machine, own, own.ppb)));
  addWatchdog(machine, fifos);
  addFacts(machine, facts);
  mcu.spi.forEach((spi) => addWireTime(machine, spi));
  if (i2c !== null) {
    addI2c(machine, i2c);
  }
  mcu.uart[0].onByte = (byte) => machine.onUart(byte);
  addRom(machine);

  machine.startCore1 = (vectors, stack, entry) => {
    const second = machine.cores[1];
    second.core.VTOR = vectors;
    second.core.SP = stack;
    second.core.PC = entry & ~1;
    second.started = true;
    second.time = clock.nanos;
  };

  machine.load = (image) => {
    mcu.reset(); // erases flash
    mcu.flash.set(image);
    machine.image = image;
    const stored = new DataView(image.buffer, image.byteOffset).getUint32(BOOT2_BYTES - 4, true);
    if (crc32mpeg2(image.subarray(0, BOOT2_BYTES - 4)) !== stored) {
      throw new Error('the checksum of boot2 is wrong: the boot ROM would not start this image');
    }
    machine.boot();
    watchPins(machine);
    machine.holdData();
  };

  machine.boot = () => {
    machine.flash.reset();
    machine.cores.forEach((own) => { own.word = 0; });
    mcu.qspi.forEach((pin, i) => { pin.padValue = QSPI_PADS_AFTER_RESET[i]; });
    mcu.sram.set(machine.image.subarray(0, BOOT2_BYTES), BOOT2_PLACE - 0x20000000);
    mcu.core.SP = BOOT2_PLACE;
    mcu.core.LR = 0;
    mcu.core.PC = BOOT2_PLACE;
  };

  // Stores to flash succeed silently here: they must not have happened.
  machine.flashIntact = () => Buffer.compare(mcu.flash.subarray(0, machine.image.length), machine.image) === 0;

  // An interrupt may come first: then it is the handler's first instruction, and the function is entered later.
  const execute = (core) => {
    const call = core === machine.cores[0].core ? machine.calls.get(core.registers[15]) : undefined;
    if (call === undefined) {
      core.executeInstruction();
      return;
    }
    const handler = core.IPSR, words = [...core.registers.slice(0, 4), mcu.readUint32(core.SP)];
    core.executeInstruction();
    if (core.IPSR === handler) {
      call(words);
    }
  };

  // A fault whose frame meets the guard, too, locks the core up. (After a fault in the frame of an interrupt a chip may
  // still come to its handler.)
  const fault = (own) => {
    own.core.PC -= 2;
    try {
      own.core.exceptionEntry(HARD_FAULT);
    } catch (error) {
      own.locked = true;
      machine.onTrouble(`core ${machine.cores.indexOf(own)} locks up`);
    }
  };

  const step = (own) => {
    const { core } = own;
    try {
      execute(core);
    } catch (error) {
      if (error !== FORBIDDEN) {
        throw error;
      }
      fault(own);
    }
    own.time += ((core.cycles - own.counted) * 1e9) / mcu.clkSys; // unlike the return value, all that the core waited for
    own.counted = core.cycles;
    own.time += machine.delay(own);
    own.asleep = core.waiting;
    if (core.registers[13] < own.lowest) {
      own.lowest = core.registers[13];
    }
  };

  // What a core has slept, ns, until now.
  machine.idleOf = (own) => own.idle + (own.asleep ? Math.max(0, clock.nanos - own.time) : 0);

  const sleepUntilNow = (own) => {
    own.idle += Math.max(0, clock.nanos - own.time);
    own.time = Math.max(own.time, clock.nanos);
  };

  const advance = (time) => {
    clock.tick(Math.max(0, time - clock.nanos));
    for (const own of machine.cores) {
      if (own.asleep && own.core.waiting && own.core.pendingSystick) { // its handler's vector is read now, not when the core fell asleep
        sleepUntilNow(own);
        own.core.waiting = !own.core.checkForInterrupts();
      }
      if (own.asleep && !own.core.waiting) {
        sleepUntilNow(own);
        own.asleep = false;
      }
    }
  };

  const behind = () => {
    let least = null;
    for (const own of machine.cores) {
      if (own.started && !own.asleep && !own.locked && (least === null || own.time < least.time)) {
        least = own;
      }
    }
    return least;
  };

  // The core that is behind goes on, the clock follows it; when all sleep, the next alarm wakes one.
  machine.run = (stop) => {
    while (machine.ended === null && !stop()) {
      for (let i = 0; i < 256 && machine.ended === null; i++) {
        const own = behind();
        if (own !== null) {
          step(own);
          const next = behind();
          advance(next === null ? own.time : next.time);
        } else if (clock.nextAlarm !== null) {
          const before = clock.nanos;
          advance(clock.nextAlarm.nanos);
          machine.resting += clock.nanos - before;
        } else {
          machine.end('every core sleeps for ever');
        }
      }
    }
  };
  return machine;
}
