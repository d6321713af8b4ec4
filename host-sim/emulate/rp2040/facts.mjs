// What a chip says of itself and rp2040js does not know: the frequency counter (RP2040 datasheet 2.15.6.2), why it was
// reset (2.10.5, 4.7), its revision (2.20).
//
//   addFacts(machine, { ring, id, reset, reason });    Hz of the ring oscillator, CHIP_ID, CHIP_RESET and REASON at the
//                                                      first start; what is left out is as after power-on

const SYSINFO = 0x40000, CHIP_ID = 0;
const CLOCKS = 0x40008, FC0 = 0x80;
const REF_KHZ = 0x80, MIN_KHZ = 0x84, MAX_KHZ = 0x88, DELAY = 0x8c, INTERVAL = 0x90, SRC = 0x94, STATUS = 0x98, RESULT = 0x9c;
const BITS = { [REF_KHZ]: 0xfffff, [MIN_KHZ]: 0x1ffffff, [MAX_KHZ]: 0x1ffffff, [DELAY]: 7, [INTERVAL]: 15, [SRC]: 0xff };
const PASS = 1, DONE = 1 << 4, RUNNING = 1 << 8, SLOW = 1 << 20, FAST = 1 << 24, DIED = 1 << 28;
const CHIP_RESET_BLOCK = 0x40064, CHIP_RESET = 8, HAD_POR = 1 << 8;
const WATCHDOG = 0x40058;
const B2 = 0x20002927; // revision 2

// The clocks that the counter can be given, which the model has; pins as sources are not modelled.
function sources(mcu) {
  return {
    1: () => mcu.pllSys.frequency, 2: () => mcu.pllUsb.frequency, 3: () => mcu.roscFreq, 5: () => mcu.xoscFreq,
    8: () => mcu.clocks.refFreq, 9: () => mcu.clocks.sysFreq, 10: () => mcu.clocks.periFreq,
  };
}

// The frequency counter counts a clock's edges during so many cycles of clk_ref as make 2^INTERVAL us if REF_KHZ is right.
function count(mcu, registers, hz, machine) {
  const us = 2 ** registers[INTERVAL], seconds = (us * 1e-3 * registers[REF_KHZ]) / mcu.clocks.refFreq;
  const khz = (Math.floor(hz * seconds) / us) * 1e3;
  if (registers[REF_KHZ] === 0) {
    machine.warn('the frequency counter is not told the frequency of clk_ref');
  }
  const judged = khz < registers[MIN_KHZ] ? SLOW : khz > registers[MAX_KHZ] ? FAST : PASS;
  return { khz: Math.floor(khz * 32), status: DONE | judged, ns: seconds * 1e9 };
}

function addCounter(machine) {
  const { mcu } = machine, { clocks } = mcu, known = sources(mcu);
  const registers = { [REF_KHZ]: 0, [MIN_KHZ]: 0, [MAX_KHZ]: 0x1ffffff, [DELAY]: 1, [INTERVAL]: 8, [SRC]: 0 };
  const read = clocks.readUint32.bind(clocks), write = clocks.writeUint32.bind(clocks);
  let counted = { khz: 0, status: 0 }, until = 0;
  const start = () => {
    const source = registers[SRC], hz = source in known ? known[source]() : 0;
    if (source !== 0 && !(source in known)) {
      machine.warn(`the frequency counter's source ${source} is not modelled`);
    }
    counted = source === 0 ? { khz: 0, status: 0 } : hz === 0 ? { khz: 0, status: DIED, ns: 0 } : count(mcu, registers, hz, machine);
    until = mcu.clock.nanos + (counted.ns ?? 0);
  };
  clocks.readUint32 = (offset) => {
    const runs = mcu.clock.nanos < until;
    switch (offset) {
      case STATUS: return runs ? RUNNING : counted.status;
      case RESULT: return runs ? 0 : counted.khz;
      default: return offset in registers ? registers[offset] : read(offset);
    }
  };
  clocks.writeUint32 = (offset, value) => {
    if (offset < FC0 || offset > RESULT) {
      write(offset, value);
      return;
    }
    if (!(offset in registers) || (value & ~BITS[offset]) !== 0) {
      machine.warn(`a write of ${value.toString(16)} to ${offset.toString(16)} of the frequency counter`);
    } else if (mcu.clock.nanos < until) {
      machine.warn('the frequency counter is set up while it counts');
    }
    registers[offset] = value >>> 0;
    if (offset === SRC) {
      start();
    }
  };
}

function readOnly(machine, block, words) {
  const peripheral = machine.mcu.peripherals[block], read = peripheral.readUint32.bind(peripheral);
  peripheral.readUint32 = (offset) => words[offset] ?? read(offset);
}

export function addFacts(machine, { ring, id = B2, reset = HAD_POR, reason = 0 } = {}) {
  const { mcu } = machine;
  mcu.roscFreq = ring ?? mcu.roscFreq;
  mcu.peripherals[WATCHDOG].reason = reason;
  readOnly(machine, SYSINFO, { [CHIP_ID]: id });
  readOnly(machine, CHIP_RESET_BLOCK, { [CHIP_RESET]: reset });
  addCounter(machine);
}
