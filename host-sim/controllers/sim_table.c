/* See sim_table.h. */
#include "sim_table.h"

#include "sim_model.h"

const struct sim_command *sim_table_find(const struct sim_table *table, uint8_t code)
{
    for (size_t i = 0; i < table->count; i++) {
        if (table->commands[i].code == code) {
            return &table->commands[i];
        }
    }
    return NULL;
}

static bool is_exact(struct sim *sim, const struct sim_command *command, uint32_t number, uint8_t byte)
{
    const uint8_t wanted = command->exact[number - 1];
    if (byte != wanted) {
        sim_complain(sim, SIM_BAD_PARAMETER, "%02Xh %s, parameter %u: %02Xh; only the maker's %02Xh is known",
                     command->code, command->name, number, byte, wanted);
    }
    return byte == wanted;
}

static void refuse(struct sim *sim, const struct sim_command *command, uint32_t number, uint8_t byte,
                   const struct sim_field *f)
{
    if (f->least == f->most) {
        sim_complain(sim, SIM_BAD_PARAMETER, "%02Xh %s, parameter %u: %02Xh; bits %02Xh must be %02Xh (%s)",
                     command->code, command->name, number, byte, f->bits, f->least, f->name);
    } else {
        sim_complain(sim, SIM_BAD_PARAMETER, "%02Xh %s, parameter %u: %02Xh; bits %02Xh have %02Xh..%02Xh (%s)",
                     command->code, command->name, number, byte, f->bits, f->least, f->most, f->name);
    }
}

bool sim_table_accepts(struct sim *sim, const struct sim_command *command, uint32_t number, uint8_t byte)
{
    if (command->exact != NULL) {
        return is_exact(sim, command, number, byte);
    }
    uint8_t named = 0;
    for (const struct sim_field *f = command->fields; f < command->fields + command->field_count; f++) {
        if (number < f->first || number > f->last) {
            continue;
        }
        const uint8_t value = byte & f->bits;
        if (value < f->least || value > f->most) {
            refuse(sim, command, number, byte, f);
            return false;
        }
        named |= f->bits;
    }
    const uint8_t others = byte & (uint8_t)~named;
    if (others != 0) {
        sim_complain(sim, SIM_BAD_PARAMETER, "%02Xh %s, parameter %u: %02Xh; bits %02Xh must be 0", command->code,
                     command->name, number, byte, others);
    }
    return others == 0;
}
