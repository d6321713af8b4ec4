/* See depth_lab.h. */
#define _XOPEN_SOURCE 700 /* open_memstream */

#include "depth_lab.h"

#include "complain.h"
#include "progress.h"

const struct ph_shading *const depth_shadings[DEPTH_SHADINGS] = {PH_SHADE_UNLIT, PH_SHADE_FLAT, PH_SHADE_GOURAUD,
                                                                 PH_SHADE_TEXTURE, PH_SHADE_TEXTURE_LIT};
const char *const depth_shading_names[DEPTH_SHADINGS] = {"unlit", "flat", "gouraud", "texture", "texture-lit"};

int depth_lab_projection(const struct depth_lab *lab, struct ph_projection *projection)
{
    return ph_projection_perspective(projection, lab->fov_deg, (fx_t)(((uint32_t)lab->width << 16) / lab->height),
                                     lab->near_z, lab->far_z);
}

struct depth_lab depth_lab_of(const struct depth_lab *lab, uint32_t row)
{
    struct depth_lab own = *lab;
    own.exponent = lab_formats[row].exponent;
    return own;
}

void depth_lab_progress(const char *what, uint32_t formats, uint32_t i)
{
    uint32_t done = 0, total = 0;
    for (uint32_t k = 0; k < lab_format_count; k++) {
        const uint32_t is_asked = formats >> k & 1;
        total += is_asked;
        done += k < i ? is_asked : 0;
    }
    if (done < total) {
        progress_show(what, done, total);
    }
}

int depth_lab_capture(const struct depth_lab *lab, int (*run)(const struct depth_lab *), char **csv)
{
    size_t length;
    struct depth_lab copy = *lab;
    *csv = NULL;
    copy.rows = open_memstream(csv, &length);
    if (copy.rows == NULL) {
        return complain("out of memory");
    }
    const int status = run(&copy);
    if (fclose(copy.rows) != 0 && status == 0) {
        return complain("out of memory");
    }
    return status;
}
