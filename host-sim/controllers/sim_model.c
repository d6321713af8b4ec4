/* See sim_model.h. What all models of controllers share: complaints, and whether each pixel of the glass was written.
 */
#include "sim_model.h"

#include <stdarg.h>
#include <stdio.h>

void sim_complain(struct sim *sim, enum sim_complaint_kind kind, const char *format, ...)
{
    sim->complaint_count_of[kind]++;
    uint32_t i = sim->complaint_count++;
    if (i >= SIM_COMPLAINTS_KEPT) {
        return;
    }
    char *text = sim->complaints[i];
    size_t size = sizeof sim->complaints[i];
    int used = snprintf(text, size, "%s, %llu.%03llu ms: ", sim->glass.model->controller,
                        (unsigned long long)(sim->time_ns / 1000000), (unsigned long long)(sim->time_ns / 1000 % 1000));
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + used, size - (size_t)used, format, arguments);
    va_end(arguments);
}

bool sim_frame_complete(const struct sim *sim)
{
    for (uint32_t y = 0; y < sim->glass.height; y++) {
        for (uint32_t x = 0; x < sim->glass.width; x++) {
            if (!sim->glass.model->written(sim, x, y)) {
                return false;
            }
        }
    }
    return true;
}
