#include "sim_matrix.h"

static void print_one(FILE *file, const char *name, const struct ph_mat4 *matrix)
{
    fprintf(file, "%s\n", name);
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            char text[FX_TEXT_SIZE];
            fx_to_text(matrix->m[i][j], text);
            fprintf(file, "%s%c", text, j < 3 ? ' ' : '\n');
        }
    }
}

int sim_matrix_print(FILE *file, const struct ph_xform *view, const struct ph_projection *projection, uint16_t width,
                     uint16_t height, enum ph_convention convention)
{
    struct ph_mat4 to_clip;
    const int status = ph_matrix_projection(&to_clip, projection, convention);
    if (status != 0) {
        return status;
    }
    const struct ph_mat4 to_camera = ph_matrix_view(view, convention);
    const struct ph_mat4 to_pixels = ph_matrix_viewport(width, height, convention);
    print_one(file, "view", &to_camera);
    print_one(file, "projection", &to_clip);
    print_one(file, "viewport", &to_pixels);
    return 0;
}
