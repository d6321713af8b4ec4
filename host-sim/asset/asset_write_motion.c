/* asset: writes the animation of a model into the C file that asset_write.c makes. */
#include "asset_write.h"

#include <inttypes.h>

/* Begins an array NAME_NUMBER: `count` lists of `width` numbers, each in braces where they are more than one. */
static void put_rows(FILE *file, const char *type, const char *name, uint32_t number, const int16_t *values,
                     size_t count, uint32_t width)
{
    fprintf(file, "\nstatic const %s %s_%u[]%s = {", type, name, (unsigned)number, width > 1 ? "[3]" : "");
    for (size_t i = 0; i < count; i++) {
        fputs(i % (width > 1 ? 4 : 12) == 0 ? "\n    " : " ", file);
        for (uint32_t k = 0; k < width; k++) {
            fprintf(file, "%s%d", k > 0 ? ", " : width > 1 ? "{" : "", values[i * width + k]);
        }
        fputs(width > 1 ? "}," : ",", file);
    }
    fputs("\n};\n", file);
}

static void put_joints(FILE *file, uint32_t number, const struct ph_skin *skin)
{
    fprintf(file, "\nstatic const uint16_t joints_%u[] = {", (unsigned)number);
    for (uint32_t i = 0; i < skin->joint_count; i++) {
        fprintf(file, "%s%u,", i % 16 == 0 ? "\n    " : " ", skin->nodes[i]);
    }
    fputs("\n};\n", file);
}

static void put_times(FILE *file, uint32_t clip, uint32_t number, const struct ph_track *track)
{
    fprintf(file, "\nstatic const fx_t times_%u_%u[] = {", (unsigned)clip, (unsigned)number);
    for (uint32_t i = 0; i < track->key_count; i++) {
        fprintf(file, "%s%" PRId32 ",", i % 12 == 0 ? "\n    " : " ", track->times[i]);
    }
    fputs("\n};\n", file);
}

static void put_matrix(FILE *file, const struct ph_xform *m)
{
    fputs("{{", file);
    for (int row = 0; row < 3; row++) {
        fputs(row > 0 ? ", " : "", file);
        asset_put_vec3(file, (struct fx_vec3){m->r[row][0], m->r[row][1], m->r[row][2]});
    }
    fputs("}, ", file);
    asset_put_vec3(file, m->t);
    fputs("}", file);
}

static void put_rig(FILE *file, const struct animation *a)
{
    fputs("\nstatic const struct ph_rig_node nodes[] = {\n", file);
    for (uint32_t i = 0; i < a->rig.node_count; i++) {
        const struct ph_rig_node *node = &a->rig.nodes[i];
        const struct fx_quat r = node->rest.r;
        fprintf(file, "    {%d, {{%" PRId32 ", %" PRId32 ", %" PRId32 ", %" PRId32 "}, ", node->parent, r.w, r.x, r.y,
                r.z);
        asset_put_vec3(file, node->rest.t);
        fputs(", ", file);
        asset_put_vec3(file, node->rest.s);
        fputs("}},\n", file);
    }
    fputs("};\n\nstatic const int32_t rest_weights[] = {0", file);
    for (uint32_t i = 0; i < a->weight_count; i++) {
        fprintf(file, ", %" PRId32, a->rest_weights[i]);
    }
    fputs("};\n", file);
}

static void put_skin(FILE *file, const struct ph_skin *skin, uint32_t i)
{
    put_joints(file, i, skin);
    fprintf(file, "\nstatic const struct ph_xform binds_%u[] = {\n", (unsigned)i);
    for (uint32_t k = 0; k < skin->joint_count; k++) {
        fputs("    ", file);
        put_matrix(file, &skin->inverse_bind[k]);
        fputs(",\n", file);
    }
    fputs("};\n", file);
}

static void put_influences(FILE *file, const struct ph_bound *bound, uint32_t i)
{
    fprintf(file, "\nstatic const struct ph_influence influences_%u[] = {", (unsigned)i);
    for (uint32_t v = 0; v < bound->vertex_count; v++) {
        const struct ph_influence *in = &bound->influences[v];
        fprintf(file, "%s{{%u, %u, %u, %u}, {%u, %u, %u, %u}},", v % 3 == 0 ? "\n    " : " ", in->joints[0],
                in->joints[1], in->joints[2], in->joints[3], in->weights[0], in->weights[1], in->weights[2],
                in->weights[3]);
    }
    fputs("\n};\n", file);
}

static void put_moving_data(FILE *file, const struct animation *a, uint32_t i)
{
    const struct animation_mesh *m = &a->meshes[i];
    const uint32_t targets = m->morph.target_count * m->bound.vertex_count;
    put_rows(file, "int16_t", "bound", i, m->bound.positions[0], m->bound.vertex_count, 3);
    if (m->bound.influences != NULL) {
        put_influences(file, &m->bound, i);
    }
    if (asset_first_skin(a, i) == i) {
        put_skin(file, &m->skin, i);
    }
    if (targets > 0) {
        put_rows(file, "int16_t", "targets", i, m->morph.d_positions[0], targets, 3);
    }
    if (m->morph.d_normals != NULL) {
        put_rows(file, "int16_t", "target_normals", i, m->morph.d_normals[0], targets, 3);
    }
}

static void put_moving(FILE *file, const struct animation *a)
{
    for (uint32_t i = 0; i < a->mesh_count; i++) {
        put_moving_data(file, a, i);
    }
    fputs("\nstatic const struct animation_mesh moving[] = {\n", file);
    for (uint32_t i = 0; i < a->mesh_count; i++) {
        const struct animation_mesh *m = &a->meshes[i];
        const unsigned n = (unsigned)i, mesh = (unsigned)m->mesh, skin = (unsigned)asset_first_skin(a, i);
        fprintf(file, "    {.mesh = %u, .bound = {.positions = bound_%u, .normals = normals_%u, ", mesh, n, mesh);
        if (m->bound.influences != NULL) {
            fprintf(file, ".influences = influences_%u, ", n);
        }
        fputs(m->bound.scales_axes ? ".scales_axes = true, " : "", file);
        fprintf(file, ".vertex_count = %u, .frac = %u},\n     .skin = {joints_%u, binds_%u, %u}",
                (unsigned)m->bound.vertex_count, m->bound.frac, skin, skin, (unsigned)m->skin.joint_count);
        if (m->morph.target_count > 0) {
            fprintf(file,
                    ",\n     .morph = {.positions = bound_%u, .normals = normals_%u, .d_positions = targets_%u, "
                    ".vertex_count = %u,\n               .target_count = %u",
                    n, mesh, n, (unsigned)m->morph.vertex_count, (unsigned)m->morph.target_count);
            if (m->morph.d_normals != NULL) {
                fprintf(file, ", .d_normals = target_normals_%u", n);
            }
            fprintf(file, "},\n     .first_weight = %u", (unsigned)m->first_weight);
        }
        fputs("},\n", file);
    }
    fputs("};\n", file);
}

static void put_clip_data(FILE *file, const struct ph_clip *clip, uint32_t c)
{
    for (uint32_t i = 0; i < clip->track_count; i++) {
        char name[24];
        const struct ph_track *t = &clip->tracks[i];
        if (asset_first_times(clip, i) == i) {
            put_times(file, c, i, t);
        }
        snprintf(name, sizeof name, "keys_%u", (unsigned)c);
        put_rows(file, "int16_t", name, i, t->keys, asset_key_numbers(t), 1);
    }
    fprintf(file, "\nstatic const struct ph_track tracks_%u[] = {\n", (unsigned)c);
    for (uint32_t i = 0; i < clip->track_count; i++) {
        const struct ph_track *t = &clip->tracks[i];
        fprintf(file, "    {%u, %u, %u, %u, %u, %u, times_%u_%u, keys_%u_%u},\n", t->node, t->path, t->interpolation,
                t->width, t->frac, t->key_count, (unsigned)c, (unsigned)asset_first_times(clip, i), (unsigned)c,
                (unsigned)i);
    }
    fputs(clip->track_count > 0 ? "};\n" : "    {0}};\n", file);
}

/* Writes a name, of which only letters, digits, space, - and _ go into the file. */
static void put_name(FILE *file, const char *name)
{
    for (; *name != '\0'; name++) {
        const bool is_plain = (*name >= 'a' && *name <= 'z') || (*name >= 'A' && *name <= 'Z') ||
                              (*name >= '0' && *name <= '9') || *name == ' ' || *name == '-';
        fputc(is_plain ? *name : '_', file);
    }
}

static void put_clips(FILE *file, const struct animation *a)
{
    for (uint32_t i = 0; i < a->clip_count; i++) {
        put_clip_data(file, &a->clips[i], i);
    }
    fputs("\nstatic const struct ph_clip clips[] = {\n", file);
    for (uint32_t i = 0; i < a->clip_count; i++) {
        const struct ph_clip *clip = &a->clips[i];
        fputs("    {\"", file);
        put_name(file, clip->name);
        fprintf(file, "\", tracks_%u, %u, %" PRId32 "},\n", (unsigned)i, (unsigned)clip->track_count, clip->duration);
    }
    fputs("};\n", file);
}

static void put_outline(FILE *file, const struct animation *a)
{
    fputs("\nstatic const struct fx_vec3 outline[] = {\n", file);
    for (uint32_t i = 0; i < a->outline_count; i++) {
        fputs("    ", file);
        asset_put_vec3(file, a->outline[i]);
        fputs(",\n", file);
    }
    fputs("};\n", file);
}

void asset_write_motion(FILE *file, const struct model *model)
{
    const struct animation *a = &model->motion->animation;
    put_rig(file, a);
    put_moving(file, a);
    if (a->clip_count > 0) {
        put_clips(file, a);
    }
    if (a->outline_count > 0) {
        put_outline(file, a);
    }
    fprintf(file, "\nstatic const struct animation animation = {\n    .rig = {nodes, %u},\n    .root = ",
            (unsigned)a->rig.node_count);
    put_matrix(file, &a->root);
    if (a->clip != NULL) {
        fprintf(file,
                ",\n    .clip = &clips[%u],\n    .clips = clips,\n    .clip_count = %u,\n    .cross_fade = %" PRId32,
                (unsigned)(a->clip - a->clips), (unsigned)a->clip_count, a->cross_fade);
        fputs(a->in_turn ? ",\n    .in_turn = true" : "", file);
    }
    fprintf(file, ",\n    .meshes = moving,\n    .mesh_count = %u,\n    .weight_count = %u,\n", (unsigned)a->mesh_count,
            (unsigned)a->weight_count);
    if (a->outline_count > 0) {
        fprintf(file, "    .outline = outline,\n    .outline_count = %u,\n", (unsigned)a->outline_count);
    }
    fputs("    .rest_weights = rest_weights,\n};\n", file);
}
