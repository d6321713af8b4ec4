/*
 * Usage: rp2040-registers <ACCESSES
 * Checks accesses to an RP2040's registers, which accesses.mjs writes, by registers/. Ends at the first that silicon
 * would not take, with a line that says why, and exit status 1.
 */
#include "registers/registers.h"

#include <stdio.h>
#include <stdlib.h>

enum { WRITES = 1, CORE_1 = 2, RESTARTS = 4, BYTES_SHIFT = 4 };

struct access {
    double time_ns;
    uint32_t address, value, pc, how; /* how: the bits above, and from BYTES_SHIFT on how many bytes */
};

int main(void)
{
    struct registers *registers = registers_new(&rp2040_registers, 2);
    struct access a;
    while (registers != NULL && fread(&a, sizeof a, 1, stdin) == 1) {
        const uint32_t core = (a.how & CORE_1) != 0, bytes = a.how >> BYTES_SHIFT;
        const uint64_t time_ns = (uint64_t)a.time_ns;
        const char *why = NULL;
        if ((a.how & RESTARTS) != 0) {
            registers_restart(registers);
        } else if ((a.how & WRITES) != 0) {
            why = registers_write(registers, core, time_ns, a.address, a.value, bytes);
        } else {
            why = registers_read(registers, core, time_ns, a.address, a.value, bytes);
        }
        if (why != NULL) {
            fprintf(stderr, "emulate: at %.3f ms: core %u at %08x: %s\n", a.time_ns / 1e6, (unsigned)core,
                    (unsigned)a.pc, why);
            return EXIT_FAILURE;
        }
    }
    registers_free(registers);
    return registers == NULL || ferror(stdin) ? EXIT_FAILURE : EXIT_SUCCESS;
}
