/* See picture_in.h. JPEG by libjpeg, row by row. */
#include "picture_in.h"

#include <setjmp.h>
#include <stdio.h> /* jpeglib.h uses it without including it */
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>
#include <jerror.h>

const char jpeg_in_reason[] = "is a JPEG that cannot be read: it is broken, cut off or CMYK";

struct failure {
    struct jpeg_error_mgr manager; /* the library passes a pointer to this first member */
    jmp_buf to;
};

static void fail(j_common_ptr jpeg)
{
    longjmp(((struct failure *)(void *)jpeg->err)->to, 1);
}

/* Cameras leave bytes between the markers. Otherwise the library goes on after damaged data with grey pixels; here they
 * make the picture broken. */
static void take_warning(j_common_ptr jpeg, int level)
{
    if (level < 0 && jpeg->err->msg_code != JWRN_EXTRANEOUS_DATA) {
        fail(jpeg);
    }
}

static void read_rows(struct picture_in *in, j_decompress_ptr jpeg, uint8_t **row)
{
    jpeg_read_header(jpeg, TRUE);
    jpeg->out_color_space = JCS_RGB;
    jpeg->dct_method = JDCT_ISLOW;
    if (!picture_in_begin(in, jpeg->image_width, jpeg->image_height, false)) {
        fail((j_common_ptr)jpeg);
    }
    *row = malloc((size_t)jpeg->image_width * 3);
    if (*row == NULL) {
        fail((j_common_ptr)jpeg);
    }
    jpeg_start_decompress(jpeg);
    while (jpeg->output_scanline < jpeg->output_height) {
        const uint32_t y = jpeg->output_scanline;
        if (jpeg_read_scanlines(jpeg, row, 1) == 1) {
            picture_in_row(in, *row, jpeg->image_width, 0, 1, y);
        }
    }
    jpeg_finish_decompress(jpeg);
}

bool jpeg_in_memory(struct picture_in *in, const void *bytes, size_t n)
{
    struct jpeg_decompress_struct jpeg;
    struct failure failure;
    uint8_t *row = NULL, **volatile at = &row;
    volatile bool is_done = false;
    memset(&jpeg, 0, sizeof jpeg); /* so that it may be destroyed before it is whole */
    jpeg.err = jpeg_std_error(&failure.manager);
    failure.manager.error_exit = fail;
    failure.manager.emit_message = take_warning;
    if (setjmp(failure.to) == 0) {
        jpeg_create_decompress(&jpeg);
        jpeg_mem_src(&jpeg, (unsigned char *)(uintptr_t)bytes, (unsigned long)n);
        read_rows(in, &jpeg, at);
        is_done = true;
    }
    free(*at);
    jpeg_destroy_decompress(&jpeg);
    return is_done;
}
