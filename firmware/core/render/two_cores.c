/* What a renderer with two cores links. See cores.h. */
#include "band_rest.h"
#include "cores.h"
#include "mesh.h"
#include "transform.h"

const struct ph_cores ph_two_cores = {.transform_both = ph_transform_both,
                                      .each_both = ph_each_both,
                                      .cull_both = ph_cull_both,
                                      .is_idle = ph_other_core_is_idle,
                                      .draw_chunk = ph_draw_chunk};
