// I2C0 of an RP2040 (datasheet 4.3, DW_apb_i2c) as a master that writes, and the display at its other end. It takes the
// place of rp2040js' model, which gives messages no time, takes its set-up while it is on, tells of an empty FIFO only after
// a word has left it, and knows no pads. What is not modelled here is objected to.
//
//   addI2c(machine, { address, clock, data, answersUs, goneUs, heldFor, stuckUs });
//
// address: the display's, of 7 bits; clock, data: numbers of its pins. From answersUs on it acknowledges, from goneUs on no
// more. At power-on it holds the data line low for heldFor falling edges of the clock; the unit then waits before a start.
// From stuckUs on something holds the clock low.
// machine.onMessage(address, bytes, start, end, hz): a message's stop is out; bytes are what follows its address.

const I2C0 = 0x40044, RESETS = 0x4000c, RESET_I2C0 = 1 << 3, IRQ = 23;
const CON = 0x00, TAR = 0x04, DATA_CMD = 0x10, HCNT = 0x1c, LCNT = 0x20, INTR_STAT = 0x2c, INTR_MASK = 0x30, TX_TL = 0x3c,
  CLR_TX_ABRT = 0x54, ENABLE = 0x6c, STATUS = 0x70, SDA_HOLD = 0x7c, SPKLEN = 0xa0;
const AFTER_RESET = { [CON]: 0x65, [TAR]: 0x55, [HCNT]: 6, [LCNT]: 13, [INTR_MASK]: 0x8ff, [TX_TL]: 0, [ENABLE]: 0, [SDA_HOLD]: 1, [SPKLEN]: 7 };
const WHILE_OFF = [CON, TAR, HCNT, LCNT, SDA_HOLD, SPKLEN];
const MASTER_WRITES = 0x65; // master, fast, restart, no slave
const STOP = 1 << 9, TX_ABRT = 1 << 6, TX_EMPTY = 1 << 4;
const TFNF = 2, TFE = 4, MASTER_ACTIVE = 1 << 5 | 1;
const FIFO_WORDS = 16;
const FUNCTION_I2C = 3, PULL_UP = 8, INPUT = 64, OUTPUT_OFF = 128;
const DRIVEN_LOW = 0; // GPIOPinState.Low

// What fast mode wants of the clock and data, ns (UM10204, table 10); fast-mode plus above 400 kHz.
const FAST = { low: 1300, high: 600, setUp: 100 }, FAST_PLUS = { low: 500, high: 260, setUp: 50 };

export function addI2c(machine, { address, clock, data, answersUs, goneUs, heldFor, stuckUs }) {
  const { mcu } = machine, unit = mcu.peripherals[I2C0], resets = mcu.peripherals[RESETS];
  const timer = mcu.clock.createAlarm(() => then());
  let registers, fifo, message, aborted, then, held = heldFor;

  const reset = () => {
    registers = { ...AFTER_RESET };
    fifo = [];
    message = null; // or its bytes so far, from start to stop
    aborted = false; // until CLR_TX_ABRT is read the FIFO takes nothing
    then = () => {};
    mcu.setInterrupt(IRQ, false);
  };
  const pending = () => (aborted ? TX_ABRT : 0) | (registers[ENABLE] === 1 && fifo.length <= registers[TX_TL] ? TX_EMPTY : 0);
  const tell = () => mcu.setInterrupt(IRQ, (pending() & registers[INTR_MASK]) !== 0);

  // The clock of the wire: cycles of clk_sys while it is low and high (4.3.14).
  const wire = () => {
    const ns = 1e9 / mcu.clkSys, low = (registers[LCNT] + 1) * ns, high = (registers[HCNT] + registers[SPKLEN] + 7) * ns;
    return { low, high, period: low + high, hz: 1e9 / (low + high) };
  };
  const checkWire = () => {
    const { low, high, hz } = wire(), hold = (registers[SDA_HOLD] & 0xffff) * 1e9 / mcu.clkSys, wants = hz > 400000 ? FAST_PLUS : FAST;
    if (low < wants.low || high < wants.high || hold < 300 || low - hold < wants.setUp || registers[SPKLEN] * 1e9 / mcu.clkSys < 50) {
      machine.warn(`I2C: at ${Math.round(hz)} Hz the clock is low for ${low} ns, high for ${high} ns, and data is held for ${hold} ns: not what UM10204 wants`);
    }
    for (const [name, pin] of [['clock', clock], ['data', data]]) {
      const { padValue, functionSelect } = mcu.gpio[pin];
      if (functionSelect !== FUNCTION_I2C || (padValue & (PULL_UP | INPUT | OUTPUT_OFF)) !== (PULL_UP | INPUT)) {
        machine.warn(`I2C: the pin of the ${name} has function ${functionSelect} and pad ${padValue.toString(16)}: no function of I2C, no pull-up or no input`);
      }
    }
    if (registers[CON] !== MASTER_WRITES) {
      machine.warn(`I2C: CON ${registers[CON].toString(16)} is not modelled`);
    }
  };

  const after = (periods, what) => {
    then = what;
    if (mcu.clock.nanos < stuckUs * 1e3) { // else the clock stays low
      timer.schedule(machine.freeWire ? 0 : periods * wire().period);
    }
  };
  const end = () => {
    const { start, bytes } = message;
    message = null;
    machine.wordInFlight = false;
    if (bytes.length > 0) {
      machine.onMessage(registers[TAR], bytes, start, mcu.clock.nanos, wire().hz);
    }
    begin();
  };
  const answers = () => {
    const us = mcu.clock.nanos / 1e3;
    return registers[TAR] === address && us >= answersUs && us < goneUs;
  };
  const abort = () => {
    aborted = true;
    fifo = [];
    after(1, end);
    tell();
  };
  const goOn = () => { // between two bytes; without a word the clock stays low
    message.waits = fifo.length === 0;
    if (message.waits) {
      return;
    }
    const word = fifo.shift();
    tell();
    after(9, () => {
      if (!answers()) {
        abort();
        return;
      }
      message.bytes.push(word & 255);
      if ((word & STOP) !== 0) {
        after(1, end);
      } else {
        goOn();
      }
    });
  };
  const begin = () => {
    if (message !== null || fifo.length === 0) {
      return;
    }
    message = { start: mcu.clock.nanos, bytes: [], waits: false };
    machine.wordInFlight = true;
    checkWire();
    if (held === 0) {
      after(10, () => (answers() ? goOn() : abort()));
    }
  };
  const push = (word) => {
    if (registers[ENABLE] !== 1 || fifo.length === FIFO_WORDS || (word & ~(STOP | 255)) !== 0) {
      machine.warn(`I2C: the word ${word.toString(16)} is written while the unit is off or its FIFO is full (TX_OVER), or reads`);
    } else if (!aborted) {
      fifo.push(word);
      tell();
      if (message === null) {
        begin();
      } else if (message.waits) {
        goOn();
      }
    }
  };

  unit.readUint32 = (offset) => {
    switch (offset) {
      case INTR_STAT: return pending() & registers[INTR_MASK];
      case STATUS: return (fifo.length < FIFO_WORDS ? TFNF : 0) | (fifo.length === 0 ? TFE : 0) | (message !== null ? MASTER_ACTIVE : 0);
      case CLR_TX_ABRT:
        aborted = false;
        tell();
        return 0;
      default:
        if (!(offset in registers)) {
          machine.warn(`I2C: register ${offset.toString(16)} is not modelled`);
        }
        return registers[offset] ?? 0;
    }
  };
  unit.writeUint32 = (offset, value) => {
    if (offset === DATA_CMD) {
      push(value);
      return;
    }
    if (!(offset in registers) || (WHILE_OFF.includes(offset) && registers[ENABLE] === 1)) {
      machine.warn(`I2C: a write to ${offset.toString(16)} that is not modelled, or is ignored because the unit is on`);
      return;
    }
    registers[offset] = value >>> 0;
    if (offset === ENABLE && value === 0) {
      fifo = [];
      if (message !== null) {
        machine.warn('I2C: the unit is turned off in the middle of a message');
      }
    }
    tell();
  };

  const writeResets = resets.writeUint32.bind(resets);
  resets.writeUint32 = (offset, value) => {
    writeResets(offset, value);
    if (offset === 0 && (value & RESET_I2C0) !== 0) {
      timer.cancel();
      machine.wordInFlight = false;
      reset();
    }
  };
  machine.holdData = () => { // once pins are watched
    mcu.gpio[data].setInputValue(held === 0);
    mcu.gpio[clock].addListener((state) => {
      if (state === DRIVEN_LOW && held > 0 && --held === 0) {
        mcu.gpio[data].setInputValue(true);
      }
    });
  };
  reset();
}
