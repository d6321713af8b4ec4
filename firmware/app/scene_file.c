/* See scene_file.h. A scene is checked once, before anything of it is used; drawing it trusts every offset. */
#include "scene_file.h"

#include "crc32.h"

#include <string.h>

#define SIDE_LOG2_MAX  10
#define SCALE_MAX      (1 << 30) /* Q20: a focal length of 2^18 pixels in a picture of 512 */
#define COORDINATE_MAX (1 << 30) /* Q16.16: the buttons move a camera and its planes by as much again at most */

/* What is made in the arena for each mesh. */
struct drawn {
    struct ph_part part;
    struct ph_material material;
    struct ph_blend blend;
    struct ph_texture texture, alphas;
    struct ph_sphere bounds; /* unless it moves */
};

#define MESH_BYTES_32  52
#define DRAWN_BYTES_32 104
_Static_assert(sizeof(void *) > 4 || sizeof(struct ph_mesh) == MESH_BYTES_32, "MESH_BYTES_32 is wrong");
_Static_assert(sizeof(void *) > 4 || sizeof(struct drawn) == DRAWN_BYTES_32, "DRAWN_BYTES_32 is wrong");

#define ROUND8(n) (((n) + 7) & ~(size_t)7)

/* Texels of the first level and of those below it. */
static uint32_t texel_count(const struct scene_file_texture *t)
{
    uint32_t sum = 0;
    for (uint32_t k = 0; k <= t->levels; k++) {
        sum += 1U << ((t->log2_width > k ? t->log2_width - k : 0) + (t->log2_height > k ? t->log2_height - k : 0));
    }
    return sum;
}

static bool is_texture_right(const struct scene_file_head *head, const struct scene_file_texture *t)
{
    return t->log2_width <= SIDE_LOG2_MAX && t->log2_height <= SIDE_LOG2_MAX &&
           t->levels <= (t->log2_width > t->log2_height ? t->log2_width : t->log2_height) &&
           t->wrap <= SCENE_FILE_CLAMP_U && t->filter < SCENE_FILE_FILTERS &&
           (t->spare[0] | t->spare[1] | t->spare[2]) == 0 &&
           scene_file_inside(head, t->texels, texel_count(t), sizeof(uint16_t));
}

/* The bits of all shadings that a scene may have, and of those that draw a texture. */
#define BIT(name, number, word, is_textured)             | 1u << (number)
#define BIT_OF_TEXTURED(name, number, word, is_textured) | (uint32_t)(is_textured) << (number)

static bool is_one_of(uint32_t shadings, uint8_t number)
{
    return number < SCENE_FILE_SHADINGS && (shadings >> number & 1) != 0;
}

/* Textures need coordinates, and coordinates are there for textures only. */
static bool are_textures_right(const struct scene_file_head *head, const struct scene_file_mesh *m)
{
    const bool has_texture = m->texture.texels != 0, has_alphas = m->alphas.texels != 0;
    const bool is_textured = is_one_of(0 SCENE_FILE_SHADING_EACH(BIT_OF_TEXTURED), m->shading);
    return is_textured == has_texture && (has_texture || has_alphas) == (m->uvs != 0) &&
           (!has_texture || is_texture_right(head, &m->texture)) &&
           (!has_alphas || is_texture_right(head, &m->alphas)) &&
           (m->uvs == 0 || scene_file_inside(head, m->uvs, m->vertex_count, sizeof(fx_t[2])));
}

static bool is_share(int32_t share)
{
    return share >= 0 && share <= FX_ONE;
}

static bool is_surface_right(const struct scene_file_mesh *m)
{
    return is_one_of(0 SCENE_FILE_SHADING_EACH(BIT), m->shading) && m->two_sided <= 1 && m->shininess_log2 <= 7 &&
           m->blend <= SCENE_FILE_TIMES && m->alpha <= 32 && m->depth_bias <= 56 && is_share(m->ambient) &&
           is_share(m->diffuse) && is_share(m->specular) && (m->blend != SCENE_FILE_MASK || m->alphas.texels != 0) &&
           (m->blend != SCENE_FILE_OPAQUE || m->alphas.texels == 0);
}

static bool is_mesh_right(const struct scene_file_head *head, const struct scene_file_mesh *m)
{
    if (m->vertex_count > UINT16_MAX ||
        !scene_file_inside(head, m->positions, m->vertex_count,
                           m->moving != 0 ? sizeof(int16_t[3]) : sizeof(struct fx_vec3)) ||
        !scene_file_inside(head, m->normals, m->vertex_count, sizeof(int16_t[3])) ||
        !scene_file_inside(head, m->triangles, m->triangle_count, sizeof(uint16_t[3])) ||
        (m->colours != 0 && !scene_file_inside(head, m->colours, m->vertex_count, sizeof(uint16_t))) ||
        !scene_file_inside(head, m->ramp, PH_RAMP_SIZE, sizeof(uint16_t)) || !are_textures_right(head, m)) {
        return false;
    }
    const uint16_t *const corners = (const void *)((const uint8_t *)head + m->triangles);
    for (uint32_t i = 0; i < m->triangle_count * 3; i++) {
        if (corners[i] >= m->vertex_count) {
            return false;
        }
    }
    return true;
}

/* A product of two rows of Q2.30, in Q32 of one. */
static int64_t product(const int32_t a[3], const int32_t b[3])
{
    int64_t sum = 0;
    for (uint32_t i = 0; i < 3; i++) {
        sum += (int64_t)(a[i] >> 14) * (b[i] >> 14);
    }
    return sum;
}

/* Whether a product of rows of Q2.30 is 0, to 1/256. */
static bool is_zero(int64_t value)
{
    return value <= (int64_t)1 << 24 && value >= -((int64_t)1 << 24);
}

/* Whether a row has length one. */
static bool is_unit(const int32_t row[3])
{
    return is_zero(product(row, row) - ((int64_t)1 << 32));
}

/* Whether three rows of Q2.30 are a rotation: of length one, at right angles, to 1/256, and not mirrored. */
static bool is_rotation(const int32_t r[3][3])
{
    int32_t cross[3];
    bool right = true;
    for (uint32_t i = 0; i < 3; i++) {
        const uint32_t j = (i + 1) % 3, k = (i + 2) % 3;
        right = right && is_unit(r[i]) && is_zero(product(r[i], r[j]));
        cross[i] = right ? (int32_t)(((int64_t)r[0][j] * r[1][k] - (int64_t)r[0][k] * r[1][j]) >> 31) : 0;
    }
    return right && product(cross, r[2]) > 0;
}

static bool is_in_range(int32_t place)
{
    return place > -COORDINATE_MAX && place < COORDINATE_MAX;
}

/* Whether a scene's camera is right: ph_frame_begin() would take it, whatever the panel, and demo_orbit() can move
 * it. */
static bool is_camera_right(const struct scene_file_head *head)
{
    return (head->lens_kind == PH_ORTHOGRAPHIC || (head->lens_kind == PH_PERSPECTIVE && head->near_z > 0)) &&
           head->near_z < head->far_z && is_in_range(head->near_z) && is_in_range(head->far_z) &&
           is_in_range(head->t[0]) && is_in_range(head->t[1]) && is_in_range(head->t[2]) && head->scale_x_q20 > 0 &&
           head->scale_x_q20 <= SCALE_MAX && head->scale_y_q20 > 0 && head->scale_y_q20 <= SCALE_MAX &&
           is_rotation(head->r);
}

static bool is_name_right(const char name[SCENE_FILE_NAME])
{
    uint32_t n = 0;
    while (n < SCENE_FILE_NAME && (uint8_t)name[n] >= ' ' && name[n] != 127) {
        n++;
    }
    return n < SCENE_FILE_NAME && name[n] == '\0';
}

/* Whether a scene's studio is inside it, and its lamp's direction of length one. */
static bool is_studio_right(const struct scene_file_head *head)
{
    if (!scene_file_inside(head, scene_file_studio(head), 1, sizeof(struct demo_studio))) {
        return false;
    }
    const struct demo_studio *const s = scene_file_at(head, scene_file_studio(head));
    const int32_t way[3] = {s->to_lamp_q30.x, s->to_lamp_q30.y, s->to_lamp_q30.z};
    return s->has_lamp == 0 || (s->has_lamp == 1 && is_unit(way));
}

#define FLAGS ((uint32_t)(SCENE_FILE_CAMERA | SCENE_FILE_BARE | SCENE_FILE_STUDIO | SCENE_FILE_IN_TURN))

/* Checks the head alone. Returns NULL, or what is wrong. */
static const char *head_wrong(const struct scene_file_head *head)
{
    return (head->flags & ~FLAGS) != 0                                        ? "is broken: it has unknown flags"
           : !is_name_right(head->name)                                       ? "is broken: its name is no text"
           : head->mesh_count == 0                                            ? "has no mesh"
           : (head->flags & SCENE_FILE_STUDIO) != 0 && !is_studio_right(head) ? "is broken: its lamp is none"
           : (head->flags & SCENE_FILE_CAMERA) != 0 && !is_camera_right(head)
               ? "is broken: it cannot be seen through its camera"
               : NULL;
}

/* The filter that a texture needs and this program does not have; or NULL. */
static const char *lacks_filter(const struct scene_file_texture *t)
{
    const bool lacks = t->texels != 0 && !scene_file_filters[t->filter].is_there;
    return lacks ? scene_file_filters[t->filter].lacks : NULL;
}

/* What a right mesh needs and this program does not have; or NULL. */
static const char *lacks_of(const struct scene_file_mesh *m)
{
    const struct scene_file_shading *const shading = &scene_file_shadings[m->shading];
    return !shading->is_there                  ? shading->lacks
           : lacks_filter(&m->texture) != NULL ? lacks_filter(&m->texture)
                                               : lacks_filter(&m->alphas);
}

const char *scene_file_wrong(const void *bytes, size_t room)
{
    const struct scene_file_head *const head = bytes;
    const uint16_t one = 1;
    if (*(const uint8_t *)&one != 1) {
        return "is for machines of little endian";
    }
    if (room < sizeof(*head) || head->magic != SCENE_FILE_MAGIC) {
        return "is no binary scene";
    }
    if (head->version != SCENE_FILE_VERSION) {
        return "is of another version: make it again with this version of pinhole-asset";
    }
    if (head->bytes < sizeof(*head) || head->bytes > room) {
        return "is not whole, or too large";
    }
    if (crc32_update(0, (const uint8_t *)bytes + 16, head->bytes - 16) != head->crc) {
        return "has a wrong checksum: write it again";
    }
    if (head->mesh_count > SCENE_FILE_MESHES ||
        head->mesh_count * sizeof(struct scene_file_mesh) > head->bytes - sizeof(*head)) {
        return "is broken: its table of meshes is not inside it";
    }
    if (head_wrong(head) != NULL) {
        return head_wrong(head);
    }
    for (uint32_t i = 0; i < head->mesh_count; i++) {
        if (!is_mesh_right(head, &scene_file_table(head)[i])) {
            return "is broken: a mesh is not inside it";
        }
        if (!is_surface_right(&scene_file_table(head)[i])) {
            return "is broken: the surface of a mesh is none that can be drawn";
        }
        const char *const lacks = lacks_of(&scene_file_table(head)[i]);
        if (lacks != NULL) {
            return lacks;
        }
    }
    return !scene_motion_right(head)      ? "is broken: its animation is not inside it"
           : !scene_motion_can_move(head) ? "is broken: its animation cannot be played"
                                          : NULL;
}

size_t scene_file_table_bytes(uint32_t mesh_count, bool on_32)
{
    return ROUND8(mesh_count * (on_32 ? MESH_BYTES_32 : sizeof(struct ph_mesh))) +
           ROUND8(mesh_count * (on_32 ? DRAWN_BYTES_32 : sizeof(struct drawn)));
}

size_t scene_file_arena_bytes(const void *bytes, bool on_32)
{
    const struct scene_file_head *const head = bytes;
    return scene_file_table_bytes(head->mesh_count, on_32) + scene_motion_bytes(head, on_32);
}

static struct ph_texture texture_of(const uint8_t *base, const struct scene_file_texture *from)
{
    if (from->texels == 0) { /* its other members may have any values */
        return (struct ph_texture){.texels = NULL};
    }
    return (struct ph_texture){.texels = (const void *)(base + from->texels),
                               .log2_width = from->log2_width,
                               .log2_height = from->log2_height,
                               .wrap = scene_file_wrap(from->wrap),
                               .filter = scene_file_filters[from->filter].filter,
                               .levels = from->levels};
}

static const uint8_t blend_kinds[] = {
    [SCENE_FILE_MASK] = PH_BLEND_MASK,
    [SCENE_FILE_ALPHA] = PH_BLEND_ALPHA,
    [SCENE_FILE_ADD] = PH_BLEND_ADD,
    [SCENE_FILE_TIMES] = PH_BLEND_TIMES,
};

static void set_drawn(struct drawn *d, const uint8_t *base, const struct scene_file_mesh *m)
{
    d->part = (struct ph_part){.count = m->triangle_count};
    d->texture = texture_of(base, &m->texture);
    d->alphas = texture_of(base, &m->alphas);
    d->blend = (struct ph_blend){.draw = ph_draw_blended_alphas,
                                 .kind = blend_kinds[m->blend],
                                 .alpha = m->alpha,
                                 .alphas = m->alphas.texels != 0 ? &d->alphas : NULL};
    d->material = (struct ph_material){.shading = scene_file_shadings[m->shading].shading,
                                       .two_sided = m->two_sided != 0,
                                       .shininess_log2 = m->shininess_log2,
                                       .depth_bias = m->depth_bias,
                                       .ambient = m->ambient,
                                       .diffuse = m->diffuse,
                                       .specular = m->specular,
                                       .colour = m->colour,
                                       .ramp = (const void *)(base + m->ramp),
                                       .texture = m->texture.texels != 0 ? &d->texture : NULL,
                                       .blend = m->blend != SCENE_FILE_OPAQUE ? &d->blend : NULL};
}

struct ph_mesh *scene_file_meshes(const void *bytes, struct demo_arena *arena)
{
    const struct scene_file_head *const head = bytes;
    const uint8_t *const base = bytes;
    struct ph_mesh *const meshes = demo_alloc(arena, head->mesh_count * sizeof(*meshes));
    struct drawn *const drawn = demo_alloc(arena, head->mesh_count * sizeof(*drawn));
    for (uint32_t i = 0; meshes && drawn && i < head->mesh_count; i++) {
        const struct scene_file_mesh *const m = &scene_file_table(head)[i];
        set_drawn(&drawn[i], base, m);
        meshes[i] = (struct ph_mesh){.positions = m->moving != 0 ? NULL : (const void *)(base + m->positions),
                                     .normals = (const void *)(base + m->normals),
                                     .uvs = m->uvs != 0 ? (const void *)(base + m->uvs) : NULL,
                                     .triangles = (const void *)(base + m->triangles),
                                     .parts = &drawn[i].part,
                                     .materials = &drawn[i].material,
                                     .colours = m->colours != 0 ? (const void *)(base + m->colours) : NULL,
                                     .vertex_count = m->vertex_count,
                                     .triangle_count = m->triangle_count,
                                     .part_count = 1};
        if (m->moving == 0) {
            ph_mesh_bounds(&meshes[i], &drawn[i].bounds);
        }
    }
    return drawn ? meshes : NULL;
}

struct demo_eye scene_file_eye(const struct scene_file_head *head)
{
    struct demo_eye eye = {.view = {.t = {head->t[0], head->t[1], head->t[2]}},
                           .lens = {.kind = head->lens_kind == PH_ORTHOGRAPHIC ? PH_ORTHOGRAPHIC : PH_PERSPECTIVE,
                                    .scale_x_q20 = head->scale_x_q20,
                                    .scale_y_q20 = head->scale_y_q20,
                                    .near_z = head->near_z,
                                    .far_z = head->far_z}};
    memcpy(eye.view.r, head->r, sizeof(eye.view.r));
    return eye;
}

static int init(struct demo_context *context)
{
    const struct scene_file_head *const head = context->state;
    const struct ph_mesh *const meshes = scene_file_meshes(head, &context->arena);
    const struct animation *const animation = head->motion ? scene_motion_make(head, &context->arena) : NULL;
    const struct demo_eye eye = scene_file_eye(head);
    const bool is_still = (head->flags & SCENE_FILE_CAMERA) != 0;
    context->studio = (head->flags & SCENE_FILE_STUDIO) != 0 ? scene_file_at(head, scene_file_studio(head)) : NULL;
    if (!meshes || (head->motion && !animation)) {
        return PH_ERR_NOMEM;
    }
    return animation  ? animation_init(context, animation, meshes, head->mesh_count, is_still ? &eye : NULL)
           : is_still ? demo_still_init(context, meshes, head->mesh_count, &eye)
                      : demo_turntable_init(context, meshes, head->mesh_count, (struct fx_vec3){0, 0, 0});
}

struct demo scene_file_demo(const void *bytes)
{
    const struct scene_file_head *const head = bytes;
    const bool is_still = (head->flags & SCENE_FILE_CAMERA) != 0;
    const size_t base = is_still                               ? DEMO_STILL_BYTES
                        : (head->flags & SCENE_FILE_BARE) != 0 ? DEMO_TURNTABLE_BARE_BYTES
                                                               : DEMO_TURNTABLE_BYTES;
    return (struct demo){.name = head->name,
                         .summary = "a binary scene",
                         .loop_frames = 256,
                         .arena_bytes = base + scene_file_arena_bytes(bytes, false),
                         .arena_bytes_32 = (uint32_t)(base + scene_file_arena_bytes(bytes, true)),
                         .vertex_max = head->vertex_max,
                         .triangle_max = head->triangle_max,
                         .init = init,
                         .select = head->motion ? animation_select : NULL,
                         .frame = head->motion ? animation_frame
                                  : is_still   ? demo_still_frame
                                               : demo_turntable_frame};
}
