/* See sim_focus.h. */
#include "sim_focus.h"

/* The linker's name for the function itself, where sim_focus_blur_begin stands for it. */
// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
int __real_ph_blur_begin(struct ph_blur *blur, const struct ph_renderer *r, void *scratch, size_t bytes,
                         const struct ph_focus *focus);
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

static fx_t set_distance, set_strength;
static struct ph_focus last; /* of the last blur that has begun; its distance is more than 0 */

void sim_focus_set(fx_t distance, fx_t strength)
{
    set_distance = distance;
    set_strength = strength;
}

int sim_focus_blur_begin(struct ph_blur *blur, const struct ph_renderer *r, void *scratch, size_t bytes,
                         const struct ph_focus *focus)
{
    struct ph_focus set = *focus;
    if (set_distance > 0) {
        set.distance = set_distance;
        set.strength = set_strength >= 0 ? set_strength : set.strength;
    }
    const int status = __real_ph_blur_begin(blur, r, scratch, bytes, &set);
    last = status == PH_OK ? set : last;
    return status;
}

bool sim_focus_find(struct sim_focus *found, struct sim_player *p)
{
    struct runner *const runner = &p->runner;
    last.distance = 0;
    if (runner->demo->blur_radius > 0 && ph_frame_bands(&runner->renderer) > 0) {
        runner->demo->band(&runner->context, &runner->renderer, 0, runner->bands[0]);
    }
    *found = (struct sim_focus){last, runner->context.blur};
    return last.distance > 0;
}

void sim_focus_print(FILE *file, const struct sim_focus *f, const struct ph_projection *p, uint16_t height)
{
    const struct sim_fraction distance = sim_fraction_of(f->focus.distance, 16),
                              strength = sim_fraction_of(f->focus.strength, 16);
    if (p->kind == PH_FISHEYE) {
        return;
    }
    sim_fraction_print(file, "focus.distance", distance, f->focus.distance);
    sim_fraction_print(file, "focus.strength", strength, f->focus.strength);
    if (p->kind == PH_PERSPECTIVE) { /* 2 strength distance / (scale height / 2) */
        const struct sim_fraction focal =
            sim_fraction_times(sim_fraction_of(p->scale_y_q20, 20), sim_fraction_of(height, 2));
        const struct sim_fraction aperture = sim_fraction_divide(sim_fraction_times(strength, distance), focal);
        sim_fraction_print(file, "focus.aperture", aperture, sim_fraction_code(aperture));
    }
    const struct sim_fraction largest = sim_fraction_of(f->blur.most, 3); /* a radius in 1/16 px */
    sim_fraction_print(file, "focus.largest", largest, sim_fraction_code(largest));
}

void sim_focus_print_blur(FILE *file, const char *name, const struct sim_focus *f, const struct ph_projection *p,
                          struct sim_fraction z)
{
    const fx_t code = sim_fraction_code(z);
    if (p->kind == PH_FISHEYE || code < p->near_z || code > p->far_z) {
        return;
    }
    const struct sim_fraction range =
        sim_fraction_add(sim_fraction_of(p->far_z, 16), sim_fraction_minus(sim_fraction_of(p->near_z, 16)));
    const struct sim_fraction away = sim_fraction_add(z, sim_fraction_minus(sim_fraction_of(f->focus.distance, 16)));
    struct sim_fraction blur = sim_fraction_times(sim_fraction_of(f->focus.strength, 15), /* twice the strength */
                                                  sim_fraction_divide(away, p->kind == PH_ORTHOGRAPHIC ? range : z));
    blur.is_negative = false;
    const int32_t radius16 = ph_blur_at(&f->blur, code);
    sim_fraction_print(file, name, blur, (radius16 < 0 ? -radius16 : radius16) * (FX_ONE / 8));
}
