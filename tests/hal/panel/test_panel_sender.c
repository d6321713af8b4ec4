/* panel_sender: the sender that sends every frame whole passes on what it is asked for, and what comes back. The test
 * plays the driver. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "panel.h"

static struct panel_driver driver;
static const uint16_t pixels[4];
static int begins, ends;

int panel_frame_begin(struct panel_driver *d)
{
    assert_ptr_equal(d, &driver);
    begins++;
    return -3;
}

int panel_rows(struct panel_driver *d, const uint16_t *at, uint32_t lines)
{
    assert_ptr_equal(d, &driver);
    assert_ptr_equal(at, pixels);
    return (int)lines;
}

int panel_frame_end(struct panel_driver *d)
{
    assert_ptr_equal(d, &driver);
    ends++;
    return -5;
}

static void frames_are_those_of_the_driver(void **state)
{
    const struct panel_sender_ops *const ops = panel_sender_whole.ops;
    (void)state;
    assert_int_equal(ops->begin(panel_sender_whole.context, &driver), -3);
    assert_true(begins == 1 && ends == 0);
    assert_int_equal(ops->rows(panel_sender_whole.context, &driver, pixels, 7), 7);
    assert_int_equal(ops->end(panel_sender_whole.context, &driver), -5);
    assert_true(begins == 1 && ends == 1);
}

/* The pixels belong to the driver until it waits, and each is sent in each frame; scenes make no difference. */
static void it_neither_copies_nor_skips(void **state)
{
    const struct panel_sender_ops *const ops = panel_sender_whole.ops;
    (void)state;
    assert_true(!ops->copies && !ops->skips && ops->forget == NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_are_those_of_the_driver),
        cmocka_unit_test(it_neither_copies_nor_skips),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
