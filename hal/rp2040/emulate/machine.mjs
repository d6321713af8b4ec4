// An RP2040 with the parts that rp2040js lacks: a wire that takes time, a second core, a few words of the boot ROM.
//
//   const machine = makeMachine(rp2040js, { cores, warn });    warn(text): the emulator objects to something
//   machine.load(image);                                       Uint8Array from the first byte of flash
//   machine.run(() => stop);                                   until stop() is true or the image has ended
//
// The user sets hooks: onWord(value, bits, start, end, hz) at the last bit of an SPI word, onLevels(levels) when a pin that
// the chip drives changes, onUart(byte), onEnd(why). machine.calls is a Map from an address to a function, which gets
// r0 .. r3 and the word on the stack when core 0 comes there: the five arguments. With machine.freeWire words take no
// time, as in rp2040js; the cores' own time is left. A pin reads low until machine.chargeUs after its pull-up was turned
// on, as with a capacitor.

const BOOT2_BYTES = 256;
const BOOT2_PLACE = 0x20041f00;
const CPUID = 0x00, FIFO_ST = 0x50, FIFO_WR = 0x54, FIFO_RD = 0x58, SHARED_END = 0x50, SPINLOCK0 = 0x100;
const FIFO_READABLE = 1, FIFO_WRITABLE = 2;
const FIFO_WORDS = 8;
const PULLED_UP = 3; // GPIOPinState.InputPullUp

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
  return { push, pull, status };
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

// In rp2040js SPI takes no time. Here a word is out after the time of its bits at the unit's clock.
function addWireTime(machine, spi) {
  const { clock } = machine.mcu;
  let word = null;
  const alarm = clock.createAlarm(() => {
    const done = word;
    word = null;
    machine.wordInFlight = false;
    machine.onWord(done.value, done.bits, done.start, clock.nanos, done.hz);
    spi.completeTransmit(0);
  });
  spi.onTransmit = (value) => {
    const hz = spi.clockFrequency, bits = spi.dataBits;
    if (!spi.enabled || hz === 0) {
      machine.warn('a word was written to an SPI unit that is off or has no clock');
    }
    word = { value, bits, hz, start: clock.nanos };
    machine.wordInFlight = true;
    machine.onWordStart();
    alarm.schedule(machine.freeWire ? 0 : (bits * 1e9) / hz);
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
    return { core: mcu.core, started: true, asleep: false, time: 0, idle: 0, lowest: 2 ** 32 };
  }
  const own = Object.create(mcu); // the same memory and peripherals, but its own core, SIO and PPB
  own.core = new lib.CortexM0Core(own);
  own.sio = new lib.RPSIO(own);
  own.ppb = new lib.RPPPB(own, 'PPB1');
  return { core: own.core, sio: own.sio, started: false, asleep: false, time: 0, idle: 0, lowest: 2 ** 32 };
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

export function makeMachine(lib, { cores = 1, warn }) {
  const mcu = new lib.RP2040();
  const { clock } = mcu;
  const machine = {
    mcu, warn, calls: new Map(), freeWire: false, chargeUs: 0, levels: 0, wordInFlight: false, ended: null, cores: [],
    onWord() {}, onWordStart() {}, onLevels() {}, onUart() {},
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
  mcu.spi.forEach((spi) => addWireTime(machine, spi));
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
    mcu.sram.set(image.subarray(0, BOOT2_BYTES), BOOT2_PLACE - 0x20000000);
    mcu.core.SP = BOOT2_PLACE;
    mcu.core.LR = 0;
    mcu.core.PC = BOOT2_PLACE;
    watchPins(machine);
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

  const step = (own) => {
    const { core } = own;
    const before = core.cycles;
    execute(core);
    own.time += ((core.cycles - before) * 1e9) / mcu.clkSys; // unlike the return value, this counts the divider's cycles
    own.asleep = core.waiting;
    if (core.registers[13] < own.lowest) {
      own.lowest = core.registers[13];
    }
  };

  // What a core has slept, ns, until now.
  machine.idleOf = (own) => own.idle + (own.asleep ? Math.max(0, clock.nanos - own.time) : 0);

  const advance = (time) => {
    clock.tick(Math.max(0, time - clock.nanos));
    for (const own of machine.cores) {
      if (own.asleep && !own.core.waiting) {
        own.asleep = false;
        own.idle += Math.max(0, clock.nanos - own.time);
        own.time = Math.max(own.time, clock.nanos);
      }
    }
  };

  const behind = () => {
    let least = null;
    for (const own of machine.cores) {
      if (own.started && !own.asleep && (least === null || own.time < least.time)) {
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
          advance(clock.nextAlarm.nanos);
        } else {
          machine.end('every core sleeps for ever');
        }
      }
    }
  };
  return machine;
}
