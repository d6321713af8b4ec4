/* gif_out: what giflib decodes again: size, rate, palette, pixels that stay, and colours that had to be chosen. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "files.h"
#include "gif_out.h"

#include <errno.h>
#include <gif_lib.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char path[] = "a.gif";

static GifFileType *decoded(void)
{
    int error = 0;
    GifFileType *const gif = DGifOpenFileName(path, &error);
    assert_non_null(gif);
    assert_int_equal(DGifSlurp(gif), GIF_OK);
    assert_int_equal(unlink(path), 0);
    return gif;
}

static void add(struct gif_out *gif, uint32_t width, uint32_t height, const uint8_t *rgb)
{
    uint8_t copy[3 * 64 * 64];
    memcpy(copy, rgb, (size_t)3 * width * height);
    const struct ppm picture = {width, height, copy};
    assert_int_equal(gif_out_add(gif, &picture), 0);
}

static struct gif_out *fresh(uint32_t scale)
{
    struct gif_out *gif = NULL;
    assert_int_equal(gif_out_new(&gif, path, scale), 0);
    assert_int_equal(access(path, F_OK), -1); /* frames wait without a name */
    assert_int_equal(gif_out_count(gif), 0);
    return gif;
}

/* The colour of pixel i of a frame; NULL: it stays as it was. */
static const GifColorType *colour(GifFileType *gif, int frame, int i)
{
    GraphicsControlBlock control;
    assert_int_equal(DGifSavedExtensionToGCB(gif, frame, &control), GIF_OK);
    const int entry = gif->SavedImages[frame].RasterBits[i];
    return entry == control.TransparentColor ? NULL : &gif->SavedImages[frame].ImageDesc.ColorMap->Colors[entry];
}

static void expect_colour(const GifColorType *c, const uint8_t *rgb)
{
    assert_non_null(c);
    assert_true(c->Red == rgb[0] && c->Green == rgb[1] && c->Blue == rgb[2]);
}

static const uint8_t first[18] = {1, 2, 3, 255, 254, 253, 0, 0, 0, 9, 8, 7, 1, 2, 3, 1, 3, 2};
static const uint8_t second[18] = {1, 2, 3, 0, 0, 0, 0, 0, 0, 9, 8, 7, 77, 2, 3, 1, 3, 2};

static void few_colours_are_exact_and_what_stays_is_not_sent(void **state)
{
    (void)state;
    struct gif_out *const out = fresh(1);
    add(out, 3, 2, first);
    add(out, 3, 2, second);
    assert_int_equal(gif_out_count(out), 2);
    assert_int_equal(gif_out_save(out, path), 0);
    gif_out_free(out);
    GifFileType *const gif = decoded();
    assert_true(gif->SWidth == 3 && gif->SHeight == 2 && gif->ImageCount == 2);
    for (int i = 0; i < 6; i++) {
        expect_colour(colour(gif, 0, i), first + 3 * i);
        if (memcmp(first + 3 * i, second + 3 * i, 3) == 0) {
            assert_null(colour(gif, 1, i));
        } else {
            expect_colour(colour(gif, 1, i), second + 3 * i);
        }
    }
    DGifCloseFile(gif, NULL);
}

static void frames_take_three_hundredths_and_repeat_for_ever(void **state)
{
    (void)state;
    struct gif_out *const out = fresh(1);
    add(out, 3, 2, first);
    add(out, 3, 2, second);
    assert_int_equal(gif_out_save(out, path), 0);
    gif_out_free(out);
    GifFileType *const gif = decoded();
    for (int frame = 0; frame < 2; frame++) {
        GraphicsControlBlock control;
        assert_int_equal(DGifSavedExtensionToGCB(gif, frame, &control), GIF_OK);
        assert_int_equal(control.DelayTime, 3);
        assert_int_equal(control.DisposalMode, DISPOSE_DO_NOT);
        assert_true(frame == 1 || control.TransparentColor == NO_TRANSPARENT_COLOR);
    }
    const SavedImage *const image = gif->SavedImages;
    bool loops = false;
    for (int i = 0; i + 1 < image->ExtensionBlockCount; i++) {
        const ExtensionBlock *const e = &image->ExtensionBlocks[i];
        loops = loops || (e->Function == APPLICATION_EXT_FUNC_CODE && e->ByteCount == 11 &&
                          memcmp(e->Bytes, "NETSCAPE2.0", 11) == 0 && e[1].ByteCount == 3 &&
                          memcmp(e[1].Bytes, "\1\0\0", 3) == 0);
    }
    assert_true(loops);
    DGifCloseFile(gif, NULL);
}

static void a_pixel_becomes_a_square(void **state)
{
    (void)state;
    struct gif_out *const out = fresh(4);
    add(out, 3, 2, first);
    assert_int_equal(gif_out_save(out, path), 0);
    gif_out_free(out);
    GifFileType *const gif = decoded();
    assert_true(gif->SWidth == 12 && gif->SHeight == 8);
    for (int i = 0; i < 12 * 8; i++) {
        expect_colour(colour(gif, 0, i), first + 3 * (i / 12 / 4 * 3 + i % 12 / 4));
    }
    DGifCloseFile(gif, NULL);
}

/* A picture of n colours, 16 a row, which differ in every channel or in green alone. */
static void expect_exact(int n, bool green_alone, bool exact)
{
    uint8_t rgb[3 * 256];
    struct gif_out *const out = fresh(1);
    bool same = true;
    for (int i = 0; i < 256; i++) {
        const int c = i < n ? i : 0;
        rgb[3 * i] = (uint8_t)(green_alone ? 5 : 255 - c);
        rgb[3 * i + 1] = (uint8_t)(c * 7);
        rgb[3 * i + 2] = (uint8_t)(green_alone ? 6 : c);
    }
    add(out, 16, 16, rgb);
    assert_int_equal(gif_out_save(out, path), 0);
    gif_out_free(out);
    GifFileType *const gif = decoded();
    for (int i = 0; i < 256; i++) {
        const GifColorType *const c = colour(gif, 0, i);
        assert_non_null(c);
        same = same && c->Red == rgb[3 * i] && c->Green == rgb[3 * i + 1] && c->Blue == rgb[3 * i + 2];
        assert_true(abs(c->Red - rgb[3 * i]) < 32 && abs(c->Green - rgb[3 * i + 1]) < 32 &&
                    abs(c->Blue - rgb[3 * i + 2]) < 32);
    }
    assert_int_equal(same, exact);
    DGifCloseFile(gif, NULL);
}

static void colours_up_to_255_are_exact(void **state)
{
    (void)state;
    expect_exact(1, false, true);
    expect_exact(255, false, true);
    expect_exact(255, true, true);
    expect_exact(256, false, false);
}

/* 4096 shades of a flat ramp: the mean of the picture stays, and each pixel is near. */
static void many_colours_are_fitted_and_dithered(void **state)
{
    (void)state;
    static uint8_t rgb[3 * 64 * 64];
    struct gif_out *const out = fresh(1);
    long sum[3] = {0}, got[3] = {0};
    for (int i = 0; i < 64 * 64; i++) {
        rgb[3 * i] = (uint8_t)(i % 64 * 4);
        rgb[3 * i + 1] = (uint8_t)(i / 64 * 4);
        rgb[3 * i + 2] = (uint8_t)(i / 16 & 0xff);
    }
    add(out, 64, 64, rgb);
    add(out, 64, 64, rgb);
    assert_int_equal(gif_out_save(out, path), 0);
    gif_out_free(out);
    GifFileType *const gif = decoded();
    for (int i = 0; i < 64 * 64; i++) {
        const GifColorType *const c = colour(gif, 0, i);
        const int channels[3] = {c->Red, c->Green, c->Blue};
        for (int k = 0; k < 3; k++) {
            sum[k] += rgb[3 * i + k];
            got[k] += channels[k];
            assert_true(abs(channels[k] - rgb[3 * i + k]) <= 64);
        }
        assert_null(colour(gif, 1, i)); /* the dither does not flicker */
    }
    for (int k = 0; k < 3; k++) {
        assert_true(labs(sum[k] - got[k]) < 2 * 64 * 64); /* 2 of 255 */
    }
    DGifCloseFile(gif, NULL);
}

/* Noise of 64x64 pixels in 8 colours takes 1.8 KB a frame. */
static void a_long_one_keeps_ever_fewer_frames_for_their_time(void **state)
{
    static uint8_t rgb[3 * 64 * 64];
    (void)state;
    enum { FRAMES = 16000 };
    struct gif_out *const out = fresh(1);
    uint32_t random = 1, every = 1;
    for (int frame = 0; frame < FRAMES; frame++) {
        for (int i = 0; i < 3 * 64 * 64; i++) {
            random = random * 1664525 + 1013904223;
            rgb[i] = (uint8_t)(random >> 31) * 255;
        }
        add(out, 64, 64, rgb);
        assert_true(gif_out_every(out) == every || gif_out_every(out) == 2 * every);
        every = gif_out_every(out);
    }
    assert_true(gif_out_count(out) == FRAMES && every > 1);
    assert_int_equal(gif_out_save(out, path), 0);
    gif_out_free(out);
    FILE *const file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    assert_true(ftell(file) < GIF_OUT_BYTES_MOST && ftell(file) > GIF_OUT_BYTES_MOST / 2);
    fclose(file);
    GifFileType *const gif = decoded();
    long hundredths = 0;
    for (int frame = 0; frame < gif->ImageCount; frame++) {
        GraphicsControlBlock control;
        assert_int_equal(DGifSavedExtensionToGCB(gif, frame, &control), GIF_OK);
        hundredths += control.DelayTime;
    }
    assert_true(hundredths >= 3 * FRAMES && hundredths < 3 * (FRAMES + (int)every));
    DGifCloseFile(gif, NULL);
}

static void a_folder_that_is_missing_is_told(void **state)
{
    (void)state;
    struct gif_out *gif = NULL;
    assert_int_equal(gif_out_new(&gif, "none/a.gif", 1), -ENOENT);
    gif_out_free(gif);
    gif_out_free(NULL);
    assert_null(gif_out_reason);
}

int main(void)
{
    if (gif_out_reason != NULL) {
        return 77; /* no GIF is written here */
    }
    if (files_begin_inside() != 0) {
        return 1;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(few_colours_are_exact_and_what_stays_is_not_sent),
        cmocka_unit_test(frames_take_three_hundredths_and_repeat_for_ever),
        cmocka_unit_test(a_pixel_becomes_a_square),
        cmocka_unit_test(colours_up_to_255_are_exact),
        cmocka_unit_test(many_colours_are_fitted_and_dithered),
        cmocka_unit_test(a_long_one_keeps_ever_fewer_frames_for_their_time),
        cmocka_unit_test(a_folder_that_is_missing_is_told),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return files_end_empty() != 0 ? 1 : failed;
}
