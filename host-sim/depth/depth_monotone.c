/* monotone: the code at every Q16.16 distance from near to far, through the renderer's vertex, set-up and span code. */
#include "complain.h"
#include "depth_lab.h"
#include "lab_num.h"
#include "lab_probe.h"
#include "progress.h"

#include <stdlib.h>

struct counts {
    uint64_t distances;
    uint32_t codes, rises; /* changes of the code; those that go the wrong way */
    uint32_t longest;      /* plateau, in distances */
};

static struct counts count_codes(struct lab_probe *probe, const struct depth_lab *lab)
{
    struct counts found = {(uint64_t)lab->far_z - lab->near_z + 1, 1, 0, 0};
    uint32_t before = lab_code(probe, lab->near_z), plateau = 0;
    const uint32_t first = (uint32_t)lab->near_z, last = (uint32_t)lab->far_z;
    for (uint32_t w = first; w <= last; w++) {
        const uint32_t code = lab_code(probe, (fx_t)w);
        found.codes += code != before;
        found.rises += code > before;
        plateau = code != before ? 1 : plateau + 1;
        found.longest = plateau > found.longest ? plateau : found.longest;
        before = code;
        if ((w & 0xfffff) == 0) {
            progress_show(probe->format->name, w - first, found.distances);
        }
    }
    progress_show(probe->format->name, 1, 1);
    return found;
}

static void put_row(const struct depth_lab *lab, const struct lab_format *format, struct counts found)
{
    char near_text[LAB_TEXT_SIZE], far_text[LAB_TEXT_SIZE], longest[LAB_TEXT_SIZE];
    lab_fx_text(lab->near_z, near_text);
    lab_fx_text(lab->far_z, far_text);
    lab_length_text(found.longest, longest);
    fprintf(lab->rows, "%s,%d,%s,%s,%llu,%lu,%lu,%s,%s\n", format->name, format->bits, near_text, far_text,
            (unsigned long long)found.distances, (unsigned long)found.codes, (unsigned long)found.rises, longest,
            found.rises == 0 ? "pass" : "fail");
}

int depth_monotone(const struct depth_lab *lab)
{
    struct lab_probe *probe = malloc(sizeof *probe);
    if (probe == NULL) {
        return complain("out of memory");
    }
    uint32_t failed = 0;
    int status = 0;
    fputs("format,bits,near,far,distances,codes,rises,longest_m,verdict\n", lab->rows);
    for (uint32_t i = 0; i < lab_format_count && status == 0; i++) {
        const struct lab_format *format = &lab_formats[i];
        if ((lab->formats >> i & 1) == 0) {
            continue;
        }
        status = lab_probe_open(probe, format, lab->near_z, lab->far_z);
        if (status != 0) {
            status = complain("%s: the renderer refuses this camera (error %d)", format->name, status);
            break;
        }
        const struct counts found = count_codes(probe, lab);
        put_row(lab, format, found);
        failed += lab_is_monotone(format) && found.rises > 0; /* a format of others may fail, and does */
    }
    free(probe);
    return status != 0 || failed == 0 ? status : complain("a format of the renderer is not monotone: see `fail`");
}
