/* ppm: files as the PPM format describes them (netpbm, P6), written by hand. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "files.h"
#include "ppm.h"
#include "status.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char path[] = "a.ppm";

static int load(const void *bytes, size_t n, uint32_t most, struct ppm *picture)
{
    memset(picture, 0, sizeof *picture);
    file_bytes(path, bytes, n);
    const int status = ppm_load(path, most, picture);
    assert_int_equal(unlink(path), 0);
    return status;
}

/* A 2x1 picture of the bytes "abcdef" with this header. */
static void expect_header(const char *header, int status)
{
    char bytes[100];
    struct ppm picture;
    const int n = snprintf(bytes, sizeof bytes, "%sabcdef", header);
    assert_int_equal(load(bytes, (size_t)n, 2, &picture), status);
    if (status == 0) {
        assert_true(picture.width == 2 && picture.height == 1);
        assert_memory_equal(picture.rgb, "abcdef", 6);
        free(picture.rgb);
    }
}

static void a_header_has_white_space_and_comments(void **state)
{
    (void)state;
    static const char *const good[] = {"P6\n2 1\n255\n",
                                       "P6 2 1 255 ",
                                       "P6\r2 1 255 ",
                                       "P6\t2\r\n1\t255\t",
                                       "P62 1 255\r",
                                       "P6\n# x\n2 1\n255\n",
                                       "P6\n#\n#2 3\n  2 # two\n1\n#\n255\n",
                                       "P6\n02 001\n255\n"};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        expect_header(good[i], 0);
    }
    static const char *const wrong[] = {"",
                                        "P5\n2 1\n255\n",
                                        "p6\n2 1\n255\n",
                                        "P6\n2\n255\n",
                                        "P6\n0 1\n255\n",
                                        "P6\n2 0\n255\n",
                                        "P6\n2 1\n254\n",
                                        "P6\n2 1\n256\n",
                                        "P6\n2 1\n65535\n",
                                        "P6\n2 -1\n255\n",
                                        "P6\n2x1\n255\n",
                                        "P6\n2 1\n255#",
                                        "P6\n2 1\n255",
                                        "P6\n2,1\n255\n",
                                        "P6\n16385 1\n255\n",
                                        "P6\n1 16385\n255\n",
                                        "P6\n2 1\n\v255\n",
                                        "P6\n99999999999999999998 1\n255\n",
                                        "P6\n4294967298 1\n255\n",
                                        "P6\n# 2 1 255 ",
                                        "P6\n2 1\n0\n"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        expect_header(wrong[i], PH_ERR_INVAL);
    }
}

static void a_picture_that_is_cut_off_is_none(void **state)
{
    (void)state;
    struct ppm picture;
    assert_int_equal(load("P6\n2 1\n255\nabcde", 16, 2, &picture), PH_ERR_INVAL);
    assert_int_equal(load("P", 1, 2, &picture), PH_ERR_INVAL);
    assert_int_equal(load("", 0, 2, &picture), PH_ERR_INVAL);
    assert_int_equal(load("P6\n1 1\n255\nabcde", 16, 2, &picture), 0); /* the first of several */
    assert_memory_equal(picture.rgb, "abc", 3);
    free(picture.rgb);
}

static void a_large_picture_is_refused_with_its_size(void **state)
{
    (void)state;
    struct ppm picture;
    assert_int_equal(load("P6\n2 3\n255\nabcdefghijklmnopqr", 29, 5, &picture), PH_ERR_NOMEM);
    assert_true(picture.width == 2 && picture.height == 3 && picture.rgb == NULL);
    assert_int_equal(load("P6\n2 3\n255\nabcdefghijklmnopqr", 29, 6, &picture), 0);
    assert_memory_equal(picture.rgb, "abcdefghijklmnopqr", 18);
    free(picture.rgb);
    assert_int_equal(load("P6\n16384 16384\n255\n", 19, 1u << 27, &picture), PH_ERR_NOMEM);
    assert_true(picture.width == 16384 && picture.height == 16384);
    assert_int_equal(ppm_load("none.ppm", 5, &picture), -ENOENT);
}

static void rows_are_written_from_the_top(void **state)
{
    (void)state;
    uint8_t rgb[] = "abcdefghijklmnopqr";
    const struct ppm picture = {3, 2, rgb};
    char text[64] = "";
    assert_int_equal(ppm_save(path, &picture), 0);
    FILE *file = fopen(path, "r+b");
    assert_non_null(file);
    assert_int_equal(fread(text, 1, sizeof text, file), 29);
    assert_memory_equal(text, "P6\n3 2\n255\nabcdefghijklmnopqr", 29);
    const struct ppm second = {1, 1, rgb + 3};
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    assert_int_equal(ppm_write(file, &second), 0);
    FILE *const again = fopen(path, "rb"); /* it was flushed */
    assert_non_null(again);
    assert_int_equal(fread(text, 1, sizeof text, again), 43);
    assert_memory_equal(text + 29, "P6\n1 1\n255\ndef", 14);
    fclose(again);
    fclose(file);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(ppm_save("none/a.ppm", &picture), -ENOENT);
}

static void a_full_disk_is_told(void **state)
{
    (void)state;
    uint8_t rgb[3] = {0};
    const struct ppm picture = {1, 1, rgb};
    FILE *const full = fopen("/dev/full", "wb"); /* a stream: nothing renames it */
    assert_non_null(full);
    assert_int_equal(ppm_write(full, &picture), -ENOSPC);
    fclose(full);
}

int main(void)
{
    if (files_begin_inside() != 0) {
        return 1;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_header_has_white_space_and_comments),
        cmocka_unit_test(a_picture_that_is_cut_off_is_none),
        cmocka_unit_test(a_large_picture_is_refused_with_its_size),
        cmocka_unit_test(rows_are_written_from_the_top),
        cmocka_unit_test(a_full_disk_is_told),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return files_end_empty() != 0 ? 1 : failed;
}
