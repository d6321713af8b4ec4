/*
 * chip: an emulated RP2350 with two Cortex-M33 or two Hazard3 cores. What a sane image never does, the model complains
 * about.
 *
 *   chip.c      time, the cores in turns, resets      memory.c    what lies where
 *   core.c      how a core runs, sleeps and wakes
 *   arm.c       Cortex-M33: exceptions                 thumb16.c, thumb32.c, thumb_data.c, thumb_dsp.c   instructions
 *   riscv.c     Hazard3: traps                         riscv_data.c, riscv_expand.c   instructions
 *   rom.c       what the boot ROM does                 clocks.c    oscillator, PLLs, resets, ticks, watchdog, timer
 *   rom_blocks.c, rom_items.c   which image it starts  rom_uf2.c   which UF2 file its boot loader takes
 *   sio.c       FIFOs between the cores, spin locks   pins.c      pins and pads
 *   spi.c       PL022, whose words take time          dma.c       channels
 *   facts.c     id, reasons of resets, frequency counter
 *   xip.c       the cache before the flash            qmi.c       what reads the flash       flash.c   the flash
 *   record.c    the events on the wires               rp2350_emulate.c   options, frames, report
 *
 * Section numbers in the sources are those of the RP2350 datasheet (Raspberry Pi Ltd). Time is in femtoseconds: a
 * uint64_t holds five hours.
 */
#ifndef CHIP_H
#define CHIP_H

#include <stdbool.h>
#include <stdint.h>

#include "registers/registers.h"

#define ROM_BYTES   0x8000
#define RAM_BASE    0x20000000
#define RAM_BYTES   0x82000
#define FLASH_BASE  0x10000000
#define FLASH_BYTES 0x1000000
#define NEVER       UINT64_MAX
#define FS_PER_US   1000000000ULL
#define FS_PER_NS   1000000ULL
#define CORES       2
#define PINS        30
#define CHANNELS    16
#define FIFO_WORDS  4

enum { IRQ_TIMER0_0 = 0, IRQ_DMA_0 = 10, IRQ_DMA_1 = 11 };

struct chip;

struct core {
    struct chip *chip;
    uint32_t index;
    uint32_t r[32];                /* Arm: 13 stack pointer, 14 link register; RISC-V: x0 .. x31 */
    uint32_t pc, next;             /* addresses of the instruction that runs and of the next one */
    uint64_t irq_enabled, tick_at; /* the next interrupt by SysTick or the timer of SIO; NEVER: off */
    bool event, asleep, sleeps_for_interrupt, started, locked;

    bool n, z, c, v, q, in_it, faulted, loads, after_load; /* Arm */
    uint32_t ge, it;
    uint32_t primask, msplim, vtor, ipsr;
    struct {
        uint32_t control, reload;
        bool pending;
    } systick;

    struct csr { /* RISC-V */
        uint32_t mstatus, mie, mtvec, mcountinhibit, mscratch, mepc, mcause, mtval, pmpcfg0, pmpaddr0, pmpcfgm0;
    } csr;
    uint32_t forbidden, forbidden_bytes; /* by the PMP */
    uint32_t late;                       /* the register that the last load filled; 0: none */
    uint64_t compare;                    /* of the timer of SIO */

    uint32_t fifo[FIFO_WORDS], fifo_count; /* what this core reads */
    uint64_t time, idle;                   /* of the next instruction; slept so far */
    uint64_t cycles;
    uint32_t lowest; /* stack pointer */
};

struct spi {
    uint32_t cr0, cr1, cpsr, dmacr;
    uint16_t fifo[8];
    uint32_t first, count;
    bool busy; /* a word is on its way */
    uint32_t word;
    uint64_t start, end;
    double hz;
};

struct channel {
    uint32_t read, write, count, reload, control;
    bool busy;
};

/* The flash beside the chip, see flash.c. */
struct flash_chip {
    uint8_t id[3], status[2];
    bool locked, has_sfdp;           /* the status registers cannot be written; 5Ah finds parameters */
    uint64_t earliest_fs, latest_fs; /* from a falling edge of SCK to changed bits at the chip's registers */
    bool continuous;                 /* it expects an address in the place of a command */
    bool volatile_write;             /* command 50h came last */
    bool selected;                   /* in direct mode */
    uint64_t released;               /* when it was not selected any more */
    uint8_t bytes[8];                /* the first ones of a command */
    uint32_t count;
};

#define QMI_FIFO_WORDS 4

struct qmi {
    uint32_t csr, timing, rfmt, rcmd; /* of window 0; window 1 has no device */
    uint32_t pads[7];
    uint64_t clocks_end; /* direct mode: when the last byte is out */
    uint8_t rx[QMI_FIFO_WORDS];
    uint64_t rx_ready[QMI_FIFO_WORDS];
    uint32_t rx_count;
    uint64_t from, until;    /* the last transfer from memory */
    uint64_t selected_until; /* until then the next one may be appended */
    uint32_t next;           /* if it begins at this address */
};

#define XIP_SETS 1024

struct xip {
    uint32_t line[XIP_SETS][2]; /* address / 8, + 1; 0: none */
    uint32_t random;
    uint32_t accesses, hits; /* since the counters were cleared */
};

struct pll {
    uint32_t cs, power, feedback, post;
    uint64_t locked_from;
};

/* What the user of the chip sets. */
struct chip_hooks {
    void *user;
    void (*word)(void *user, const struct spi *spi, uint32_t bits);
    void (*word_start)(void *user);
    void (*levels)(void *user);
    void (*uart)(void *user, uint8_t byte);
    void (*trouble)(void *user, const char *text);
    void (*warn)(void *user, const char *text);
    void (*call)(void *user, struct core *core); /* core 0 comes to one of `calls` */
};

#define CALLS_MOST 8

struct chip {
    struct chip_hooks hooks;
    struct registers *registers; /* what silicon takes */
    struct core core[CORES];
    uint32_t cores;
    bool riscv;       /* the instruction set of the cores, which the image definition says */
    uint64_t now;     /* of the core that runs, or of the event that happens */
    uint64_t limit;   /* the running core gives way then */
    uint64_t resting; /* while all cores slept */
    const char *ended;
    uint32_t calls[CALLS_MOST], call_count;
    bool free_wire, free_flash;
    uint64_t charge;       /* how long a pin reads low after its pull-up is turned on */
    uint32_t seed, chance; /* delays; 0: none */
    uint32_t delay_left[CORES];

    uint8_t rom[ROM_BYTES], ram[RAM_BYTES];
    uint8_t *flash;
    uint32_t flash_bytes;
    struct flash_chip flash_chip;
    struct qmi qmi;
    struct xip xip;
    uint32_t entry, stack, stack_limit, vectors; /* what the ROM gives to core 0 */

    uint32_t resets; /* blocks in reset */
    uint32_t xosc_control, xosc_startup, ref_control, sys_control, sys_divider, peri_control, peri_divider;
    uint64_t xosc_stable;
    struct pll pll[2];
    double ref_hz, sys_hz, peri_hz;
    struct facts {
        double ring_hz;
        uint32_t id, reset;  /* CHIP_ID, CHIP_RESET */
        uint32_t counter[8]; /* the words of the frequency counter */
        uint64_t counted_at; /* it counts until then */
    } facts;
    uint64_t sys_cycle; /* fs */
    uint32_t psm_off, psm_watchdog;
    struct tick {
        uint32_t control, cycles;
        uint64_t period, from; /* fs; when `counted` was right */
        uint64_t counted;
    } tick[2]; /* of timer 0, of the watchdog */
    uint32_t alarm, timer_enabled, timer_interrupts;
    uint64_t alarm_time;
    uint32_t watchdog_control, watchdog_load, watchdog_reason, watchdog_scratch[8];
    uint64_t watchdog_time; /* when it bites */

    uint32_t out, out_enable, levels, low; /* low: pins that the user pulls low */
    uint32_t io_control[PINS], pad[PINS];
    uint64_t pulled_up[PINS];
    uint32_t core1_words, core1_word[6]; /* of the handshake with the ROM */
    uint32_t locks;
    uint32_t mtime_control;
    uint64_t mtime, mtime_from; /* the timer of SIO had that value then */

    struct spi spi[2];
    struct channel channel[CHANNELS];
    uint32_t dma_interrupts, dma_enabled[2];

    uint32_t uart_control, uart_line, uart_divisor, uart_fraction;
    uint64_t uart_free;
    uint8_t uart_in[256];
    uint32_t uart_first, uart_count;
};

/* chip.c */
void chip_init(struct chip *chip, uint32_t cores, const uint8_t *image, uint32_t bytes);
void chip_reset(struct chip *chip);
/* Goes on for at most so many events or turns; false: the image has ended. */
bool chip_go_on(struct chip *chip);
uint64_t chip_idle(const struct core *core);
void chip_set_delays(struct chip *chip, uint32_t frame);
void chip_event_at(struct chip *chip, uint64_t time);
void chip_end(struct chip *chip, const char *why);
void chip_warn(struct chip *chip, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* memory.c: bytes is 1, 2 or 4. */
uint32_t memory_read(struct core *core, uint32_t address, uint32_t bytes);
void memory_write(struct core *core, uint32_t address, uint32_t value, uint32_t bytes);
uint32_t memory_fetch(struct core *core, uint32_t address);
/* Checks an access to several words: it is a fault unless they are aligned. */
void memory_check_aligned(struct core *core, uint32_t address);
uint32_t memory_dma_read(struct chip *chip, uint32_t address, uint32_t bytes);

/* xip.c: a core's read of `bytes` (1, 2, 4) in the windows of flash, which takes time. */
uint32_t xip_read(struct core *core, uint32_t address, uint32_t bytes);
void xip_reset(struct chip *chip);
uint32_t xip_control_read(struct chip *chip, uint32_t offset);
void xip_control_write(struct chip *chip, uint32_t offset, uint32_t value);

/* qmi.c */
void qmi_reset(struct chip *chip); /* the way in which the ROM leaves it */
uint32_t qmi_read(struct chip *chip, uint32_t offset);
void qmi_write(struct chip *chip, uint32_t offset, uint32_t value);
uint32_t qmi_pad_read(struct chip *chip, uint32_t offset);
void qmi_pad_write(struct chip *chip, uint32_t offset, uint32_t value);
/* Reads `bytes` at an address of the flash for a core; cycles until it has them. *right: they were sampled rightly. */
uint64_t qmi_transfer(struct core *core, uint32_t address, uint32_t bytes, bool *right);
/* Whether reads by M0_TIMING have less margin than hal/chips/rp2/flash_margin.h asks for. */
bool qmi_is_marginal(const struct chip *chip);
/* Whether direct mode takes the flash away from the windows. */
static inline bool qmi_is_direct(const struct chip *chip)
{
    return (chip->qmi.csr & 1) != 0;
}

/* flash.c */
/* ID[,STATUS2][,locked][,sfdp][,EARLIEST:LATEST]: hexadecimal numbers; picoseconds. false: it is none of these. */
bool flash_is(struct flash_chip *flash, const char *text);
void flash_reset(struct flash_chip *flash);
/* The command by which the ROM reads this flash. */
uint32_t flash_rom_command(const struct flash_chip *flash);
/* The flash is selected or released, and answers to a byte. */
void flash_select(struct chip *chip, bool selected);
uint8_t flash_byte(struct chip *chip, uint8_t byte);
/* A read begins with these phases as in QMI's RFMT and RCMD, at a clock. */
void flash_begin_read(struct chip *chip, uint32_t rfmt, uint32_t rcmd, double sck_hz);

/* core.c */
void core_reset(struct core *core, uint32_t vectors, uint32_t stack, uint32_t entry);
void core_run(struct core *core, uint64_t until);
void core_wake(struct core *core);
void core_wait(struct core *core, bool for_interrupt);
void core_send_event(struct core *core);
void core_stack_is(struct core *core, uint32_t address);
void core_lock_up(struct core *core);
void core_fault(struct core *core);
uint32_t core_argument(struct core *core, uint32_t number);
void core_set_argument(struct core *core, uint32_t number, uint32_t value);
void core_return(struct core *core);
/* The time at which a tick would end the sleep of this core; NEVER: none would. */
uint64_t core_next_tick(const struct core *core);

/* arm.c */
void arm_start(struct core *core, uint32_t vectors, uint32_t stack, uint32_t entry);
void arm_step(struct core *core);
void arm_interrupt(struct core *core);
bool arm_wakes(struct core *core);
bool arm_takes_ticks(const struct core *core);
void arm_fault(struct core *core);
void arm_branch(struct core *core, uint32_t address);
void arm_set_stack(struct core *core, uint32_t address);
void arm_undefined(struct core *core, uint32_t code);
uint32_t arm_special(const struct core *core, uint32_t number);
void arm_set_special(struct core *core, uint32_t number, uint32_t value);
uint32_t arm_private_read(struct core *core, uint32_t address);
void arm_private_write(struct core *core, uint32_t address, uint32_t value);

/* riscv.c */
void riscv_start(struct core *core, uint32_t vectors, uint32_t stack, uint32_t entry);
void riscv_step(struct core *core);
void riscv_interrupt(struct core *core);
bool riscv_wakes(struct core *core);
bool riscv_takes_ticks(const struct core *core);
void riscv_fault(struct core *core);

/* rom_blocks.c: sets how core 0 starts; NULL: the ROM starts the image, else why it does not. The image has so many
 * bytes, the flash has FLASH_BYTES. */
const char *rom_refuses(struct chip *chip, const uint8_t *flash, uint32_t bytes);

/* rom.c */
void rom_start(struct chip *chip);
bool rom_call(struct core *core);
void rom_breakpoint(struct core *core, uint32_t number);
void rom_core1_word(struct chip *chip, uint32_t word);

/* Registers of the blocks: the offset is that within the block. */
uint32_t clocks_read(struct chip *chip, uint32_t address);
void clocks_write(struct chip *chip, uint32_t address, uint32_t value);
void clocks_reset(struct chip *chip);
void facts_init(struct chip *chip);
void facts_reset(struct chip *chip);
bool facts_set(struct chip *chip, const char *text); /* "ring=HZ,id=N,reset=N,reason=N" */
uint32_t counter_read(const struct chip *chip, uint32_t number);
void counter_write(struct chip *chip, uint32_t number, uint32_t value);
uint32_t timer_read(struct chip *chip, uint32_t offset);
void timer_write(struct chip *chip, uint32_t offset, uint32_t value);
void timer_event(struct chip *chip);
uint32_t sio_read(struct core *core, uint32_t offset);
void sio_write(struct core *core, uint32_t offset, uint32_t value);
uint32_t pins_read(struct chip *chip, uint32_t address);
void pins_write(struct chip *chip, uint32_t address, uint32_t value);
uint32_t pins_in(struct chip *chip);
void pins_set_out(struct chip *chip, uint32_t out, uint32_t enable);
bool pins_carry(const struct chip *chip, uint32_t function, uint32_t mask, uint32_t equals);
void pins_reset(struct chip *chip);
uint32_t spi_read(struct chip *chip, uint32_t unit, uint32_t offset);
void spi_write(struct chip *chip, uint32_t unit, uint32_t offset, uint32_t value);
void spi_event(struct chip *chip, uint32_t unit);
void spi_push(struct chip *chip, uint32_t unit, uint32_t word);
bool spi_wants(const struct chip *chip, uint32_t unit);
uint32_t dma_read(struct chip *chip, uint32_t offset);
void dma_write(struct chip *chip, uint32_t offset, uint32_t value);
void dma_feed(struct chip *chip);
uint32_t uart_read(struct chip *chip, uint32_t offset);
void uart_write(struct chip *chip, uint32_t offset, uint32_t value);
void uart_feed(struct chip *chip, uint8_t byte);

/* Interrupts that ask now, as bits. */
uint64_t chip_interrupts(const struct chip *chip);

static inline uint32_t chip_bits(uint32_t value, uint32_t low, uint32_t count)
{
    return value >> low & ((1U << count) - 1);
}

#endif
