/* hal/linux/fail: what the errors of Linux mean to a driver, and lines that are cut to their room. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "../../../hal/linux/fail.h"
#include "hal.h"

#include <errno.h>
#include <string.h>

/* By what a user can do about it: permission, busy, missing or gone, wrong request, not built in, late; else EIO. */
static void errors_have_a_status_each(void **state)
{
    static const struct {
        int number, status;
    } cases[] = {{EACCES, HAL_EACCES},   {EPERM, HAL_EACCES},  {EBUSY, HAL_EBUSY},   {ENOENT, HAL_ENODEV},
                 {ENODEV, HAL_ENODEV},   {ENXIO, HAL_ENODEV},  {EINVAL, HAL_EINVAL}, {ESHUTDOWN, HAL_ENODEV},
                 {EMSGSIZE, HAL_EINVAL}, {ENOSYS, HAL_ENOSYS}, {EIO, HAL_EIO},       {ETIMEDOUT, HAL_ETIMEDOUT},
                 {ENOMEM, HAL_EIO},      {0, HAL_EIO},         {ENOTTY, HAL_EIO},    {EAGAIN, HAL_EIO}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(linux_status(cases[i].number), cases[i].status);
        assert_true(cases[i].status < 0);
    }
}

static void a_line_is_cut_to_its_room(void **state)
{
    char error[LINUX_ERROR_SIZE + 1];
    (void)state;
    memset(error, 'x', sizeof error);
    assert_int_equal(linux_fail(error, HAL_EBUSY, "%s of %u", "three", 4), HAL_EBUSY);
    assert_string_equal(error, "three of 4");
    assert_int_equal(linux_fail(error, -7, "%0500d", 1), -7);
    assert_int_equal(strlen(error), LINUX_ERROR_SIZE - 1);
    assert_int_equal(error[LINUX_ERROR_SIZE], 'x');
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_have_a_status_each),
        cmocka_unit_test(a_line_is_cut_to_its_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
