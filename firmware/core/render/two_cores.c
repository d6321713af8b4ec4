/* What a renderer with two cores links. See cores.h. */
#include "bands.h"
#include "cores.h"
#include "mesh.h"

const struct ph_cores ph_two_cores = {
    .each_both = ph_each_both, .cull_both = ph_cull_both, .draw_chunk = ph_draw_chunk};
