/* See picture_in.h. PNG by libpng, row by row. */
#include "picture_in.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

const char png_in_reason[] = "is a PNG that cannot be read: it is broken or cut off";

struct source {
    const uint8_t *bytes;
    size_t left;
    uint8_t *row;
};

static void read_bytes(png_structp png, png_bytep to, size_t n)
{
    struct source *from = png_get_io_ptr(png);
    if (n > from->left) {
        png_error(png, "too short");
    }
    memcpy(to, from->bytes, n);
    from->bytes += n;
    from->left -= n;
}

static void say_nothing(png_structp png, png_const_charp text)
{
    (void)png;
    (void)text;
}

static void fail(png_structp png, png_const_charp text)
{
    (void)text;
    png_longjmp(png, 1);
}

/* Leaves through png_error, to the caller's setjmp. An interlaced picture comes in 7 passes of some pixels each. */
static void read_rows(struct picture_in *in, struct source *from, png_structp png, png_infop info)
{
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX); /* ours is asked next, and has a line of its own */
    png_read_info(png, info);
    if (!picture_in_size(in, png_get_image_width(png, info), png_get_image_height(png, info))) {
        png_error(png, "too large");
    }
    png_set_expand(png);
    png_set_scale_16(png);
    png_set_gray_to_rgb(png);
    png_read_update_info(png, info);
    const uint32_t width = png_get_image_width(png, info), height = png_get_image_height(png, info);
    const bool is_interlaced = png_get_interlace_type(png, info) != PNG_INTERLACE_NONE;
    const bool has_alpha = (png_get_color_type(png, info) & PNG_COLOR_MASK_ALPHA) != 0;
    from->row = picture_in_begin(in, width, height, has_alpha) ? malloc(png_get_rowbytes(png, info) + 1) : NULL;
    if (from->row == NULL) {
        png_error(png, "too large");
    }
    for (uint32_t y = 0; y < height && !is_interlaced; y++) {
        png_read_row(png, from->row, NULL);
        picture_in_row(in, from->row, width, 0, 1, y);
    }
    for (int pass = 0; pass < PNG_INTERLACE_ADAM7_PASSES && is_interlaced; pass++) {
        const uint32_t n = PNG_PASS_COLS(width, pass), rows = n > 0 ? PNG_PASS_ROWS(height, pass) : 0;
        for (uint32_t y = 0; y < rows; y++) {
            png_read_row(png, from->row, NULL);
            picture_in_row(in, from->row, n, PNG_PASS_START_COL(pass), PNG_PASS_COL_OFFSET(pass),
                           PNG_ROW_FROM_PASS_ROW(y, pass));
        }
    }
}

bool png_in_memory(struct picture_in *in, const void *bytes, size_t n)
{
    struct source from = {bytes, n, NULL};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, fail, say_nothing);
    png_infop info = png != NULL ? png_create_info_struct(png) : NULL;
    volatile bool is_done = false;
    if (info != NULL && setjmp(png_jmpbuf(png)) == 0) {
        png_set_read_fn(png, &from, read_bytes);
        read_rows(in, &from, png, info);
        is_done = true;
    }
    free(from.row);
    png_destroy_read_struct(&png, &info, NULL);
    return is_done;
}
