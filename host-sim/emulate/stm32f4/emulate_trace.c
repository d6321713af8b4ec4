/*
 * QEMU's netduinoplus2, an STM32F405. Its trace tells of stores; they become events on wires (wire_replay.h), and those
 * a picture. See emulate.h.
 *
 * The trace has no times. It has the SysTick interrupts of the image, one each millisecond; the time of an event is the
 * number of interrupts before it.
 */
#define _XOPEN_SOURCE 700

#include "emulate.h"

#include "complain.h"
#include "emulate_qemu.h"
#include "emulate_registers.h"
#include "hal.h"
#include "wire_replay.h"

#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

/* RM0090, memory map and registers; the port (hal/stm32f4) uses these units. */
#define SPI_CR1   0x40003800u
#define SPI_DR    0x4000380Cu
#define USART_DR  0x40004804u
#define GPIO_A    0x40020000u
#define GPIO_STEP 0x400u
#define GPIO_BSRR 0x18u
#define GPIO_ALL  2         /* ports: as many lines as an event has */
#define APB1_HZ   16000000u /* QEMU has no RCC, so the image finds no crystal and stays at the chip's own 16 MHz */

#define UARTS_BEFORE  2 /* the log is USART3 */
#define TICK_NS       1000000u
#define TICKS_A_FRAME 100000u
#define RUN_MAX       4096 /* bytes that become one event */

struct trace {
    const struct emulation *e;
    struct qemu q;
    struct wire *wire;
    struct emulate_registers registers;
    struct ppm picture;
    uint64_t levels, ticks, frame_ticks;
    uint32_t clock_hz, frames;
    uint8_t run[RUN_MAX];
    size_t run_length;
    bool started;
};

static int show(void *context, uint32_t frame, const uint8_t *rgb)
{
    struct trace *t = context;
    if (frame >= t->e->frames) {
        return 0;
    }
    t->frames = frame + 1;
    t->frame_ticks = t->ticks;
    memcpy(t->picture.rgb, rgb, (size_t)t->picture.width * t->picture.height * 3);
    return t->e->frame(t->e->context, frame, &t->picture);
}

/* Tells the first complaint, which ends the run. */
static void reject(void *context, const char *complaint)
{
    const struct trace *t = context;
    if (wire_replay_complaints(t->wire) == 1) {
        complain("%s", complaint);
    }
}

/* Passes on the bytes since the last event of another kind. */
static int flush(struct trace *t)
{
    const struct wire_event event = {.kind = WIRE_SPI,
                                     .time_ns = t->ticks * TICK_NS,
                                     .end_ns = t->ticks * TICK_NS,
                                     .levels = t->levels,
                                     .levels_at_end = t->levels,
                                     .select = WIRE_NO_SELECT,
                                     .asked_hz = t->clock_hz,
                                     .got_hz = t->clock_hz,
                                     .word_bits = 8,
                                     .bytes = t->run,
                                     .count = t->run_length};
    const bool any = t->run_length > 0;
    t->run_length = 0;
    return any ? wire_replay_event(t->wire, &event) : 0;
}

static int send_byte(struct trace *t, uint8_t byte)
{
    t->run[t->run_length++] = byte;
    return t->run_length == RUN_MAX ? flush(t) : 0;
}

static int move_pins(struct trace *t, uint32_t port, uint32_t value)
{
    const int status = flush(t);
    t->levels &= ~((uint64_t)(value >> 16) << (32 * port));
    t->levels |= (uint64_t)(value & 0xFFFF) << (32 * port);
    const struct wire_event event = {.kind = WIRE_LEVEL, .time_ns = t->ticks * TICK_NS, .levels = t->levels};
    return status == 0 ? wire_replay_event(t->wire, &event) : status;
}

/* Asks for the next frame, with the buttons that the script wants during it. */
static int step(struct trace *t)
{
    static const struct {
        uint32_t button;
        char letter;
    } letters[] = {{HAL_BUTTON_UP, 'u'},
                   {HAL_BUTTON_DOWN, 'd'},
                   {HAL_BUTTON_LEFT, 'l'},
                   {HAL_BUTTON_RIGHT, 'r'},
                   {HAL_BUTTON_SELECT, 's'}};
    char text[8], waste[4096];
    size_t n = 0;
    const uint32_t held = key_script_at(t->e->keys, t->frames);
    for (size_t i = 0; i < sizeof letters / sizeof letters[0]; i++) {
        text[n] = letters[i].letter;
        n += (held & letters[i].button) != 0;
    }
    text[n] = 'H';
    text[n + 1] = '\0';
    while (recv(t->q.uart, waste, sizeof waste, MSG_DONTWAIT) > 0) { /* the log is read from the trace */
    }
    return emulate_qemu_send(&t->q, text);
}

/* Takes a line of the log. The image is told to hold during its first frame, the first time that it listens. */
static int logged(struct trace *t)
{
    int status = emulate_qemu_check_line(&t->q);
    if (status == 0 && !t->started && strncmp(t->q.line, "demo ", 5) == 0) {
        t->started = true;
        return emulate_qemu_send(&t->q, "H");
    }
    if (status == 0 && t->started && strncmp(t->q.line, "frame ", 6) == 0) {
        status = flush(t);
        return status == 0 ? step(t) : status;
    }
    return status;
}

static int store(struct trace *t, uint32_t address, uint32_t value)
{
    const uint32_t port = (address - GPIO_A) / GPIO_STEP;
    if (address == SPI_DR) {
        return send_byte(t, (uint8_t)value);
    }
    if (address == SPI_CR1) {
        const int status = flush(t);
        t->clock_hz = APB1_HZ >> ((value >> 3 & 7) + 1);
        return status;
    }
    if (address == USART_DR) {
        return emulate_qemu_logged(&t->q, (char)value) ? logged(t) : 0;
    }
    if (address >= GPIO_A && port < GPIO_ALL && (address - GPIO_A) % GPIO_STEP == GPIO_BSRR) {
        return move_pins(t, port, value);
    }
    return 0;
}

static int take_line(void *context, const char *line)
{
    struct trace *t = context;
    struct emulate_access access;
    int status = emulate_registers_line(&t->registers, line, &access);
    status = status == 0 ? emulate_registers_said(&t->registers) : status;
    if (status == 0 && access.tick) {
        t->ticks++;
        status = flush(t);
    } else if (status == 0 && access.store) {
        status = store(t, access.address, access.value);
    }
    return status == 0 && wire_replay_complaints(t->wire) > 0 ? COMPLAINED : status;
}

static int run(struct trace *t)
{
    t->q.take = take_line;
    t->q.context = t;
    int status = emulate_qemu_command(&t->q, "cont", NULL);
    while (status == 0 && t->frames < t->e->frames) {
        if (t->ticks - t->frame_ticks > TICKS_A_FRAME) {
            status = complain("no frame after frame %u", (unsigned)t->frames);
        } else if (!emulate_qemu_trace(&t->q)) {
            status = t->q.taken != 0 || emulate_qemu_interrupted()
                         ? COMPLAINED
                         : complain("QEMU stopped after %u frames", (unsigned)t->frames);
        }
    }
    t->q.take = NULL; /* what the image does after the last frame is not looked at */
    return status;
}

int emulate_trace(const struct emulation *e)
{
    struct trace t = {.e = e, .clock_hz = APB1_HZ};
    const struct panel *panel = e->board->panel;
    const uint16_t width = panel_width(panel, e->board->rotation), height = panel_height(panel, e->board->rotation);
    const struct wire_config config = {.board = e->board,
                                       .select = e->board->spi_select,
                                       .rotation = e->board->rotation,
                                       .context = &t,
                                       .frame = show,
                                       .reject = reject};
    t.picture = (struct ppm){width, height, malloc((size_t)width * height * 3)};
    t.wire = wire_replay_open(&config);
    if (emulate_registers_open(&t.registers, &stm32f4_registers) != 0 || t.picture.rgb == NULL || t.wire == NULL) {
        emulate_registers_close(&t.registers);
        wire_replay_close(t.wire);
        free(t.picture.rgb);
        return complain("not enough memory, or no model of the board's controller");
    }
    int status = emulate_qemu_start(&t.q, "netduinoplus2", e->image, UARTS_BEFORE, true);
    t.q.log = e->log;
    if (status == 0) {
        status = run(&t);
    }
    const int stopped = emulate_qemu_stop(&t.q);
    emulate_registers_close(&t.registers);
    wire_replay_close(t.wire);
    free(t.picture.rgb);
    return status != 0 ? status : stopped;
}
