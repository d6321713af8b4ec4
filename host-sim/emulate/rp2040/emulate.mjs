// Runs a firmware image on an emulated RP2040 and writes the events on its wires (host-sim/wire/wire_events.h: the format).
import { closeSync, openSync, readFileSync, writeSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';
import { makeAccesses } from './accesses.mjs';
import { CHIPS } from './flash_chips.mjs';
import { makeMachine } from './machine.mjs';

const HELP = `emulate.mjs --modules DIR IMAGE.bin|IMAGE.uf2 [options]
Runs an image of an RP2040 board in rp2040js, which npm has put into DIR, and writes the events on its wires.
  --frames N          ends after N frames (16)
  --events FILE       the events ('-': stdout, the default)
  --report FILE       a line a frame, as soon as it has ended: number, us, us on the bus, us in which all cores slept,
                      load of each core in %
  --flash NAME        the flash chip, of flash_chips.mjs (w25q16jv); at the end stderr has how it is read
  --cores 1|2         cores that the chip has (2)
  --dc PIN            the panel's D/C (required for a panel on SPI)
  --i2c ADDRESS,CLOCK,DATA  the panel is on I2C0: its address (hexadecimal) and its pins
  --i2c-fault NAME=N,..  answers: the panel acknowledges from N us on; gone: .. until N us; held: at power-on it holds the data
                      line for N clocks; stuck: from N us on the clock line stays low
  --select PIN        the panel's chip select
  --press FRAME:PINS  from this frame (-1: power-on) on the pins (12+13, or none) are low; may be given several times
  --clock US          what the chip's timer tells at power-on (0)
  --charge US         a pin reads low until US after its pull-up is turned on (0)
  --send FRAME:TEXT   to the image's UART when this frame begins
  --fault FRAME       a hard fault when this frame begins
  --calls FRAME,WRITE,ROWS,SCENE,AHEAD  addresses (hexadecimal) of the functions that the image calls when it begins to send
                      a frame, to write to the bus (bus_write and bus_write_rows of hal.h), and to make the scene of
                      a frame, here or on the other core: its number is the second argument. The events then have a
                      note 'frame' where the last bit of one is out. Without them a frame begins with the command memory write, 2Ch
  --jump FRAME:N      the scene of this frame is that of number N, and the next ones follow; may be given several times
  --delays SEED       each core waits now and then, for up to 30 us; frame N has the delays of SEED + N
  --accesses FILE     the accesses to registers, for rp2040-registers
  --chip NAME=N,..    what the chip says of itself: ring (Hz of its ring oscillator), id, reset, reason (see facts.mjs)
  --free-wire         words take no time on the bus: the report has the cores' own time
  --free-flash        flash is as fast as RAM (it lies behind a cache, see flash.mjs)
  --limit-ms N        ends with an error when so much emulated time has passed (60000)
The image's UART goes to stderr. Exit status 1: the emulator objected, or the frames did not come.`;

const XOSC = 0x40024, TIMER = 0x40054;

const { values: options, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    modules: { type: 'string' }, frames: { type: 'string', default: '16' }, events: { type: 'string', default: '-' },
    flash: { type: 'string', default: 'w25q16jv' },
    report: { type: 'string' }, cores: { type: 'string', default: '2' }, select: { type: 'string' }, dc: { type: 'string' },
    i2c: { type: 'string' }, 'i2c-fault': { type: 'string', default: '' },
    press: { type: 'string', multiple: true, default: [] }, send: { type: 'string', multiple: true, default: [] },
    jump: { type: 'string', multiple: true, default: [] },
    accesses: { type: 'string' }, delays: { type: 'string' }, clock: { type: 'string', default: '0' }, charge: { type: 'string', default: '0' }, fault: { type: 'string' }, chip: { type: 'string', default: '' }, calls: { type: 'string' },
    'free-wire': { type: 'boolean', default: false }, 'free-flash': { type: 'boolean', default: false }, 'limit-ms': { type: 'string', default: '60000' },
    help: { type: 'boolean', default: false },
  },
});
if (options.help) {
  console.log(HELP);
  process.exit(0);
}
if (positionals.length !== 1 || options.modules === undefined || (options.dc === undefined && options.i2c === undefined)) {
  console.error('emulate.mjs: --modules DIR, --dc PIN or --i2c, and one image are wanted; see --help');
  process.exit(2);
}

function fail(text) {
  console.error(`emulate: ${text}`);
  process.exit(1);
}

// A UF2 file has blocks of 512 bytes: magics, flags, address, size, number, count, family, data.
function unpackUf2(file) {
  const view = new DataView(file.buffer, file.byteOffset, file.length);
  const image = new Uint8Array(16 * 1024 * 1024).fill(0xff);
  let end = 0;
  for (let at = 0; at < file.length; at += 512) {
    const [magic, magic2, , address, size, , , family] = [...Array(8).keys()].map((i) => view.getUint32(at + 4 * i, true));
    if (magic !== 0x0a324655 || magic2 !== 0x9e5d5157 || family !== 0xe48bff56) {
      fail(`block ${at / 512} of the UF2 file is not for an RP2040`);
    }
    image.set(file.subarray(at + 32, at + 32 + size), address - 0x10000000);
    end = Math.max(end, address - 0x10000000 + size);
  }
  return image.slice(0, end);
}

// A Map from the frame to the text of options such as "3:12+13".
function byFrame(list) {
  return new Map(list.map((text) => [Number(text.split(':')[0]), text.slice(text.indexOf(':') + 1)]));
}

// Collects words into transfers and writes them with the levels of the pins at that time.
function makeRecorder(machine, fd) {
  let text = '', transfer = null, waiting = [], levelsAtStart = 0;
  const put = (line) => {
    text += `${line}\n`;
    if (text.length > 1 << 16) {
      flushText();
    }
  };
  const flushText = () => {
    for (let bytes = Buffer.from(text); bytes.length > 0;) {
      bytes = bytes.subarray(writeSync(fd, bytes));
    }
    text = '';
  };
  const ns = (time) => Math.round(time);
  const flush = () => {
    if (transfer !== null) {
      const t = transfer;
      put(`${ns(t.start)} spi - ${Math.round(t.hz)} ${Math.round(t.hz)} ${t.mode.toString(16)} 8 ${t.levels.toString(16)} ` +
          `${t.levelsAtEnd.toString(16)} ${ns(t.end)} ${Buffer.from(t.bytes).toString('hex')}`);
      transfer = null;
    }
  };
  const level = (time, levels) => put(`${ns(time)} level ${levels.toString(16)}`);
  return {
    put, level,
    name(bit, name) { put(`0 name ${bit} ${name}`); },
    levels(levels) { // a word during which a level changes is still one transfer, with both levels
      if (machine.wordInFlight) {
        waiting.push([machine.time, levels]);
        return;
      }
      flush();
      level(machine.time, levels);
    },
    wordStart() { levelsAtStart = machine.levels; },
    word(value, bits, start, end, hz, mode) {
      if (transfer !== null && (transfer.hz !== hz || transfer.end !== start || transfer.bytes.length >= 4096)) {
        flush();
      }
      transfer ??= { start, hz, mode, levels: levelsAtStart, bytes: [] };
      transfer.bytes.push(...(bits === 16 ? [value >> 8, value & 255] : [value & 255]));
      transfer.end = end;
      transfer.levelsAtEnd = machine.levels;
      if (waiting.length > 0) {
        flush();
        waiting.forEach(([, levels]) => level(end, levels));
        waiting = [];
      }
    },
    message(address, bytes, start, end, hz) { // levels that change in it come after it
      flush();
      put(`${ns(start)} i2c ${address.toString(16)} ${Math.round(hz)} ${ns(end)} ${Buffer.from(bytes).toString('hex')}`);
      waiting.forEach(([, levels]) => level(end, levels));
      waiting = [];
    },
    note(text) {
      flush();
      put(`${ns(machine.time)} note ${text}`);
    },
    close() { // the levels of an unfinished word count, too
      flush();
      waiting.forEach(([time, levels]) => level(time, levels));
      flushText();
    },
  };
}

const lib = {};
const base = join(options.modules, 'rp2040js/dist/esm');
for (const file of ['rp2040.js', 'cortex-m0-core.js', 'sio.js', 'peripherals/ppb.js']) {
  Object.assign(lib, await import(pathToFileURL(join(base, file))));
}

let objections = 0;
if (CHIPS[options.flash] === undefined) {
  fail(`no such flash: ${options.flash}; there are: ${Object.keys(CHIPS).join(' ')}`);
}
// Numbers by name: "ring=6000000,id=2".
function byName(text) {
  return Object.fromEntries(text.split(',').filter((part) => part !== '').map((part) => part.split('=')).map(([name, n]) => [name, Number(n)]));
}

function i2cOf(text, faults) {
  const [address, clock, data] = text.split(','), { answers = 0, gone = Infinity, held = 0, stuck = Infinity } = byName(faults);
  return { address: parseInt(address, 16), clock: Number(clock), data: Number(data), answersUs: answers, goneUs: gone, heldFor: held, stuckUs: stuck };
}

const machine = makeMachine(lib, {
  cores: Number(options.cores),
  chip: options.flash,
  facts: byName(options.chip),
  i2c: options.i2c === undefined ? null : i2cOf(options.i2c, options['i2c-fault']),
  warn(text) {
    objections++;
    if (objections <= 10) {
      console.error(`emulate: at ${(machine.time / 1e6).toFixed(3)} ms: ${text}`);
    }
  },
});
machine.freeWire = options['free-wire'];
machine.freeFlash = options['free-flash'];
machine.chargeUs = Number(options.charge);
const { clock } = machine.mcu, clockNs = Number(options.clock) * 1e3;
machine.mcu.peripherals[TIMER].clock = { get nanos() { return clock.nanos + clockNs; } };

// A core waits for a random time after a random number of instructions.
function addDelays(seed) {
  let chance = 0;
  const below = (n) => {
    chance = (Math.imul(chance, 1664525) + 1013904223) >>> 0;
    return (chance >>> 8) % n;
  };
  const left = new Map(machine.cores.map((own) => [own, 1]));
  machine.delay = (own) => {
    const n = left.get(own) - 1;
    left.set(own, n > 0 ? n : 1 + below([10, 100, 3000, 30000][below(4)]));
    return n > 0 ? 0 : below(30000);
  };
  return (frame) => { chance = Math.imul(seed + frame, 2654435761) >>> 0; };
}
const setDelays = options.delays === undefined ? () => {} : addDelays(Number(options.delays));
const accesses = options.accesses === undefined ? null : makeAccesses(machine, options.accesses);
const file = readFileSync(positionals[0]);
machine.load(new DataView(file.buffer, file.byteOffset).getUint32(0, true) === 0x0a324655 ? unpackUf2(file) : file);

const fd = options.events === '-' ? 1 : openSync(options.events, 'w');
const recorder = makeRecorder(machine, fd);
if (options.select !== undefined) {
  recorder.name(options.select, 'select');
}
let uart = '';
machine.onUart = (byte) => {
  uart += String.fromCharCode(byte);
  if (byte === 10) {
    process.stderr.write(uart);
    uart = '';
  }
};
machine.onTrouble = (text) => console.error(`emulate: at ${(machine.time / 1e6).toFixed(3)} ms: ${text}`);
machine.onLevels = recorder.levels;
machine.onWordStart = recorder.wordStart;

const press = byFrame(options.press), send = byFrame(options.send), jump = byFrame(options.jump);
const limit = Number(options['limit-ms']) * 1e6, frames = Number(options.frames);
const report = options.report === undefined ? null : openSync(options.report, 'w');
let frame = -1, begun = null, busTime = 0, told = Date.now();

function measure() {
  const current = { time: machine.time, bus: busTime, rest: machine.resting, idle: machine.cores.map(machine.idleOf) };
  if (begun !== null && report !== null) {
    const us = (current.time - begun.time) / 1e3;
    const loads = current.idle.map((idle, i) => machine.cores[i].started ? 100 - (idle - begun.idle[i]) / us / 10 : 0);
    const times = [us, (current.bus - begun.bus) / 1e3, (current.rest - begun.rest) / 1e3];
    writeSync(report, `${[frame, ...[...times, ...loads].map((v) => v.toFixed(1))].join(' ')}\n`);
  }
  begun = current;
}

function setPins() {
  if (press.has(frame)) {
    const low = press.get(frame).split('+').filter((pin) => pin !== '').map(Number);
    machine.mcu.gpio.forEach((pin, i) => pin.setInputValue(!low.includes(i)));
  }
}

function beginFrame() {
  measure();
  frame++;
  if (Date.now() - told >= 15000) {
    told = Date.now();
    console.error(`emulate: frame ${frame} of ${frames}`);
  }
  setPins();
  setDelays(frame);
  if (send.has(frame)) {
    Buffer.from(send.get(frame)).forEach((byte) => machine.mcu.uart[0].feedByte(byte));
  }
  if (Number(options.fault) === frame) {
    machine.mcu.core.exceptionEntry(3);
  }
}

// Bytes that the image gave to the bus, and bytes that were on the wire: a frame is out when both agree.
let given = 0, out = 0, done = 0;
const ends = []; // `given` at the end of frames that are not yet out

function endFrames() {
  for (; ends.length > 0 && out >= ends[0]; done++) {
    ends.shift();
    recorder.note('frame');
  }
}

// The number of a frame's scene: the last jump says how far it is ahead.
function sceneOf(number) {
  const from = Math.max(...[...jump.keys()].filter((key) => key <= number));
  return jump.has(from) ? number - from + Number(jump.get(from)) : number;
}

function addCalls([frameAt, writeAt, rowsAt, ...scenesAt]) {
  machine.calls.set(frameAt, () => {
    if (frame >= 0) {
      ends.push(given);
      endFrames();
    }
    beginFrame();
  });
  machine.calls.set(writeAt, ([, , , n]) => { given += n; });
  machine.calls.set(rowsAt, ([, , n, , rows]) => { given += n * rows; });
  scenesAt.forEach((at) => machine.calls.set(at, () => { // its first instruction has been run, and has left its arguments
    machine.mcu.core.registers[1] = sceneOf(machine.mcu.core.registers[1]);
  }));
}

if (options.calls !== undefined) {
  addCalls(options.calls.split(',').map((address) => parseInt(address, 16) & ~1));
}

machine.onWord = (value, bits, start, end, hz, mode) => {
  if (options.calls === undefined && value === 0x2c && bits === 8 && (machine.levels & (1 << Number(options.dc))) === 0) {
    done = Math.max(frame, 0);
    beginFrame();
  }
  busTime += end - start;
  out += bits / 8;
  recorder.word(value, bits, start, end, hz, mode);
  endFrames();
};

machine.onMessage = (address, bytes, start, end, hz) => {
  busTime += end - start;
  out += bytes.length - 1; // behind the control byte
  recorder.message(address, bytes, start, end, hz);
  endFrames();
};

setPins();
const isDone = options.calls === undefined ? () => frame >= frames : () => done >= frames;
machine.run(() => isDone() || machine.time > limit || objections > 0);
recorder.close();
const allTaken = accesses === null || accesses.close();
if (fd !== 1) {
  closeSync(fd);
}
machine.cores.filter((own) => own.started).forEach((own, i) => {
  console.error(`emulate: core ${i}: lowest stack ${own.lowest.toString(16)}`);
});
console.error(`emulate: flash is read by ${machine.flash.way}; the crystal had ${machine.mcu.peripherals[XOSC].startup} x 256 cycles to start`);
if (!machine.flashIntact()) {
  fail('the image wrote into flash as if it were RAM');
}
if (!allTaken) {
  process.exit(1); // rp2040-registers has said why
}
if (objections > 0) {
  fail(`${objections} objections of the emulator`);
}
if (machine.ended !== null) {
  console.error(`emulate: ended in frame ${frame}: ${machine.ended}`);
} else if (!isDone()) {
  fail(`only ${done} frames in ${options['limit-ms']} ms`);
}
