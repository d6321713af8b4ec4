/* flash_boot: the packets of each command as the datasheets print them (RP2040, section 2.8.5.4; RP2350, section
 * 5.6.4), their order, and what follows a refusal. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "flash_boot.h"
#include "flash_image.h"

#include <stdio.h>
#include <string.h>

/* What was called: o, i with the count of bytes, s(tatus), r(eset). The call number `fails`, from 1, and the `more`
 * calls after it return `error`. */
static struct {
    char calls[300];
    uint8_t commands[8][32];
    unsigned command_count, call_count, fails, more;
    int error;
} link_side;

static int note(const char *what, size_t n)
{
    const size_t used = strlen(link_side.calls);
    snprintf(link_side.calls + used, sizeof link_side.calls - used, *what == 's' || *what == 'r' ? "%s " : "%s%zu ",
             what, n);
    const unsigned call = ++link_side.call_count;
    return link_side.fails != 0 && call >= link_side.fails && call <= link_side.fails + link_side.more ? link_side.error
                                                                                                       : 0;
}

static int out(void *context, const void *bytes, size_t n)
{
    assert_ptr_equal(context, &link_side);
    if (n == 32 && link_side.command_count < 8) {
        memcpy(link_side.commands[link_side.command_count++], bytes, 32);
    }
    return note("o", n);
}

static int in(void *context, void *bytes, size_t n)
{
    assert_ptr_equal(context, &link_side);
    memset(bytes, 0xa5, n);
    return note("i", n);
}

static int status(void *context, uint8_t answer[16])
{
    assert_ptr_equal(context, &link_side);
    answer[4] = 5; /* after the token: bad alignment */
    return note("s", 0);
}

static int reset(void *context)
{
    assert_ptr_equal(context, &link_side);
    return note("r", 0);
}

static const struct flash_link_ops ops = {out, in, status, reset};

static struct flash_boot fresh(unsigned fails, unsigned more, int error)
{
    memset(&link_side, 0, sizeof link_side);
    link_side.fails = fails;
    link_side.more = more;
    link_side.error = error;
    return (struct flash_boot){.ops = &ops, .context = &link_side};
}

/* Command i: magic, token i + 1, identity, bytes of arguments, bytes of data, arguments; little-endian. */
static void expect_command(unsigned i, uint8_t id, uint8_t bytes, uint32_t n, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t words[8] = {0x431fd10b, i + 1, id | (uint32_t)bytes << 8, n, a, b, c, 0};
    assert_true(i < link_side.command_count);
    for (unsigned k = 0; k < 32; k++) {
        assert_int_equal(link_side.commands[i][k], words[k / 4] >> 8 * (k % 4) & 0xff);
    }
}

static void the_board_is_taken_and_leaves_xip(void **state)
{
    (void)state;
    struct flash_boot boot = fresh(0, 0, 0);
    assert_int_equal(flash_boot_begin(&boot), 0);
    assert_string_equal(link_side.calls, "r o32 i0 o32 i0 ");
    expect_command(0, 0x01, 1, 0, 1, 0, 0);
    expect_command(1, 0x06, 0, 0, 0, 0, 0);
    boot = fresh(1, 0, HAL_EIO);
    assert_int_equal(flash_boot_begin(&boot), HAL_EIO);
    assert_string_equal(link_side.calls, "r ");
    boot = fresh(2, 0, HAL_EIO);
    assert_int_equal(flash_boot_begin(&boot), HAL_EIO);
    assert_string_equal(link_side.calls, "r o32 ");
    boot = fresh(0, 0, 0);
    flash_boot_end(&boot);
    assert_string_equal(link_side.calls, "r ");
}

static void data_go_between_the_command_and_an_empty_packet(void **state)
{
    (void)state;
    uint8_t bytes[512] = {0};
    struct flash_boot boot = fresh(0, 0, 0);
    assert_int_equal(flash_boot_erase(&boot, 0x10203000), 0);
    assert_int_equal(flash_boot_write(&boot, 0x10203100, bytes, 256), 0);
    assert_int_equal(flash_boot_read(&boot, 0x10000200, bytes, 512), 0);
    assert_string_equal(link_side.calls, "o32 i0 o32 o256 i0 o32 i512 o0 ");
    expect_command(0, 0x03, 8, 0, 0x10203000, 4096, 0);
    expect_command(1, 0x05, 8, 256, 0x10203100, 256, 0);
    expect_command(2, 0x84, 8, 512, 0x10000200, 512, 0);
    assert_int_equal(bytes[511], 0xa5);
}

static void each_chip_has_its_own_reboot(void **state)
{
    (void)state;
    struct flash_boot boot = fresh(0, 0, 0);
    assert_int_equal(flash_boot_reboot(&boot), 0);
    expect_command(0, 0x02, 12, 0, 0, 0, 100);
    boot = fresh(0, 0, 0);
    boot.is_rp2350 = true;
    assert_int_equal(flash_boot_reboot(&boot), 0);
    expect_command(0, 0x0a, 16, 0, 0, 100, 0);
}

/* A board that reboots may leave before its empty packet: that is no error, but only there. */
static void a_board_that_reboots_may_leave(void **state)
{
    (void)state;
    static const int errors[] = {HAL_ENODEV, HAL_EIO, HAL_ETIMEDOUT};
    for (int i = 0; i < 3; i++) {
        for (int rp2350 = 0; rp2350 < 2; rp2350++) {
            struct flash_boot boot = fresh(2, 0, errors[i]);
            boot.is_rp2350 = rp2350;
            assert_int_equal(flash_boot_reboot(&boot), i < 2 ? 0 : HAL_ETIMEDOUT);
        }
        struct flash_boot boot = fresh(1, 0, errors[i]);
        assert_int_equal(flash_boot_reboot(&boot), errors[i]);
        boot = fresh(2, 0, errors[i]);
        assert_int_equal(flash_boot_erase(&boot, 0x10000000), errors[i]);
    }
}

static void an_error_ends_a_command_at_once(void **state)
{
    (void)state;
    uint8_t bytes[256] = {0};
    static const char *const written[] = {"o32 ", "o32 o256 ", "o32 o256 i0 "}, *const read[] = {"o32 ", "o32 i256 ",
                                                                                                 "o32 i256 o0 "};
    for (unsigned i = 0; i < 3; i++) {
        struct flash_boot boot = fresh(i + 1, 0, HAL_ETIMEDOUT);
        assert_int_equal(flash_boot_write(&boot, 0x10000000, bytes, 256), HAL_ETIMEDOUT);
        assert_string_equal(link_side.calls, written[i]);
        boot = fresh(i + 1, 0, HAL_ETIMEDOUT);
        assert_int_equal(flash_boot_read(&boot, 0x10000000, bytes, 256), HAL_ETIMEDOUT);
        assert_string_equal(link_side.calls, read[i]);
    }
}

static void a_refused_command_is_repeated_once(void **state)
{
    (void)state;
    struct flash_boot boot = fresh(1, 0, FLASH_STALL);
    assert_int_equal(flash_boot_erase(&boot, 0x10001000), 0);
    assert_string_equal(link_side.calls, "o32 s r o32 i0 o32 i0 ");
    expect_command(0, 0x03, 8, 0, 0x10001000, 4096, 0);
    expect_command(1, 0x01, 1, 0, 1, 0, 0);
    expect_command(2, 0x03, 8, 0, 0x10001000, 4096, 0);
    assert_int_equal(boot.refusal, 5);
    boot = fresh(1, 100, FLASH_STALL); /* all that follows */
    assert_int_equal(flash_boot_erase(&boot, 0x10001000), FLASH_STALL);
    boot = fresh(2, 1, HAL_ENODEV); /* no refusal: not repeated */
    assert_int_equal(flash_boot_erase(&boot, 0x10001000), HAL_ENODEV);
    assert_string_equal(link_side.calls, "o32 i0 ");
}

/* How many erase commands are still to be refused. */
static unsigned refusals_left;

static int out_refusing(void *context, const void *bytes, size_t n)
{
    const int done = out(context, bytes, n);
    const uint8_t id = n == 32 ? ((const uint8_t *)bytes)[8] : 0;
    if (id == 3 && refusals_left > 0) {
        refusals_left--;
        return FLASH_STALL;
    }
    return done;
}

static int reset_that_fails(void *context)
{
    reset(context);
    return HAL_EIO;
}

static void a_second_refusal_is_told_and_the_board_is_ready_again(void **state)
{
    (void)state;
    struct flash_link_ops refusing = {out_refusing, in, status, reset};
    struct flash_boot boot = fresh(0, 0, 0);
    boot.ops = &refusing;
    refusals_left = 2;
    assert_int_equal(flash_boot_erase(&boot, 0x10001000), FLASH_STALL);
    assert_string_equal(link_side.calls, "o32 s r o32 i0 o32 s r o32 i0 ");
    assert_string_equal(flash_boot_refusal(&boot), "bad alignment");
    refusing.reset = reset_that_fails;
    boot = fresh(0, 0, 0);
    boot.ops = &refusing;
    refusals_left = 1;
    assert_int_equal(flash_boot_erase(&boot, 0x10001000), HAL_EIO);
    assert_string_equal(link_side.calls, "o32 s r ");
    boot = fresh(2, 0, HAL_ETIMEDOUT); /* the status */
    boot.ops = &refusing;
    refusals_left = 1;
    assert_int_equal(flash_boot_erase(&boot, 0x10001000), HAL_ETIMEDOUT);
    assert_string_equal(link_side.calls, "o32 s ");
}

/* PICOBOOT's status codes; the last one is for those that no datasheet has. */
static void refusals_have_names(void **state)
{
    (void)state;
    static const struct {
        uint32_t code;
        const char *name;
    } names[] = {{0, "no reason given"},  {1, "unknown command"},         {4, "bad address"},
                 {5, "bad alignment"},    {10, "not permitted"},          {11, "unknown refusal"},
                 {12, "unknown refusal"}, {UINT32_MAX, "unknown refusal"}};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const struct flash_boot boot = {.refusal = names[i].code};
        assert_string_equal(flash_boot_refusal(&boot), names[i].name);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_board_is_taken_and_leaves_xip),
        cmocka_unit_test(data_go_between_the_command_and_an_empty_packet),
        cmocka_unit_test(each_chip_has_its_own_reboot),
        cmocka_unit_test(a_board_that_reboots_may_leave),
        cmocka_unit_test(an_error_ends_a_command_at_once),
        cmocka_unit_test(a_refused_command_is_repeated_once),
        cmocka_unit_test(a_second_refusal_is_told_and_the_board_is_ready_again),
        cmocka_unit_test(refusals_have_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
