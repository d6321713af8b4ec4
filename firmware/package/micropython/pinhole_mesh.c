/* pinhole_mesh: Texture and Mesh of the module. See modpinhole.c. */
#include "modpinhole.h"

#include "status.h"

#include <string.h>

static uint8_t log2_of(mp_int_t side)
{
    uint8_t log2 = 0;
    while (log2 < PH_TEXTURE_LOG2_MAX && 1 << log2 < side) {
        log2++;
    }
    if (1 << log2 != side) {
        mp_raise_ValueError(MP_ERROR_TEXT("a texture's sides are 1, 2, 4 .. 1024"));
    }
    return log2;
}

/* Texture(texels, width, height, order=NATIVE, smooth=False, repeat=True): RGB565, rows from the top; they are copied.
 */
static mp_obj_t texture_make(const mp_obj_type_t *type, size_t n_args, size_t n_kw, const mp_obj_t *args)
{
    enum { TEXELS, WIDTH, HEIGHT, ORDER, SMOOTH, REPEAT };
    static const mp_arg_t allowed[] = {
        {MP_QSTR_texels, MP_ARG_REQUIRED | MP_ARG_OBJ, {0}}, {MP_QSTR_width, MP_ARG_REQUIRED | MP_ARG_INT, {0}},
        {MP_QSTR_height, MP_ARG_REQUIRED | MP_ARG_INT, {0}}, {MP_QSTR_order, MP_ARG_INT, {.u_int = PH_PIXELS_NATIVE}},
        {MP_QSTR_smooth, MP_ARG_BOOL, {.u_bool = false}},    {MP_QSTR_repeat, MP_ARG_BOOL, {.u_bool = true}},
    };
    mp_arg_val_t a[MP_ARRAY_SIZE(allowed)];
    mp_buffer_info_t from;
    mp_arg_parse_all_kw_array(n_args, n_kw, args, MP_ARRAY_SIZE(allowed), allowed, a);
    const uint8_t log2_width = log2_of(a[WIDTH].u_int), log2_height = log2_of(a[HEIGHT].u_int);
    if (a[ORDER].u_int != PH_PIXELS_WIRE && a[ORDER].u_int != PH_PIXELS_NATIVE) {
        mp_raise_ValueError(MP_ERROR_TEXT("order is WIRE or NATIVE"));
    }
    const size_t count = (size_t)1 << (log2_width + log2_height);
    mp_get_buffer_raise(a[TEXELS].u_obj, &from, MP_BUFFER_READ);
    if (from.len < 2 * count) {
        mp_raise_msg_varg(&mp_type_ValueError, MP_ERROR_TEXT("%d bytes of texels are needed, not %d"), (int)(2 * count),
                          (int)from.len);
    }
    struct texture *const t = mp_obj_malloc(struct texture, type);
    uint16_t *const texels = m_new(uint16_t, count);
    memcpy(texels, from.buf, 2 * count);
    for (size_t i = 0; a[ORDER].u_int == PH_PIXELS_NATIVE && i < count; i++) {
        texels[i] = pinhole_native(texels[i]);
    }
    t->of = (struct ph_texture){.texels = texels,
                                .log2_width = log2_width,
                                .log2_height = log2_height,
                                .wrap = a[REPEAT].u_bool ? PH_WRAP_REPEAT : PH_WRAP_CLAMP,
                                .filter = a[SMOOTH].u_bool ? PH_FILTER_BILINEAR : PH_FILTER_NEAREST};
    return MP_OBJ_FROM_PTR(t);
}

MP_DEFINE_CONST_OBJ_TYPE(pinhole_texture, MP_QSTR_Texture, MP_TYPE_FLAG_NONE, make_new, texture_make);

/* The direction of a vector in Q1.14; that of no vector is up. */
static void set_normal(int16_t to[3], struct fx_vec3 v)
{
    struct fx_vec3 unit;
    if (!fx_vec3_direction_q30(v, &unit)) {
        unit = (struct fx_vec3){0, FX_Q30_ONE, 0};
    }
    to[0] = (int16_t)(unit.x >> 16);
    to[1] = (int16_t)(unit.y >> 16);
    to[2] = (int16_t)(unit.z >> 16);
}

/* The sum of the normals of a vertex's triangles becomes its normal: a unit vector in Q1.14. */
static void smooth_normals(const struct ph_mesh *mesh, int16_t (*normals)[3])
{
    mp_float_t(*const sums)[3] = (void *)m_new0(mp_float_t, 3 * (size_t)mesh->vertex_count);
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        const uint16_t *const corner = mesh->triangles[t];
        const struct fx_vec3 *const p = mesh->positions, a = p[corner[0]], b = p[corner[1]], c = p[corner[2]];
        const mp_float_t u[3] = {(mp_float_t)b.x - a.x, (mp_float_t)b.y - a.y, (mp_float_t)b.z - a.z};
        const mp_float_t v[3] = {(mp_float_t)c.x - a.x, (mp_float_t)c.y - a.y, (mp_float_t)c.z - a.z};
        for (int i = 0; i < 9; i++) {
            const int k = i % 3;
            sums[corner[i / 3]][k] += (u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]) / 65536;
        }
    }
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        mp_float_t most = MICROPY_FLOAT_CONST(1e-30);
        for (int k = 0; k < 3; k++) {
            const mp_float_t size = sums[i][k] < 0 ? -sums[i][k] : sums[i][k];
            most = size > most ? size : most;
        }
        const struct fx_vec3 v = {(fx_t)(sums[i][0] / most * 65536), (fx_t)(sums[i][1] / most * 65536),
                                  (fx_t)(sums[i][2] / most * 65536)};
        set_normal(normals[i], v);
    }
    m_del(mp_float_t, (void *)sums, 3 * (size_t)mesh->vertex_count);
}

static void *room_for_all(mp_obj_t from, size_t size, uint32_t *count, uint32_t most, const char *name)
{
    size_t n;
    mp_obj_t *of;
    mp_obj_get_array(from, &n, &of);
    if (n == 0 || n > most) {
        mp_raise_msg_varg(&mp_type_ValueError, MP_ERROR_TEXT("1 to %d %s, not %d"), (int)most, name, (int)n);
    }
    *count = (uint32_t)n;
    return m_malloc0(size * n);
}

static void set_triangles(struct mesh *m, mp_obj_t from)
{
    uint16_t(*const to)[3] = room_for_all(from, sizeof *to, &m->of.triangle_count, 1 << 20, "triangles");
    size_t n;
    mp_obj_t *of, *corner;
    mp_obj_get_array(from, &n, &of);
    for (size_t i = 0; i < 3 * n; i++) {
        mp_obj_get_array_fixed_n(of[i / 3], 3, &corner);
        const mp_int_t v = mp_obj_get_int(corner[i % 3]);
        if (v < 0 || v >= (mp_int_t)m->of.vertex_count) {
            mp_raise_msg_varg(&mp_type_ValueError, MP_ERROR_TEXT("triangle %d has vertex %d, of %d"), (int)(i / 3),
                              (int)v, (int)m->of.vertex_count);
        }
        to[i / 3][i % 3] = (uint16_t)v;
    }
    m->of.triangles = to;
}

/* An array with something for each vertex; NULL for None. */
static mp_obj_t *of_vertices(const struct mesh *m, mp_obj_t from, const char *name)
{
    size_t n;
    mp_obj_t *of;
    if (from == mp_const_none) {
        return NULL;
    }
    mp_obj_get_array(from, &n, &of);
    if (n != m->of.vertex_count) {
        mp_raise_msg_varg(&mp_type_ValueError, MP_ERROR_TEXT("%d %s for %d positions"), (int)n, name,
                          (int)m->of.vertex_count);
    }
    return of;
}

static void set_uvs(struct mesh *m, mp_obj_t *from)
{
    fx_t(*const uvs)[2] = m_malloc(sizeof *uvs * m->of.vertex_count);
    for (uint32_t i = 0; i < m->of.vertex_count; i++) {
        mp_obj_t *uv;
        mp_obj_get_array_fixed_n(from[i], 2, &uv);
        uvs[i][0] = pinhole_fx(uv[0]), uvs[i][1] = pinhole_fx(uv[1]);
    }
    m->of.uvs = uvs;
}

static void set_normals(struct mesh *m, mp_obj_t *from)
{
    int16_t(*const normals)[3] = m_malloc(sizeof *normals * m->of.vertex_count);
    m->of.normals = (const int16_t(*)[3])normals;
    if (from == NULL) {
        smooth_normals(&m->of, normals);
    }
    for (uint32_t i = 0; from != NULL && i < m->of.vertex_count; i++) {
        set_normal(normals[i], pinhole_vec(from[i]));
    }
}

static void set_colours(struct mesh *m, mp_obj_t *from)
{
    uint16_t *const colours = m_new(uint16_t, m->of.vertex_count);
    for (uint32_t i = 0; i < m->of.vertex_count; i++) {
        colours[i] = pinhole_colour(from[i]);
    }
    m->of.colours = colours;
}

/* A colour, or a texture or None, and whether it is lit, as the mesh's material. */
static void set_material(struct mesh *m, mp_obj_t colour, mp_obj_t texture, bool lit)
{
    const uint32_t rgb = pinhole_rgb(colour);
    const bool textured = texture != mp_const_none;
    ph_material_ramp(m->ramp, (uint8_t)(rgb >> 16), (uint8_t)(rgb >> 8), (uint8_t)rgb, 0);
    m->texture = texture;
    m->material = (struct ph_material){
        .shading = textured ? (lit ? PH_SHADE_TEXTURE_GOURAUD : PH_SHADE_TEXTURE)
                   : lit    ? PH_SHADE_GOURAUD
                            : PH_SHADE_UNLIT,
        .ambient = FX_ONE,
        .diffuse = FX_ONE,
        .colour = pinhole_colour(colour),
        .ramp = m->ramp,
        .texture = textured ? &((struct texture *)pinhole_want(texture, &pinhole_texture))->of : NULL};
}

/*
 * Mesh(positions, triangles, colour=0xcccccc, normals=None, uvs=None, colours=None, texture=None, lit=True,
 * two_sided=False): triangles are counter-clockwise seen from outside. A lit mesh without normals gets smooth ones.
 */
static mp_obj_t mesh_make(const mp_obj_type_t *type, size_t n_args, size_t n_kw, const mp_obj_t *args)
{
    enum { POSITIONS, TRIANGLES, COLOUR, NORMALS, UVS, COLOURS, TEXTURE, LIT, TWO_SIDED };
    static const mp_arg_t allowed[] = {
        {MP_QSTR_positions, MP_ARG_REQUIRED | MP_ARG_OBJ, {0}},
        {MP_QSTR_triangles, MP_ARG_REQUIRED | MP_ARG_OBJ, {0}},
        {MP_QSTR_colour, MP_ARG_OBJ, {.u_obj = MP_OBJ_NEW_SMALL_INT(0xcccccc)}},
        {MP_QSTR_normals, MP_ARG_OBJ, {.u_obj = mp_const_none}},
        {MP_QSTR_uvs, MP_ARG_OBJ, {.u_obj = mp_const_none}},
        {MP_QSTR_colours, MP_ARG_OBJ, {.u_obj = mp_const_none}},
        {MP_QSTR_texture, MP_ARG_OBJ, {.u_obj = mp_const_none}},
        {MP_QSTR_lit, MP_ARG_BOOL, {.u_bool = true}},
        {MP_QSTR_two_sided, MP_ARG_BOOL, {.u_bool = false}},
    };
    mp_arg_val_t a[MP_ARRAY_SIZE(allowed)];
    mp_arg_parse_all_kw_array(n_args, n_kw, args, MP_ARRAY_SIZE(allowed), allowed, a);
    struct mesh *const m = mp_obj_malloc(struct mesh, type);
    memset(&m->of, 0, sizeof m->of);
    struct fx_vec3 *const positions =
        room_for_all(a[POSITIONS].u_obj, sizeof *positions, &m->of.vertex_count, 65536, "positions");
    mp_obj_t *const of = of_vertices(m, a[POSITIONS].u_obj, "positions"),
                    *const uvs = of_vertices(m, a[UVS].u_obj, "uvs"),
                    *const colours = of_vertices(m, a[COLOURS].u_obj, "colours");
    m->of.positions = positions;
    for (uint32_t i = 0; i < m->of.vertex_count; i++) {
        positions[i] = pinhole_vec(of[i]);
    }
    set_triangles(m, a[TRIANGLES].u_obj);
    const bool lit = a[LIT].u_bool, textured = a[TEXTURE].u_obj != mp_const_none;
    if (textured && uvs == NULL) {
        mp_raise_ValueError(MP_ERROR_TEXT("a texture needs uvs"));
    }
    if (textured && colours != NULL) {
        mp_raise_ValueError(MP_ERROR_TEXT("a mesh has colours or a texture, not both"));
    }
    if (lit) {
        set_normals(m, of_vertices(m, a[NORMALS].u_obj, "normals"));
    }
    if (textured) {
        set_uvs(m, uvs);
    } else if (colours != NULL) {
        set_colours(m, colours);
    }
    set_material(m, a[COLOUR].u_obj, a[TEXTURE].u_obj, lit);
    m->material.two_sided = a[TWO_SIDED].u_bool;
    m->part = (struct ph_part){0, m->of.triangle_count, 0};
    m->of.parts = &m->part, m->of.materials = &m->material;
    m->of.part_count = m->of.material_count = 1;
    const struct ph_finding found = ph_check_mesh(&m->of);
    if (found.what != NULL) {
        mp_raise_msg_varg(&mp_type_ValueError, MP_ERROR_TEXT("%s: number %d"), found.what, (int)found.number);
    }
    pinhole_raise_if(ph_mesh_bounds(&m->of, &m->bounds));
    return MP_OBJ_FROM_PTR(m);
}

MP_DEFINE_CONST_OBJ_TYPE(pinhole_mesh, MP_QSTR_Mesh, MP_TYPE_FLAG_NONE, make_new, mesh_make);
