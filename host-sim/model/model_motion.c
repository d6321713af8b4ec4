#include "model.h"

#include <string.h>

bool model_play(struct model *model, const char *name)
{
    struct model_motion *const m = model->motion;
    for (uint32_t i = 0; m != NULL && i < m->clip_count; i++) {
        if (strcmp(m->clips[i].name, name) == 0) {
            m->clip = &m->clips[i];
            return true;
        }
    }
    return false;
}

void model_move(const struct model *model, uint32_t frame)
{
    const struct model_motion *const m = model->motion;
    if (m == NULL) {
        return;
    }
    ph_rig_rest(&m->rig, m->pose);
    memcpy(m->weights, m->rest_weights, sizeof *m->weights * m->weight_count);
    if (m->clip_count > 0) {
        const uint64_t loop = m->clip->duration > 0 ? (uint64_t)m->clip->duration * MODEL_FRAMES_A_SECOND : 1;
        const fx_t time = (fx_t)((uint64_t)frame * FX_ONE % loop / MODEL_FRAMES_A_SECOND);
        ph_clip_sample(m->clip, time, m->pose, m->weights);
    }
    ph_rig_places(&m->rig, m->pose, &m->root, m->places);
    for (uint32_t i = 0; i < m->moving_count; i++) {
        const struct model_moving *const moving = &m->moving[i];
        struct ph_bound bound = moving->bound;
        if (moving->morph.target_count > 0) {
            ph_morph_vertices(&moving->morph, m->weights + moving->first_weight, moving->morphed, NULL);
            bound.positions = (const int16_t(*)[3])moving->morphed;
        }
        ph_skin_matrices(&moving->skin, m->places, m->matrices);
        ph_skin_vertices(&bound, m->matrices, moving->positions, moving->normals);
    }
}
