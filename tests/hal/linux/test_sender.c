/* hal/linux/sender: which messages the thread makes of what is written, and the level of D/C in each. ioctl and the
 * line are played by the test. */
#define _POSIX_C_SOURCE 200809L /* nanosleep */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "../../../hal/linux/gpio_lines.h"
#include "../../../hal/linux/sender.h"

#include <errno.h>
#include <linux/spi/spidev.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>

enum { MESSAGE = 16, LONG = 200000 };

static struct linux_hal hal;
static uint8_t sent[LONG + MESSAGE];
static size_t sent_bytes;
static char log_text[400]; /* of the messages: level of D/C and bytes, "C1 D4 " */
static bool level, keeps_log;
static int moves, fails_at, line_refusal; /* fails_at: a message, below 0: none */

int linux_gpio_set(struct linux_line *line, bool to)
{
    assert_ptr_equal(line, &hal.dc);
    moves++;
    level = to;
    return line_refusal;
}

int ioctl(int descriptor, unsigned long request, ...)
{
    va_list arguments;
    va_start(arguments, request);
    const struct spi_ioc_transfer *const t = va_arg(arguments, const struct spi_ioc_transfer *);
    va_end(arguments);
    if (descriptor != 7 || request != SPI_IOC_MESSAGE(1) || fails_at-- == 0) {
        errno = ETIMEDOUT;
        return -1;
    }
    if (!keeps_log && sent_bytes == 5) {
        nanosleep(&(struct timespec){0, 50000000}, NULL); /* the ring becomes full meanwhile */
    }
    if (sent_bytes + t->len <= sizeof sent) {
        memcpy(sent + sent_bytes, (const void *)(uintptr_t)t->tx_buf, t->len);
    }
    sent_bytes += t->len;
    const size_t used = strlen(log_text);
    if (keeps_log) {
        snprintf(log_text + used, sizeof log_text - used, "%c%u ", level ? 'D' : 'C', (unsigned)t->len);
    }
    return (int)t->len;
}

static int start(void **state)
{
    (void)state;
    hal = (struct linux_hal){.spi = {"x", 7, 1000000000},
                             .bufsiz = MESSAGE + 3,
                             .dc_now = HAL_COMMAND,
                             .mutex = PTHREAD_MUTEX_INITIALIZER,
                             .changed = PTHREAD_COND_INITIALIZER};
    sent_bytes = 0;
    log_text[0] = '\0';
    level = false, keeps_log = true;
    moves = line_refusal = 0, fails_at = -1;
    const int status = linux_sender_start(&hal);
    sigset_t blocked;
    pthread_sigmask(SIG_SETMASK, NULL, &blocked);
    return status != 0 || sigismember(&blocked, SIGINT); /* signals still come to this thread */
}

static int stop(void **state)
{
    (void)state;
    linux_sender_stop(&hal);
    return hal.ring != NULL || hal.threaded;
}

static void put(enum hal_dc dc, size_t n)
{
    static const uint8_t bytes[64] = {1, 2, 3};
    assert_int_equal(linux_sender_write(&hal, dc, bytes, n), HAL_OK);
}

static void a_run_goes_out_in_the_longest_messages(void **state)
{
    (void)state;
    put(HAL_COMMAND, 1);
    put(HAL_DATA, 4);
    put(HAL_COMMAND, 1);
    put(HAL_DATA, 40);
    put(HAL_COMMAND, 2);
    assert_int_equal(linux_sender_idle(&hal), HAL_OK);
    assert_string_equal(log_text, "C1 D4 C1 D16 D16 D8 C2 ");
    assert_int_equal(moves, 4); /* it began at the command's level */
    assert_true(hal.best_bytes == MESSAGE && hal.best_ns > 0 && hal.write_ns > 0);
}

/* What is too short for a message waits for more. */
static void pieces_share_messages_until_they_are_flushed(void **state)
{
    const struct timespec pause = {0, 5000000};
    (void)state;
    for (int i = 0; i < 5; i++) {
        put(HAL_DATA, 3);
    }
    nanosleep(&pause, NULL);
    assert_int_equal(sent_bytes, 0);
    linux_sender_flush(&hal);
    linux_sender_wait(&hal);
    assert_string_equal(log_text, "D15 ");
    put(HAL_DATA, 15);
    put(HAL_DATA, 4);
    nanosleep(&pause, NULL);
    linux_sender_wait(&hal);
    assert_string_equal(log_text, "D15 D16 D3 ");
}

static void bytes_keep_their_order_round_the_ring(void **state)
{
    static uint8_t bytes[LONG];
    (void)state;
    keeps_log = false;
    put(HAL_COMMAND, 5); /* so that messages go round the end */
    for (size_t i = 0; i < LONG; i++) {
        bytes[i] = (uint8_t)(i * 2654435761U >> 11);
    }
    for (size_t i = 0, n = 1; i < LONG; i += n, n = n % 777 + 13) {
        n = n < LONG - i ? n : LONG - i;
        assert_int_equal(linux_sender_write(&hal, HAL_DATA, bytes + i, n), HAL_OK);
    }
    assert_int_equal(linux_sender_idle(&hal), HAL_OK);
    assert_int_equal(sent_bytes, 5 + LONG);
    assert_memory_equal(sent + 5, bytes, LONG);
    for (size_t i = 0; i < 1000; i++) { /* more runs than there is room for */
        assert_int_equal(linux_sender_write(&hal, i % 2 == 0 ? HAL_COMMAND : HAL_DATA, bytes + i, 1), HAL_OK);
    }
    sent_bytes = 0;
    linux_sender_wait(&hal);
}

static void an_error_is_returned_once_and_the_rest_is_dropped(void **state)
{
    (void)state;
    fails_at = 1;
    put(HAL_DATA, 16);
    linux_sender_wait(&hal);
    put(HAL_DATA, 16);
    linux_sender_wait(&hal);
    assert_int_equal(linux_sender_idle(&hal), HAL_ETIMEDOUT);
    assert_non_null(strstr(hal.error, "x: sending 16 bytes at 1000000000 Hz failed"));
    assert_int_equal(linux_sender_idle(&hal), HAL_OK);
    put(HAL_COMMAND, 2);
    assert_int_equal(linux_sender_idle(&hal), HAL_OK);
    assert_string_equal(log_text, "D16 C2 ");
}

static void d_c_moves_only_when_it_changes(void **state)
{
    (void)state;
    assert_int_equal(linux_sender_dc(&hal, HAL_COMMAND), HAL_OK);
    assert_int_equal(moves, 0);
    assert_int_equal(linux_sender_dc(&hal, HAL_DATA), HAL_OK);
    assert_true(moves == 1 && level && hal.dc_now == HAL_DATA);
    hal.dc.active_low = true;
    assert_int_equal(linux_sender_dc(&hal, HAL_COMMAND), HAL_OK);
    assert_true(moves == 2 && level);
    line_refusal = -EPERM;
    assert_int_equal(linux_sender_dc(&hal, HAL_DATA), HAL_EACCES);
    assert_string_equal(hal.error, "the D/C line cannot be set: Operation not permitted");
    line_refusal = 0;
    assert_int_equal(linux_sender_dc(&hal, HAL_COMMAND), HAL_OK); /* where it stands is not known */
    assert_int_equal(moves, 4);
}

/* A new write counts 1/16, and at most 20 ms. */
static void the_mean_follows_the_last_writes(void **state)
{
    static const struct {
        uint32_t mean;
        uint64_t took;
        uint32_t next;
    } cases[] = {{0, 5000, 5000},           {1600, 3200, 1700},           {3200, 1600, 3100},
                 {1600, 20000001, 1251500}, {0, 1000000000000, 20000000}, {1600, 1600, 1600}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(linux_write_mean(cases[i].mean, cases[i].took), cases[i].next);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_run_goes_out_in_the_longest_messages, start, stop),
        cmocka_unit_test_setup_teardown(pieces_share_messages_until_they_are_flushed, start, stop),
        cmocka_unit_test_setup_teardown(bytes_keep_their_order_round_the_ring, start, stop),
        cmocka_unit_test_setup_teardown(an_error_is_returned_once_and_the_rest_is_dropped, start, stop),
        cmocka_unit_test_setup_teardown(d_c_moves_only_when_it_changes, start, stop),
        cmocka_unit_test(the_mean_follows_the_last_writes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
