// Writes the accesses to registers for rp2040_registers.c, which has the format: 24 bytes each.
//
//   const accesses = makeAccesses(machine, path);    path: a FIFO or a file
//   accesses.close();                                false: nobody reads them any more, an access has been refused
//
// A core that polls a register reads the same value again and again; until a register is written that says nothing new.

import { closeSync, openSync, writeSync } from 'node:fs';

const RECORD_BYTES = 24, RECORDS = 4096;
const WRITES = 1, CORE_1 = 2, RESTARTS = 4, BYTES_SHIFT = 4;

export function makeAccesses(machine, path) {
  const fd = openSync(path, 'w'), bytes = new Uint8Array(RECORD_BYTES * RECORDS);
  const times = new Float64Array(bytes.buffer), words = new Uint32Array(bytes.buffer);
  const polled = [0, 0], seen = [0, 0]; // by core: the address that it read last, 0: none; the value there
  let count = 0, read = true;

  const flush = () => {
    try {
      for (let from = 0; from < count * RECORD_BYTES;) {
        from += writeSync(fd, bytes, from, count * RECORD_BYTES - from);
      }
    } catch (error) {
      read = false;
      machine.end('an access to a register was refused');
    }
    count = 0;
  };
  const put = (time, address, value, pc, how) => {
    const at = count * 6;
    times[count * 3] = time;
    words[at + 2] = address;
    words[at + 3] = value;
    words[at + 4] = pc;
    words[at + 5] = how;
    if (++count === RECORDS && read) {
      flush();
    }
  };
  machine.onAccess = (own, address, value, size, writes) => {
    const core = own === machine.cores[0] ? 0 : 1;
    if (writes) {
      polled[0] = polled[1] = 0;
    } else if (polled[core] === address && seen[core] === value) {
      return;
    } else {
      polled[core] = address;
      seen[core] = value;
    }
    put(own.time, address, value, own.core.registers[15] - 2, (writes ? WRITES : 0) | core * CORE_1 | size << BYTES_SHIFT);
  };
  machine.onRestart = () => put(machine.time, 0, 0, 0, RESTARTS);
  return {
    close() {
      flush();
      closeSync(fd);
      return read;
    },
  };
}
