/* See sender.h. Positions in the ring count all bytes since open; a byte is at its position modulo ring_bytes. */
#define _POSIX_C_SOURCE 200809L
#include "sender.h"

#include "fail.h"
#include "i2c.h"
#include "lines.h"
#include "spi.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define RING_BYTES    65536U /* at least: 17 ms at 31.25 MHz */
#define SHORT_BYTES   64U    /* longest write whose time tells what a write costs besides its bits */
#define WRITE_WEIGHT  16     /* the mean's weight of a new short write is 1/16 */
#define WRITE_NS_MOST 20000000

static uint64_t now_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000U + (uint64_t)now.tv_nsec;
}

/* ---- the thread --------------------------------------------------------------------------------- */

int linux_sender_dc(struct linux_hal *h, enum hal_dc dc)
{
    if (h->dc_now == (int)dc) {
        return HAL_OK;
    }
    const bool wired = !h->i2c; /* an I2C message tells it */
    const int status = wired ? linux_gpio_set(&h->dc, (dc == HAL_DATA) != h->dc.active_low) : 0;
    h->dc_now = status == 0 ? (int)dc : -1;
    return status == 0
               ? HAL_OK
               : linux_fail(h->error, linux_status(-status), "the D/C line cannot be set: %s", strerror(-status));
}

uint32_t linux_write_mean(uint32_t mean_ns, uint64_t took_ns)
{
    const int64_t ns = took_ns < WRITE_NS_MOST ? (int64_t)took_ns : WRITE_NS_MOST;
    return mean_ns == 0 ? (uint32_t)ns : (uint32_t)(mean_ns + (ns - (int64_t)mean_ns) / WRITE_WEIGHT);
}

/* Sends a piece. The bus is idle when this starts and when it returns, so D/C may move first. */
static int send_piece(struct linux_hal *h, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    const bool moves = h->dc_now != (int)dc;
    const uint64_t start_ns = now_ns();
    int status = linux_sender_dc(h, dc);
    if (status == HAL_OK) {
        status = h->i2c ? linux_i2c_send(&h->spi, dc, bytes, n, h->error) : linux_spi_send(&h->spi, bytes, n, h->error);
    }
    const uint64_t took_ns = now_ns() - start_ns;
    if (status < 0 || h->spi.clock_hz == 0) {
        return status;
    }
    const uint64_t bits_ns = 8000000000U * n / h->spi.clock_hz;
    pthread_mutex_lock(&h->mutex);
    if (n <= SHORT_BYTES && moves) {
        h->write_ns = linux_write_mean(h->write_ns, took_ns > bits_ns ? took_ns - bits_ns : 0);
    }
    if ((n >= LINUX_MEASURED_BYTES || n == h->most) && (h->best_ns == 0 || took_ns * h->best_bytes < h->best_ns * n)) {
        h->best_ns = took_ns;
        h->best_bytes = n;
    }
    pthread_mutex_unlock(&h->mutex);
    return status;
}

/* The bytes that may be sent in one message now; 0: more may come, or there are none. */
static size_t next_piece(struct linux_hal *h)
{
    const uint32_t last = h->run_put - 1;
    while (h->run_got != last && h->runs[h->run_got % LINUX_RUNS].end == h->sent) {
        h->run_got++;
    }
    const uint64_t left = h->runs[h->run_got % LINUX_RUNS].end - h->sent;
    const size_t piece = left > 0 ? linux_spi_piece((size_t)left, h->bufsiz) : 0;
    return h->run_got != last || piece == h->most || h->flushed > h->sent ? piece : 0;
}

/* The thread that sends. While bytes are being sent, they and the kit belong to this thread. A message that goes round
 * the end of the ring continues in a copy behind it. */
static void *sender(void *context)
{
    struct linux_hal *h = context;
    pthread_mutex_lock(&h->mutex);
    while (!h->quit) {
        const size_t n = next_piece(h), at = (size_t)(h->sent % h->ring_bytes);
        if (n == 0) {
            pthread_cond_wait(&h->changed, &h->mutex);
            continue;
        }
        const enum hal_dc dc = h->runs[h->run_got % LINUX_RUNS].dc;
        pthread_mutex_unlock(&h->mutex);
        if (at + n > h->ring_bytes) {
            memcpy(h->ring + h->ring_bytes, h->ring, at + n - h->ring_bytes);
        }
        const int status = send_piece(h, dc, h->ring + at, n);
        pthread_mutex_lock(&h->mutex);
        h->sent += n;
        if (status < 0) { /* what came after it is dropped */
            h->status = status;
            h->sent = h->written;
            h->run_got = h->run_put - 1;
        }
        pthread_cond_broadcast(&h->changed);
    }
    pthread_mutex_unlock(&h->mutex);
    return NULL;
}

/* ---- the caller --------------------------------------------------------------------------------- */

static int take_status(struct linux_hal *h)
{
    const int status = h->status;
    h->status = HAL_OK;
    return status;
}

/* Begins a run where the last one has another D/C, and waits until there is room in the ring. */
static size_t make_room(struct linux_hal *h, enum hal_dc dc)
{
    while (h->status == HAL_OK && (h->written - h->sent == h->ring_bytes || h->run_put - h->run_got == LINUX_RUNS)) {
        pthread_cond_wait(&h->changed, &h->mutex);
    }
    if (h->runs[(h->run_put - 1) % LINUX_RUNS].dc != dc) {
        h->runs[h->run_put++ % LINUX_RUNS] = (struct linux_run){dc, h->written};
    }
    const size_t used = (size_t)(h->written - h->sent), to_end = h->ring_bytes - (size_t)(h->written % h->ring_bytes);
    return h->ring_bytes - used < to_end ? h->ring_bytes - used : to_end;
}

int linux_sender_write(struct linux_hal *h, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    pthread_mutex_lock(&h->mutex);
    while (n > 0 && h->status == HAL_OK) {
        const size_t room = make_room(h, dc), part = n < room ? n : room;
        if (h->status < 0) {
            break;
        }
        pthread_mutex_unlock(&h->mutex); /* nobody else writes there */
        memcpy(h->ring + h->written % h->ring_bytes, bytes, part);
        pthread_mutex_lock(&h->mutex);
        bytes += part;
        n -= part;
        if (h->status == HAL_OK) {
            h->written += part;
            h->runs[(h->run_put - 1) % LINUX_RUNS].end = h->written;
            pthread_cond_broadcast(&h->changed);
        }
    }
    const int status = take_status(h);
    pthread_mutex_unlock(&h->mutex);
    return status;
}

void linux_sender_flush(struct linux_hal *h)
{
    pthread_mutex_lock(&h->mutex);
    h->flushed = h->written;
    pthread_cond_broadcast(&h->changed);
    pthread_mutex_unlock(&h->mutex);
}

void linux_sender_wait(struct linux_hal *h)
{
    linux_sender_flush(h);
    pthread_mutex_lock(&h->mutex);
    while (h->sent != h->written) {
        pthread_cond_wait(&h->changed, &h->mutex);
    }
    pthread_mutex_unlock(&h->mutex);
}

int linux_sender_idle(struct linux_hal *h)
{
    linux_sender_wait(h);
    pthread_mutex_lock(&h->mutex);
    const int status = take_status(h);
    pthread_mutex_unlock(&h->mutex);
    return status;
}

int linux_sender_start(struct linux_hal *h)
{
    sigset_t all;
    sigset_t before;
    h->most = linux_spi_piece(SIZE_MAX, h->bufsiz);
    h->ring_bytes = 2 * h->most > RING_BYTES ? 2 * h->most : RING_BYTES;
    h->ring = malloc(h->ring_bytes + h->most);
    h->run_put = 1; /* an empty run of commands */
    if (h->ring == NULL) {
        return linux_fail(h->error, HAL_EIO, "no memory for two messages of %zu bytes; make spidev.bufsiz smaller",
                          h->most);
    }
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before); /* the program's own threads get the signals */
    const int number = pthread_create(&h->thread, NULL, sender, h);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    h->threaded = number == 0;
    return number == 0 ? HAL_OK : linux_fail(h->error, HAL_EIO, "no thread for sending: %s", strerror(number));
}

void linux_sender_stop(struct linux_hal *h)
{
    if (h->threaded) {
        linux_sender_wait(h);
        pthread_mutex_lock(&h->mutex);
        h->quit = true;
        pthread_cond_broadcast(&h->changed);
        pthread_mutex_unlock(&h->mutex);
        pthread_join(h->thread, NULL);
    }
    h->threaded = false;
    free(h->ring);
    h->ring = NULL;
}
