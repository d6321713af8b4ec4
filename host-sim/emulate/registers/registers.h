/*
 * registers: what a chip takes as accesses to its registers, and a model that refuses all else.
 *
 * A port has a table (host-sim/emulate/CHIP/registers_table.c): a row for each register that it writes or reads, with
 * the bits that exist, the values whose effect is known, when it may be written, and the document that says so. The
 * emulators tell a struct registers of every access; it keeps what was written and read, and says what silicon would
 * not take. Emulators themselves forgive much: a write while a unit is on, a unit that is in reset or has no clock, a
 * reserved bit, a wait that is missing.
 *
 * The tables are for emulators and tests; no image has them.
 */
#ifndef REGISTERS_H
#define REGISTERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Some bits of a register. A field may have several rows, one for each range of values. */
struct register_field {
    const char *name; /* the document's */
    uint8_t low, bits;
    uint32_t least, most; /* the values with a known effect; others are refused */
    const char *effect;   /* what these values do; "no pixel: .." and why, where no emulator follows them */
};

enum register_need {
    REGISTER_IS,       /* the register at `address` holds `value` in the bits `mask` */
    REGISTER_AT_LEAST, /* .. at least `value` (mask and value are in place) */
    REGISTER_SEEN,     /* the program has read `value` in the bits `mask` there, since the bits `since_mask` of the
                          register at `since` changed last (since 0: ever; since_mask 0: since it was written last, and
                          nothing is asked if it never was) */
    REGISTER_WAITED,   /* `value` ns have passed since the bits `mask` of the register at `address` changed last */
    REGISTER_WRITTEN,  /* the program has written the register at `address`, since .. as with REGISTER_SEEN */
};

/* What must hold before a write; before a read of a REGISTER_STATUS. */
struct register_when {
    uint32_t changes; /* asked only where the write changes one of these bits; 0: at every access */
    uint32_t sets;    /* .. and one of these bits is 1 after it; 0: whatever they are */
    uint8_t need;     /* enum register_need */
    uint32_t address, mask, value;
    uint32_t since, since_mask;
    const char *why; /* "while SSIENR is 1 the SSI ignores it": the end of the objection */
    uint32_t clears; /* .. and one of these bits is 0 after it; 0: whatever they are */
};

enum register_kind {
    REGISTER_KEEPS,   /* what is written stays; bits without a field must stay as `start` has them */
    REGISTER_COMMAND, /* a write acts and is not kept (data, write 1 to clear); bits without a field are 0 */
    REGISTER_STATUS,  /* is read only */
};

struct register_row {
    const char *name;
    uint32_t offset;        /* in its block */
    uint16_t count, stride; /* of registers alike; 0: one */
    uint8_t kind;           /* enum register_kind */
    bool narrow;            /* takes bytes and halfwords, too */
    uint32_t start;         /* what it holds when the program starts */
    const struct register_field *fields;
    uint8_t field_count;
    const struct register_when *when;
    uint8_t when_count;
    const char *source; /* section of the document */
};

struct register_block {
    const char *name;
    uint32_t base, bytes;
    bool aliases;  /* + 1000h toggles, + 2000h sets, + 3000h clears the bits that are written as 1 (RP2040, RP2350) */
    bool per_core; /* each core has its own */
    const struct register_row *rows;
    uint16_t row_count;
    const struct register_when *when; /* before any access; `changes`, `sets` and `clears` are 0 */
    uint8_t when_count;
};

struct register_chip {
    const char *name, *document;
    const struct register_block *blocks;
    uint16_t block_count;
    uint32_t resets; /* address of the register whose bits put blocks into reset: those that want a bit to be 0 before
                        any access (REGISTER_IS). They then forget all. 0: there is none */
};

#define REGISTER_LIST(list) (list), sizeof(list) / sizeof *(list)

/* The tables of the chips, each in CHIP/registers_table.c. */
extern const struct register_chip rp2040_registers, rp2350_registers, stm32f4_registers, lm3s6965_registers;

struct registers;

/* Makes the registers of a chip. NULL: not enough memory. The chip's table stays the caller's. */
struct registers *registers_new(const struct register_chip *chip, uint32_t cores);
void registers_free(struct registers *r);

/* All registers as when the program starts. */
void registers_restart(struct registers *r);

/*
 * A program's access: by core (0, 1), at a time, of 1, 2 or 4 bytes. NULL: the chip takes it. Else a line that names
 * the register, the value and the rule; it holds until the next call.
 */
const char *registers_write(struct registers *r, uint32_t core, uint64_t time_ns, uint32_t address, uint32_t value,
                            uint32_t bytes);
const char *registers_read(struct registers *r, uint32_t core, uint64_t time_ns, uint32_t address, uint32_t value,
                           uint32_t bytes);

/* What the program left in a register; 0 where there is none. */
uint32_t registers_value(struct registers *r, uint32_t core, uint32_t address);

#endif
