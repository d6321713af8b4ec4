/*
 * Changed key scripts and lists of CRCs into their readers: each is taken, or refused by one line.
 *
 *   fuzz_text [quick | long | INPUTS [SEED]]
 */
#include "complain.h"
#include "frame_check.h"
#include "fuzz.h"
#include "key_script.h"

#include <stdio.h>
#include <string.h>

enum { ROOM = 2048 };

static const char keys_text[] =
    "# a walk\n0 up\n10 up+left 5\n3\tselect\t1000000000   # long\n\n1000000000 down+right+up 7\n";
static const char crcs_text[] =
    "frame 0 crc32 1234ABCD\nnoise\nframe 7 crc32 0\n{\"frame\": 3, \"crc32\": \"89abcdef\"}\n"
    "frame 4294967295 crc32 FFFFFFFF\nframe 12345678901 crc32 123456789\n";

static bool read_keys(const char *path)
{
    struct key_script keys;
    const int status = key_script_read(&keys, path);
    for (uint32_t i = 0; i < 4 && status == 0; i++) {
        if ((key_script_at(&keys, fuzz_number()) & ~0x1fu) != 0) {
            fuzz_fail("a button that is none");
        }
    }
    key_script_free(&keys);
    return status == 0;
}

static bool read_crcs(const char *path)
{
    struct frame_check check = {.reference = path};
    const int status = frame_check_open(&check, fuzz_number());
    if (status == 0 && (check.crcs == NULL || check.crc_count == 0)) {
        fuzz_fail("a list without CRCs was taken");
    }
    frame_check_close(&check, status);
    return status == 0;
}

static bool one(void)
{
    char text[ROOM];
    const bool is_keys = fuzz_below(2) != 0;
    const char *const from = is_keys ? keys_text : crcs_text;
    size_t n = strlen(from);
    memcpy(text, from, n);
    n = fuzz_change_text(text, n, ROOM);
    const char *const path = fuzz_file(text, n);
    const bool is_taken = (is_keys ? read_keys : read_crcs)(path);
    fuzz_said(is_taken);
    return is_taken;
}

int main(int argc, char **argv)
{
    return fuzz_main(&(struct fuzz){"fuzz_text", 40000, 2000000, one}, argc, argv);
}
