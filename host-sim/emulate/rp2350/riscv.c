/*
 * A Hazard3 core: its traps, registers and instructions (3.8). Cycles are an estimate from its pipeline: a load costs
 * one more when the next instruction takes its result, a taken branch or a jump one more, a division 17 more.
 */
#include "riscv.h"

#include <stddef.h>

enum { MSTATUS_MIE = 1 << 3, MSTATUS_MPIE = 1 << 7, MSTATUS_MPP = 3 << 11 };
enum { MIP_TIMER = 1 << 7, MIP_EXTERNAL = 1 << 11 };
enum { CAUSE_ILLEGAL = 2, CAUSE_BREAKPOINT = 3, CAUSE_LOAD = 5, CAUSE_STORE = 7, CAUSE_ECALL = 11 };
#define CAUSE_INTERRUPT (1U << 31)
enum { RESULT_IS_LATE = 1, JUMP_CYCLES = 1, AMO_CYCLES = 3 };

void riscv_start(struct core *core, uint32_t vectors, uint32_t stack, uint32_t entry)
{
    core->csr.mtvec = vectors;
    core->csr.mstatus = MSTATUS_MPP;
    core->r[2] = stack;
    core->pc = core->next = entry & ~1U;
}

static uint32_t pending(struct core *core)
{
    const bool external = (core->irq_enabled & chip_interrupts(core->chip)) != 0;
    return (external ? MIP_EXTERNAL : 0) | (core->tick_at <= core->chip->now ? MIP_TIMER : 0);
}

static void trap(struct core *core, uint32_t cause, uint32_t return_to)
{
    struct csr *csr = &core->csr;
    const bool by_cause = (csr->mtvec & 1) != 0 && (cause & CAUSE_INTERRUPT) != 0;
    csr->mepc = return_to;
    csr->mcause = cause;
    csr->mstatus = MSTATUS_MPP | (csr->mstatus & MSTATUS_MIE ? MSTATUS_MPIE : 0);
    core->next = (csr->mtvec & ~3U) + (by_cause ? 4 * (cause & 31) : 0);
    core->late = 0;
    core->cycles += JUMP_CYCLES + 1;
}

void riscv_fault(struct core *core)
{
    trap(core, CAUSE_LOAD, core->pc);
}

void riscv_interrupt(struct core *core)
{
    if ((core->csr.mstatus & MSTATUS_MIE) == 0 || core->csr.mie == 0) {
        return;
    }
    const uint32_t now = pending(core) & core->csr.mie;
    if (now != 0) {
        trap(core, CAUSE_INTERRUPT | (now & MIP_EXTERNAL ? 11 : 7), core->next);
    }
}

bool riscv_takes_ticks(const struct core *core)
{
    return (core->csr.mie & MIP_TIMER) != 0 && (core->sleeps_for_interrupt || (core->csr.mstatus & MSTATUS_MIE) != 0);
}

/* WFI ends with an interrupt that mstatus holds back, too; h3.block with one that is taken. */
bool riscv_wakes(struct core *core)
{
    return (pending(core) & core->csr.mie) != 0 &&
           (core->sleeps_for_interrupt || (core->csr.mstatus & MSTATUS_MIE) != 0);
}

/* Region 0 of the PMP: no access where the configuration gives none, also for machine mode if PMPCFGM0 says so (3.8.3).
 */
static void protect(struct core *core)
{
    const struct csr *csr = &core->csr;
    const uint32_t ones = (uint32_t)__builtin_ctz(~csr->pmpaddr0);
    const bool on = (csr->pmpcfg0 & 0x18) == 0x18 && (csr->pmpcfgm0 & 1) != 0;
    if (on && ((csr->pmpcfg0 & 7) != 0 || csr->pmpcfg0 > 255 || ones < 2)) {
        chip_warn(core->chip, "core %u uses its memory protection in a way that is not modelled", core->index);
    }
    core->forbidden_bytes = on ? 8U << ones : 0;
    core->forbidden = (csr->pmpaddr0 << 2) & ~(core->forbidden_bytes - 1);
}

static bool is_forbidden(const struct core *core, uint32_t address)
{
    return address - core->forbidden < core->forbidden_bytes;
}

/* The number of the next external interrupt, x 4 (3.8.6.1.3). */
static uint32_t next_interrupt(const struct core *core)
{
    const uint64_t irqs = core->irq_enabled & chip_interrupts(core->chip);
    return irqs == 0 ? 1U << 31 : 4 * (uint32_t)__builtin_ctzll(irqs);
}

static uint32_t *csr_word(struct core *core, uint32_t number)
{
    struct csr *csr = &core->csr;
    switch (number) {
    case 0x300:
        return &csr->mstatus;
    case 0x304:
        return &csr->mie;
    case 0x305:
        return &csr->mtvec;
    case 0x320:
        return &csr->mcountinhibit;
    case 0x340:
        return &csr->mscratch;
    case 0x341:
        return &csr->mepc;
    case 0x342:
        return &csr->mcause;
    case 0x343:
        return &csr->mtval;
    case 0x3a0:
        return &csr->pmpcfg0;
    case 0x3b0:
        return &csr->pmpaddr0;
    case 0xbd0:
        return &csr->pmpcfgm0;
    default:
        return NULL;
    }
}

enum { MIP = 0x344, MEIEA = 0xbe0, MEIPA = 0xbe1, MEINEXT = 0xbe4, MHARTID = 0xf14 };

/* An array of bits in windows of 16; the number of the window comes with the access (3.8.6.1.2). */
static uint32_t window(uint64_t bits, uint32_t number)
{
    return (uint32_t)(bits >> 16 * (number & 3)) << 16;
}

static uint32_t csr_read(struct core *core, uint32_t number, uint32_t operand)
{
    const uint32_t *word = csr_word(core, number);
    if (word != NULL) {
        return *word;
    }
    switch (number) {
    case MIP:
        return pending(core);
    case MEIEA:
        return window(core->irq_enabled, operand);
    case MEIPA:
        return window(chip_interrupts(core->chip), operand);
    case MEINEXT:
        return next_interrupt(core);
    case MHARTID:
        return core->index;
    default:
        chip_warn(core->chip, "core %u reads the register %x of the core at %08x", core->index, number, core->pc);
        return 0;
    }
}

static void csr_write(struct core *core, uint32_t number, uint32_t value, uint32_t operand)
{
    uint32_t *word = csr_word(core, number);
    if (word != NULL) {
        *word = number == 0x300 ? (value & (MSTATUS_MIE | MSTATUS_MPIE)) | MSTATUS_MPP : value;
        protect(core);
    } else if (number == MEIEA) {
        const uint32_t shift = 16 * (operand & 3);
        core->irq_enabled = (core->irq_enabled & ~(0xffffULL << shift)) | (uint64_t)(value >> 16) << shift;
    } else {
        chip_warn(core->chip, "core %u writes the register %x of the core at %08x", core->index, number, core->pc);
    }
}

static void csr_access(struct core *core, uint32_t code)
{
    const uint32_t kind = chip_bits(code, 12, 3), a = chip_bits(code, 15, 5), d = chip_bits(code, 7, 5),
                   number = code >> 20;
    const uint32_t operand = kind & 4 ? a : core->r[a];
    const uint32_t old = (kind & 3) == 1 && d == 0 ? 0 : csr_read(core, number, operand);
    if ((kind & 3) == 1) {
        csr_write(core, number, operand, operand);
    } else if (a != 0) {
        csr_write(core, number, (kind & 3) == 2 ? old | operand : old & ~operand, operand);
    }
    core->r[d] = old;
}

/* EBREAK between two shifts that do nothing is semihosting. */
static void breakpoint(struct core *core)
{
    if (memory_read(core, core->pc - 4, 4) == 0x01f01013 && memory_read(core, core->pc + 4, 4) == 0x40705013) {
        rom_breakpoint(core, 0xab);
    } else {
        trap(core, CAUSE_BREAKPOINT, core->pc);
    }
}

static bool system_instruction(struct core *core, uint32_t code)
{
    if ((code >> 12 & 3) != 0) {
        csr_access(core, code);
        return true;
    }
    switch (code) {
    case 0x00000073:
        trap(core, CAUSE_ECALL, core->pc);
        return true;
    case 0x00100073:
        breakpoint(core);
        return true;
    case 0x30200073: /* MRET */
        core->next = core->csr.mepc;
        core->csr.mstatus = MSTATUS_MPP | MSTATUS_MPIE | (core->csr.mstatus & MSTATUS_MPIE ? MSTATUS_MIE : 0);
        core->cycles += JUMP_CYCLES;
        return true;
    case 0x10500073:
        core_wait(core, true);
        return true;
    default:
        return false;
    }
}

static bool is_aligned(struct core *core, uint32_t address, uint32_t bytes)
{
    if (address % bytes == 0) {
        return true;
    }
    chip_warn(core->chip, "core %u reads or writes %u bytes at %08x, at %08x", core->index, bytes, address, core->pc);
    return false;
}

static bool load(struct core *core, uint32_t code, uint32_t address)
{
    const uint32_t kind = chip_bits(code, 12, 3), bytes = 1U << (kind & 3), d = chip_bits(code, 7, 5);
    if (kind == 3 || kind > 5 || !is_aligned(core, address, bytes)) {
        return false;
    }
    if (is_forbidden(core, address)) {
        trap(core, CAUSE_LOAD, core->pc);
        return true;
    }
    const uint32_t value = memory_read(core, address, bytes);
    core->r[d] = kind < 2 ? riscv_extend(value, 8 * bytes) : value;
    core->late = d;
    return true;
}

static bool store(struct core *core, uint32_t code)
{
    const uint32_t kind = chip_bits(code, 12, 3), bytes = 1U << kind;
    const uint32_t address =
        core->r[chip_bits(code, 15, 5)] + riscv_extend(code >> 25 << 5 | chip_bits(code, 7, 5), 12);
    if (kind > 2 || !is_aligned(core, address, bytes)) {
        return false;
    }
    if (is_forbidden(core, address)) {
        trap(core, CAUSE_STORE, core->pc);
    } else {
        memory_write(core, address, core->r[chip_bits(code, 20, 5)], bytes);
    }
    return true;
}

static bool atomic(struct core *core, uint32_t code)
{
    const uint32_t address = core->r[chip_bits(code, 15, 5)], b = core->r[chip_bits(code, 20, 5)], what = code >> 27;
    if (chip_bits(code, 12, 3) != 2 || !is_aligned(core, address, 4)) {
        return false;
    }
    const uint32_t old = what == 3 ? 0 : memory_read(core, address, 4);
    const bool less = (int32_t)old < (int32_t)b;
    const uint32_t results[32] = {[0] = old + b,
                                  [1] = b,
                                  [3] = b,
                                  [4] = old ^ b,
                                  [8] = old | b,
                                  [12] = old & b,
                                  [16] = less ? old : b,
                                  [20] = less ? b : old,
                                  [24] = old < b ? old : b,
                                  [28] = old < b ? b : old};
    if (what !=
        2) { /* LR; SC always succeeds, for cores give way between instructions only and nothing here contends */
        memory_write(core, address, results[what], 4);
    }
    core->r[chip_bits(code, 7, 5)] = old;
    core->cycles += AMO_CYCLES;
    return (what & 3) == 0 || what < 4;
}

static bool branch(struct core *core, uint32_t code, uint32_t a, uint32_t b)
{
    const uint32_t kind = chip_bits(code, 12, 3);
    const bool conditions[4] = {a == b, false, (int32_t)a < (int32_t)b, a < b};
    const uint32_t by =
        (code >> 31) << 12 | (code >> 7 & 1) << 11 | chip_bits(code, 25, 6) << 5 | chip_bits(code, 8, 4) << 1;
    if (conditions[kind >> 1] != (kind & 1)) {
        core->next = core->pc + riscv_extend(by, 13);
        core->cycles += JUMP_CYCLES;
    }
    return kind >> 1 != 1;
}

static void jump(struct core *core, uint32_t code, uint32_t to)
{
    const uint32_t link = core->next;
    core->next = to & ~1U;
    core->r[chip_bits(code, 7, 5)] = link;
    core->cycles += JUMP_CYCLES;
}

static uint32_t jal_distance(uint32_t code)
{
    return riscv_extend(
        (code >> 31) << 20 | chip_bits(code, 12, 8) << 12 | (code >> 20 & 1) << 11 | chip_bits(code, 21, 10) << 1, 21);
}

/* SLT to x0 does nothing, so Hazard3 makes hints of it: h3.block and h3.unblock (3.8.6.3). */
static bool is_hint(struct core *core, uint32_t code)
{
    if (code == 0x00002033) {
        core_wait(core, false);
    } else if (code == 0x00102033) {
        for (uint32_t i = 0; i < core->chip->cores; i++) {
            core_send_event(&core->chip->core[i]);
        }
    } else {
        return false;
    }
    return true;
}

static bool execute(struct core *core, uint32_t code)
{
    uint32_t *const d = &core->r[chip_bits(code, 7, 5)];
    const uint32_t a = core->r[chip_bits(code, 15, 5)], b = core->r[chip_bits(code, 20, 5)];
    switch (code & 127) {
    case 0x03:
        return load(core, code, a + riscv_extend(code >> 20, 12));
    case 0x0f:
        return true; /* fences */
    case 0x13:
        return riscv_operate_immediate(code, a, d);
    case 0x17:
        *d = core->pc + (code & 0xfffff000);
        return true;
    case 0x23:
        return store(core, code);
    case 0x2f:
        return atomic(core, code);
    case 0x33:
        return is_hint(core, code) || riscv_operate(core, code, a, b, d);
    case 0x37:
        *d = code & 0xfffff000;
        return true;
    case 0x63:
        return branch(core, code, a, b);
    case 0x67:
        jump(core, code, a + riscv_extend(code >> 20, 12));
        return true;
    case 0x6f:
        jump(core, code, core->pc + jal_distance(code));
        return true;
    case 0x73:
        return system_instruction(core, code);
    default:
        return false;
    }
}

void riscv_step(struct core *core)
{
    const uint32_t half = memory_fetch(core, core->pc), late = core->late;
    const bool is_long = (half & 3) == 3;
    const uint32_t code = is_long ? half | memory_fetch(core, core->pc + 2) << 16 : riscv_expand(half);
    core->next = core->pc + (is_long ? 4 : 2);
    core->late = 0;
    core->cycles +=
        1 + (late != 0 && (chip_bits(code, 15, 5) == late || chip_bits(code, 20, 5) == late) ? RESULT_IS_LATE : 0);
    if (!execute(core, code)) {
        chip_warn(core->chip, "core %u: no instruction that the model knows: %x at %08x", core->index, code, core->pc);
        trap(core, CAUSE_ILLEGAL, core->pc);
    }
    core->r[0] = 0;
    core_stack_is(core, core->r[2]);
}
