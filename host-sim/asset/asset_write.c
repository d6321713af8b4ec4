/* See asset_write.h. The C file of a model: const arrays, materials, and a demo that shows it. */
#include "asset_write.h"
#include "model_texture.h"
#include "scene_format.h"

#include <inttypes.h>

/* Separates the values of an array: several a line, and no line longer than others in a C file. */
static void separate(FILE *file, uint32_t i, uint32_t per_line)
{
    fputs(i % per_line == 0 ? "\n    " : " ", file);
}

/* Writes a number; INT32_MIN has no literal. */
static void put_number(FILE *file, int32_t value)
{
    if (value == INT32_MIN) {
        fputs("INT32_MIN", file);
    } else {
        fprintf(file, "%" PRId32, value);
    }
}

static void put_numbers(FILE *file, const int32_t *values, int count)
{
    for (int i = 0; i < count; i++) {
        fputs(i == 0 ? "{" : ", ", file);
        put_number(file, values[i]);
    }
    fputc('}', file);
}

void asset_put_vec3(FILE *file, struct fx_vec3 v)
{
    put_numbers(file, (const int32_t[]){v.x, v.y, v.z}, 3);
}

static void put_positions(FILE *file, const struct ph_mesh *mesh, uint32_t m)
{
    fprintf(file, "\nstatic const struct fx_vec3 positions_%u[] = {", (unsigned)m);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        separate(file, i, 4);
        asset_put_vec3(file, mesh->positions[i]);
        fputc(',', file);
    }
    fputs("\n};\n", file);
}

static void put_bounds(FILE *file, const struct ph_sphere *sphere, uint32_t m)
{
    fprintf(file, "\nstatic const struct ph_sphere bounds_%u = {.centre = ", (unsigned)m);
    asset_put_vec3(file, sphere->centre);
    fprintf(file, ", .radius = %" PRId32 ", .culling = PH_CULL_SPHERES};\n", sphere->radius);
}

static void put_normals(FILE *file, const struct ph_mesh *mesh, uint32_t m)
{
    fprintf(file, "\nstatic const int16_t normals_%u[][3] = {", (unsigned)m);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const int16_t *n = mesh->normals[i];
        separate(file, i, 4);
        fprintf(file, "{%d, %d, %d},", n[0], n[1], n[2]);
    }
    fputs("\n};\n", file);
}

static void put_uvs(FILE *file, const struct ph_mesh *mesh, uint32_t m)
{
    fprintf(file, "\nstatic const fx_t uvs_%u[][2] = {", (unsigned)m);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        separate(file, i, 4);
        put_numbers(file, mesh->uvs[i], 2);
        fputc(',', file);
    }
    fputs("\n};\n", file);
}

static void put_triangles(FILE *file, const struct ph_mesh *mesh, uint32_t m)
{
    fprintf(file, "\nstatic const uint16_t triangles_%u[][3] = {", (unsigned)m);
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint16_t *c = mesh->triangles[i];
        separate(file, i, 6);
        fprintf(file, "{%u, %u, %u},", c[0], c[1], c[2]);
    }
    fputs("\n};\n", file);
}

/* A colour in wire order, as the number that it is on the wire. */
static unsigned number_of(uint16_t wire)
{
    const uint8_t *bytes = (const uint8_t *)&wire;
    return (unsigned)bytes[0] << 8 | bytes[1];
}

static void put_colours(FILE *file, const char *name, uint32_t m, const uint16_t *colours, size_t count)
{
    fprintf(file, "\nstatic const uint16_t %s_%u[] = {", name, (unsigned)m);
    for (size_t i = 0; i < count; i++) {
        separate(file, (uint32_t)i, 10);
        fprintf(file, "W(0x%04X),", number_of(colours[i]));
    }
    fputs("\n};\n", file);
}

/* Writes a texture as a struct, which is called texture_m or alphas_m. */
static void put_texture(FILE *file, const char *name, const struct ph_texture *t, uint32_t m)
{
    const char *const filter = t->filter == PH_FILTER_MIPMAP     ? "MIPMAP"
                               : t->filter == PH_FILTER_BILINEAR ? "BILINEAR"
                                                                 : "NEAREST";
    static const char *const wraps[] = {"PH_WRAP_REPEAT", "PH_WRAP_CLAMP_U", "PH_WRAP_CLAMP_V", "PH_WRAP_CLAMP"};
    char texels[24];
    snprintf(texels, sizeof texels, "%s_texels", name);
    put_colours(file, texels, m, t->texels, model_texture_texels(t, t->levels));
    fprintf(file,
            "\nstatic const struct ph_texture %s_%u = {.texels = %s_%u, .log2_width = %u, .log2_height = %u,\n"
            "    .wrap = %s, .filter = PH_FILTER_%s, .levels = %u};\n",
            name, (unsigned)m, texels, (unsigned)m, t->log2_width, t->log2_height, wraps[t->wrap], filter, t->levels);
}

static void put_blend(FILE *file, const struct ph_blend *from, uint32_t m)
{
    static const char *const kinds[] = {[PH_BLEND_MASK] = "PH_BLEND_MASK",
                                        [PH_BLEND_TIMES] = "PH_BLEND_TIMES",
                                        [PH_BLEND_ALPHA] = "PH_BLEND_ALPHA",
                                        [PH_BLEND_ADD] = "PH_BLEND_ADD"};
    if (from->alphas != NULL) {
        put_texture(file, "alphas", from->alphas, m);
    }
    fprintf(file,
            "\nstatic const struct ph_blend blend_%u = {.draw = ph_draw_blended%s, .kind = %s, .alpha = %u,\n    ",
            (unsigned)m, from->alphas != NULL ? "_alphas" : "", kinds[from->kind], from->alpha);
    if (from->alphas != NULL) {
        fprintf(file, ".alphas = &alphas_%u", (unsigned)m);
    }
    fputs("};\n", file);
}

static const char *shading_name(const struct ph_shading *shading)
{
#define NAMED(name, number, word, is_textured) shading == PH_SHADE_##name ? "PH_SHADE_" #name:
    return SCENE_FILE_SHADING_EACH(NAMED) NULL;
#undef NAMED
}

static void put_material(FILE *file, const struct asset *asset, uint32_t m)
{
    const struct model *const model = &asset->model;
    const struct ph_material *from = model->meshes[m].materials;
    fprintf(file,
            "\nstatic const struct ph_material material_%u = {\n"
            "    .shading = %s,\n    .two_sided = %s,\n    .shininess_log2 = %u,\n    .depth_bias = %u,\n    .ambient "
            "= %" PRId32 ",\n    .diffuse = %" PRId32 ",\n    .specular = %" PRId32
            ",\n    .colour = W(0x%04X),\n    .ramp = ramp_%u,\n",
            (unsigned)m, shading_name(from->shading), from->two_sided ? "true" : "false", from->shininess_log2,
            from->depth_bias, from->ambient, from->diffuse, from->specular, number_of(from->colour),
            (unsigned)asset->first_ramps[m]);
    if (from->texture != NULL) {
        fprintf(file, "    .texture = &texture_%u,\n", (unsigned)asset_first_texture(model, m));
    }
    if (from->blend != NULL) {
        fprintf(file, "    .blend = &blend_%u,\n", (unsigned)asset_first_blend(model, m));
    }
    fputs("};\n", file);
}

static void put_mesh_data(FILE *file, const struct asset *asset, uint32_t m)
{
    const struct model *const model = &asset->model;
    const struct ph_mesh *mesh = &model->meshes[m];
    const struct ph_material *material = mesh->materials;
    if (model_moving(model, m) == NULL) {
        put_positions(file, mesh, m);
    }
    if (mesh->bounds != NULL) {
        put_bounds(file, mesh->bounds, m);
    }
    put_normals(file, mesh, m);
    if (mesh->uvs != NULL) {
        put_uvs(file, mesh, m);
    }
    if (mesh->colours != NULL) {
        put_colours(file, "colours", m, mesh->colours, mesh->vertex_count);
    }
    put_triangles(file, mesh, m);
    if (asset->first_ramps[m] == m) {
        put_colours(file, "ramp", m, material->ramp, PH_RAMP_SIZE);
    }
    if (material->texture != NULL && asset_first_texture(model, m) == m) {
        put_texture(file, "texture", material->texture, m);
    }
    if (material->blend != NULL && asset_first_blend(model, m) == m) {
        put_blend(file, material->blend, m);
    }
    put_material(file, asset, m);
    fprintf(file, "\nstatic const struct ph_part part_%u = {.count = %u};\n", (unsigned)m,
            (unsigned)mesh->triangle_count);
}

static void put_meshes(FILE *file, const struct model *model)
{
    fputs("\nstatic const struct ph_mesh meshes[] = {\n", file);
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        const struct ph_mesh *mesh = &model->meshes[m];
        const unsigned n = (unsigned)m;
        fprintf(file,
                "    {.normals = normals_%u,\n     .triangles = triangles_%u,\n     .parts = &part_%u,\n"
                "     .materials = &material_%u,\n",
                n, n, n, n);
        if (model_moving(model, m) == NULL) {
            fprintf(file, "     .positions = positions_%u,\n", n);
        }
        if (mesh->bounds != NULL) {
            fprintf(file, "     .bounds = &bounds_%u,\n", n);
        }
        if (mesh->uvs != NULL) {
            fprintf(file, "     .uvs = uvs_%u,\n", n);
        }
        if (mesh->colours != NULL) {
            fprintf(file, "     .colours = colours_%u,\n", n);
        }
        fprintf(file, "     .vertex_count = %u,\n     .triangle_count = %u,\n     .part_count = 1},\n",
                (unsigned)mesh->vertex_count, (unsigned)mesh->triangle_count);
    }
    fputs("};\n", file);
}

static void put_camera(FILE *file, const struct demo_eye *eye)
{
    const struct ph_projection *lens = &eye->lens;
    fputs("\nstatic const struct demo_eye eye = {\n    .view = {.r = {", file);
    for (int row = 0; row < 3; row++) {
        const int32_t *r = eye->view.r[row];
        fprintf(file, "%s{%" PRId32 ", %" PRId32 ", %" PRId32 "}", row > 0 ? ", " : "", r[0], r[1], r[2]);
    }
    fputs("}, .t = ", file);
    asset_put_vec3(file, eye->view.t);
    fprintf(file,
            "},\n    .lens = {.kind = %s, .scale_x_q20 = %" PRId32 ", .scale_y_q20 = %" PRId32 ", .near_z = %" PRId32
            ", .far_z = %" PRId32 "},\n};\n",
            lens->kind == PH_ORTHOGRAPHIC ? "PH_ORTHOGRAPHIC" : "PH_PERSPECTIVE", lens->scale_x_q20, lens->scale_y_q20,
            lens->near_z, lens->far_z);
}

static void put_studio(FILE *file, const struct demo_studio *s)
{
    fprintf(file, "\nstatic const struct demo_studio studio = {W(0x%04X), %u, ", number_of(s->background), s->has_lamp);
    asset_put_vec3(file, s->to_lamp_q30);
    fputs("};\n", file);
}

static void put_demo(FILE *file, const struct asset *asset)
{
    const struct demo demo = asset_demo(asset);
    const unsigned count = (unsigned)asset->model.mesh_count;
    const bool moves = asset->model.motion != NULL, is_still = asset->model.has_camera;
    if (asset->model.studio != NULL) {
        put_studio(file, asset->model.studio);
    }
    fputs("\nstatic int init(struct demo_context *context)\n{\n", file);
    if (asset->model.studio != NULL) {
        fputs("    context->studio = &studio;\n", file);
    }
    if (moves) {
        fprintf(file, "    return animation_init(context, &animation, meshes, %u, %s);\n}\n", count,
                is_still ? "&eye" : "NULL");
    } else if (is_still) {
        fprintf(file, "    return demo_still_init(context, meshes, %u, &eye);\n}\n", count);
    } else {
        fprintf(file, "    return demo_turntable_init(context, meshes, %u, (struct fx_vec3){0, 0, 0});\n}\n", count);
    }
    fprintf(file,
            "\nconst struct demo demo_scene = {\n    .name = \"%s\",\n    .summary = \"a model file\",\n"
            "    .loop_frames = %u,\n    .arena_bytes = sizeof(void *) > 4 ? %u : %u,\n    .arena_bytes_32 = %u,\n"
            "    .vertex_max = %u,\n    .triangle_max = %u,\n    .init = init,\n%s    .frame = %s_frame,\n};\n",
            demo.name, (unsigned)demo.loop_frames, (unsigned)demo.arena_bytes, (unsigned)demo.arena_bytes_32,
            (unsigned)demo.arena_bytes_32, (unsigned)demo.vertex_max, (unsigned)demo.triangle_max,
            moves ? "    .select = animation_select,\n" : "",
            moves      ? "animation"
            : is_still ? "demo_still"
                       : "demo_turntable");
}

void asset_write(FILE *file, const struct asset *asset)
{
    const struct model *model = &asset->model;
    fprintf(file,
            "/*\n * %s: %u triangles in %u meshes, made by pinhole-asset. Positions Q16.16, normals Q1.14, colours in "
            "wire\n"
            " * order. The demo demo_scene (demo.h) shows it.\n */\n#include \"animation.h\"\n\n"
            "#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__\n#define W(colour) (colour)\n#else\n"
            "#define W(colour) (((colour)&0xFF) << 8 | (colour) >> 8)\n#endif\n",
            asset->name, (unsigned)model->triangle_count, (unsigned)model->mesh_count);
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        put_mesh_data(file, asset, m);
    }
    put_meshes(file, model);
    if (model->motion != NULL) {
        asset_write_motion(file, model);
    }
    if (model->has_camera) {
        put_camera(file, &model->camera);
    }
    put_demo(file, asset);
}
