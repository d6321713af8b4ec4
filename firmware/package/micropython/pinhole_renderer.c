/* pinhole_renderer: Renderer of the module: frames, cameras, lights, text. See modpinhole.c. */
#include "modpinhole.h"

#include "overlay.h"
#include "status.h"

#include "py/objarray.h"

#include <string.h>

/* Renderer(width, height, vertices=1000, triangles=1000, lines=16, order=NATIVE): vertices of the largest mesh, and the
 * triangles that are seen at once. Its memory is 16 and 24 bytes for each, and 4 for each pixel of `lines`. */
static mp_obj_t renderer_make(const mp_obj_type_t *type, size_t n_args, size_t n_kw, const mp_obj_t *args)
{
    enum { WIDTH, HEIGHT, VERTICES, TRIANGLES, LINES, ORDER };
    static const mp_arg_t allowed[] = {
        {MP_QSTR_width, MP_ARG_REQUIRED | MP_ARG_INT, {0}}, {MP_QSTR_height, MP_ARG_REQUIRED | MP_ARG_INT, {0}},
        {MP_QSTR_vertices, MP_ARG_INT, {.u_int = 1000}},    {MP_QSTR_triangles, MP_ARG_INT, {.u_int = 1000}},
        {MP_QSTR_lines, MP_ARG_INT, {.u_int = 16}},         {MP_QSTR_order, MP_ARG_INT, {.u_int = PH_PIXELS_NATIVE}},
    };
    mp_arg_val_t a[MP_ARRAY_SIZE(allowed)];
    mp_arg_parse_all_kw_array(n_args, n_kw, args, MP_ARRAY_SIZE(allowed), allowed, a);
    const mp_int_t width = a[WIDTH].u_int, height = a[HEIGHT].u_int;
    const mp_int_t lines = a[LINES].u_int < height ? a[LINES].u_int : height;
    if (width < 1 || width > 1024 || height < 1 || height > 1024 || lines < 1) {
        mp_raise_ValueError(MP_ERROR_TEXT("width and height are 1 .. 1024, and lines 1 or more"));
    }
    if (a[VERTICES].u_int < 4 || a[VERTICES].u_int > 65536 || a[TRIANGLES].u_int < 1 || a[TRIANGLES].u_int > 1000000) {
        mp_raise_ValueError(MP_ERROR_TEXT("vertices are 4 .. 65536, triangles 1 .. 1000000"));
    }
    if (a[ORDER].u_int < PH_PIXELS_WIRE || a[ORDER].u_int > PH_PIXELS_RGB888) {
        mp_raise_ValueError(MP_ERROR_TEXT("order is WIRE, NATIVE or RGB888"));
    }
    struct renderer *const o = mp_obj_malloc(struct renderer, type);
    struct ph_config config = {.width = (uint16_t)width,
                               .height = (uint16_t)height,
                               .band_height = (uint16_t)lines,
                               .pixel_order = (uint8_t)a[ORDER].u_int,
                               .depth_format = PH_DEPTH_AUTO,
                               .colouring = PH_COLOURS,
                               .vertex_max = (uint32_t)a[VERTICES].u_int,
                               .triangle_max = (uint32_t)a[TRIANGLES].u_int};
    const size_t words =
        PH_MEMORY(config.width, config.band_height, config.vertex_max, config.triangle_max) * sizeof(void *) / 4;
    o->memory = m_new(uint64_t, words);
    o->drawn = mp_obj_new_list(0, NULL);
    pinhole_raise_if(ph_config_memory(&config, o->memory, words * sizeof *o->memory));
    pinhole_raise_if(ph_renderer_init(&o->r, &config));
    return MP_OBJ_FROM_PTR(o);
}

/* The list's slots are cleared, so that they keep nothing either. */
void pinhole_forget_drawn(struct renderer *o)
{
    size_t n;
    mp_obj_t *of;
    mp_obj_list_get(o->drawn, &n, &of);
    memset(of, 0, n * sizeof *of);
    mp_obj_list_set_len(o->drawn, 0);
}

/* A light: the direction towards one far away, (x, y, z), or (x, y, z, 0xRRGGBB). */
static struct ph_light light_of(mp_obj_t from)
{
    size_t n;
    mp_obj_t *of;
    struct ph_light light = {.kind = PH_LIGHT_DIRECTIONAL, .intensity = FX_ONE};
    mp_obj_get_array(from, &n, &of);
    if (n < 3 || n > 4) {
        mp_raise_ValueError(MP_ERROR_TEXT("a light is (x, y, z) or (x, y, z, colour)"));
    }
    if (!fx_vec3_direction_q30((struct fx_vec3){pinhole_fx(of[0]), pinhole_fx(of[1]), pinhole_fx(of[2])},
                               &light.to_light_q30)) {
        mp_raise_ValueError(MP_ERROR_TEXT("a light has no direction"));
    }
    if (n == 4) {
        const uint32_t rgb = pinhole_rgb(of[3]);
        light.red = (fx_t)((rgb >> 16 & 255) * FX_ONE / 255);
        light.green = (fx_t)((rgb >> 8 & 255) * FX_ONE / 255);
        light.blue = (fx_t)((rgb & 255) * FX_ONE / 255);
    }
    return light;
}

static mp_obj_t renderer_begin(size_t n_args, const mp_obj_t *args, mp_map_t *kw)
{
    enum { EYE, TARGET, UP, FOV, NEAR, FAR, BACKGROUND, AMBIENT, LIGHTS };
    static const mp_arg_t allowed[] = {
        {MP_QSTR_eye, MP_ARG_REQUIRED | MP_ARG_OBJ, {0}},
        {MP_QSTR_target, MP_ARG_OBJ, {.u_obj = mp_const_none}},
        {MP_QSTR_up, MP_ARG_OBJ, {.u_obj = mp_const_none}},
        {MP_QSTR_fov, MP_ARG_OBJ, {.u_obj = MP_OBJ_NEW_SMALL_INT(60)}},
        {MP_QSTR_near, MP_ARG_OBJ, {.u_obj = mp_const_none}},
        {MP_QSTR_far, MP_ARG_OBJ, {.u_obj = MP_OBJ_NEW_SMALL_INT(100)}},
        {MP_QSTR_background, MP_ARG_OBJ, {.u_obj = MP_OBJ_NEW_SMALL_INT(0)}},
        {MP_QSTR_ambient, MP_ARG_OBJ, {.u_obj = mp_const_none}},
        {MP_QSTR_lights, MP_ARG_OBJ, {.u_obj = mp_const_none}},
    };
    struct renderer *const o = MP_OBJ_TO_PTR(args[0]);
    mp_arg_val_t a[MP_ARRAY_SIZE(allowed)];
    mp_arg_parse_all(n_args - 1, args + 1, kw, MP_ARRAY_SIZE(allowed), allowed, a);
    const struct fx_vec3 origin = {0, 0, 0}, y_up = {0, FX_ONE, 0};
    const struct fx_vec3 target = a[TARGET].u_obj != mp_const_none ? pinhole_vec(a[TARGET].u_obj) : origin;
    const struct fx_vec3 up = a[UP].u_obj != mp_const_none ? pinhole_vec(a[UP].u_obj) : y_up;
    const struct ph_xform view = ph_view_look_at(pinhole_vec(a[EYE].u_obj), target, up);
    struct ph_scene_light light = {.ambient =
                                       a[AMBIENT].u_obj != mp_const_none ? pinhole_fx(a[AMBIENT].u_obj) : FX_ONE / 4};
    struct ph_projection projection;
    const fx_t aspect = (fx_t)((uint32_t)o->r.config.width * 65536u / o->r.config.height);
    const fx_t near = a[NEAR].u_obj != mp_const_none ? pinhole_fx(a[NEAR].u_obj) : FX_HALF;
    pinhole_raise_if(
        ph_projection_perspective(&projection, pinhole_fx(a[FOV].u_obj), aspect, near, pinhole_fx(a[FAR].u_obj)));
    if (a[LIGHTS].u_obj == mp_const_none) {
        const struct fx_vec3 above = {FX_ONE, FX_INT(2), FX_ONE};
        light.lights[light.count++] = (struct ph_light){.kind = PH_LIGHT_DIRECTIONAL, .intensity = FX_ONE * 3 / 4};
        fx_vec3_direction_q30(above, &light.lights[0].to_light_q30);
    } else {
        size_t n;
        mp_obj_t *of;
        mp_obj_get_array(a[LIGHTS].u_obj, &n, &of);
        if (n > PH_LIGHTS_MAX) {
            mp_raise_msg_varg(&mp_type_ValueError, MP_ERROR_TEXT("at most %d lights, not %d"), PH_LIGHTS_MAX, (int)n);
        }
        for (size_t i = 0; i < n; i++) {
            light.lights[light.count++] = light_of(of[i]);
        }
    }
    pinhole_raise_if(ph_frame_begin(&o->r, &view, &projection, &light, pinhole_colour(a[BACKGROUND].u_obj)));
    pinhole_forget_drawn(o);
    return mp_const_none;
}
static MP_DEFINE_CONST_FUN_OBJ_KW(renderer_begin_obj, 1, renderer_begin);

static mp_obj_t renderer_draw(size_t n_args, const mp_obj_t *args, mp_map_t *kw)
{
    enum { MESH, POSITION, TURN, SCALE };
    static const mp_arg_t allowed[] = {
        {MP_QSTR_mesh, MP_ARG_REQUIRED | MP_ARG_OBJ, {0}},
        {MP_QSTR_position, MP_ARG_OBJ, {.u_obj = mp_const_none}},
        {MP_QSTR_turn, MP_ARG_OBJ, {.u_obj = mp_const_none}},
        {MP_QSTR_scale, MP_ARG_OBJ, {.u_obj = MP_OBJ_NEW_SMALL_INT(1)}},
    };
    struct renderer *const o = MP_OBJ_TO_PTR(args[0]);
    mp_arg_val_t a[MP_ARRAY_SIZE(allowed)];
    mp_arg_parse_all(n_args - 1, args + 1, kw, MP_ARRAY_SIZE(allowed), allowed, a);
    const struct mesh *const m = pinhole_want(a[MESH].u_obj, &pinhole_mesh);
    struct ph_xform place = ph_xform_scale(pinhole_fx(a[SCALE].u_obj));
    if (a[TURN].u_obj != mp_const_none) { /* about x first, then y, then z */
        const struct fx_vec3 turn = pinhole_vec(a[TURN].u_obj);
        const struct ph_xform x = ph_xform_rotate_x(fx_turn32_from_deg(turn.x)),
                              y = ph_xform_rotate_y(fx_turn32_from_deg(turn.y)),
                              z = ph_xform_rotate_z(fx_turn32_from_deg(turn.z)), yx = ph_xform_mul(&y, &x),
                              all = ph_xform_mul(&z, &yx);
        place = ph_xform_mul(&all, &place);
    }
    if (a[POSITION].u_obj != mp_const_none) {
        place.t = pinhole_vec(a[POSITION].u_obj);
    }
    mp_obj_list_append(o->drawn, a[MESH].u_obj);
    pinhole_raise_if(ph_draw_mesh(&o->r, &m->of, &place));
    return mp_const_none;
}
static MP_DEFINE_CONST_FUN_OBJ_KW(renderer_draw_obj, 1, renderer_draw);

/* A buffer's rows, or what a function makes of a band: it is called with y, the number of lines and the pixels. */
static int flush(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    struct renderer *const o = context;
    const size_t bytes = (size_t)width * height * ph_pixel_bytes(o->r.config.pixel_order);
    (void)x; /* bands are as wide as the picture */
    if (o->at != NULL) {
        memcpy(o->at, pixels, bytes);
        o->at += bytes;
        return 0;
    }
    const mp_obj_t view = mp_obj_new_memoryview('B', bytes, o->memory); /* of the memory's head, which keeps it */
    ((mp_obj_array_t *)MP_OBJ_TO_PTR(view))->free = (size_t)((const uint8_t *)pixels - (uint8_t *)o->memory);
    const mp_obj_t band[3] = {mp_obj_new_int_from_uint(y), mp_obj_new_int_from_uint(height), view};
    mp_call_function_n_kw(o->to, 3, 0, band);
    return 0;
}

/* show(to): draws the frame into a buffer (a bytearray, a FrameBuffer), or gives it band by band to a function. */
static mp_obj_t renderer_show(mp_obj_t self, mp_obj_t to)
{
    struct renderer *const o = MP_OBJ_TO_PTR(self);
    const size_t bytes = (size_t)o->r.config.width * o->r.config.height * ph_pixel_bytes(o->r.config.pixel_order);
    o->to = to;
    o->at = NULL;
    if (!mp_obj_is_callable(to)) {
        mp_buffer_info_t buffer;
        mp_get_buffer_raise(to, &buffer, MP_BUFFER_WRITE);
        if (buffer.len < bytes) {
            mp_raise_msg_varg(&mp_type_ValueError, MP_ERROR_TEXT("the picture has %d bytes, the buffer %d"), (int)bytes,
                              (int)buffer.len);
        }
        o->at = buffer.buf;
    }
    pinhole_raise_if(ph_show(&o->r, flush, o));
    return mp_const_none;
}
static MP_DEFINE_CONST_FUN_OBJ_2(renderer_show_obj, renderer_show);

/* text(to, x, y, text, colour=0xffffff, outline=None, scale=1): over a picture that show() has drawn into `to`. */
static mp_obj_t renderer_text(size_t n_args, const mp_obj_t *args, mp_map_t *kw)
{
    enum { TO, X, Y, TEXT, COLOUR, OUTLINE, SCALE };
    static const mp_arg_t allowed[] = {
        {MP_QSTR_to, MP_ARG_REQUIRED | MP_ARG_OBJ, {0}},
        {MP_QSTR_x, MP_ARG_REQUIRED | MP_ARG_INT, {0}},
        {MP_QSTR_y, MP_ARG_REQUIRED | MP_ARG_INT, {0}},
        {MP_QSTR_text, MP_ARG_REQUIRED | MP_ARG_OBJ, {0}},
        {MP_QSTR_colour, MP_ARG_OBJ, {.u_obj = MP_OBJ_NEW_SMALL_INT(0xffffff)}},
        {MP_QSTR_outline, MP_ARG_OBJ, {.u_obj = mp_const_none}},
        {MP_QSTR_scale, MP_ARG_INT, {.u_int = 1}},
    };
    struct renderer *const o = MP_OBJ_TO_PTR(args[0]);
    mp_arg_val_t a[MP_ARRAY_SIZE(allowed)];
    mp_buffer_info_t buffer;
    mp_arg_parse_all(n_args - 1, args + 1, kw, MP_ARRAY_SIZE(allowed), allowed, a);
    mp_get_buffer_raise(a[TO].u_obj, &buffer, MP_BUFFER_WRITE);
    const bool is_native = o->r.config.pixel_order == PH_PIXELS_NATIVE;
    if (o->r.config.pixel_order == PH_PIXELS_RGB888) {
        mp_raise_ValueError(MP_ERROR_TEXT("text needs a Renderer of order WIRE or NATIVE"));
    }
    const uint16_t colour = pinhole_colour(a[COLOUR].u_obj),
                   outline = a[OUTLINE].u_obj != mp_const_none ? pinhole_colour(a[OUTLINE].u_obj) : colour;
    const struct ph_overlay_band band = {.pixels = buffer.buf, .width = o->r.config.width, .lines = o->r.config.height};
    const struct ph_overlay_style style = {.colour = is_native ? pinhole_native(colour) : colour,
                                           .outline = is_native ? pinhole_native(outline) : outline,
                                           .scale = (uint8_t)(a[SCALE].u_int < 1   ? 1
                                                              : a[SCALE].u_int > 8 ? 8
                                                                                   : a[SCALE].u_int)};
    if (buffer.len < 2 * (size_t)band.width * (size_t)band.lines || (uintptr_t)buffer.buf % 2 != 0) {
        mp_raise_ValueError(MP_ERROR_TEXT("the buffer is smaller than the picture, or at an odd address"));
    }
    ph_text(&band, a[X].u_int, a[Y].u_int, mp_obj_str_get_str(a[TEXT].u_obj), &style);
    return mp_const_none;
}
static MP_DEFINE_CONST_FUN_OBJ_KW(renderer_text_obj, 1, renderer_text);

/* stats(): (triangles drawn, triangles that had no room, why nothing was drawn, or None) */
static mp_obj_t renderer_stats(mp_obj_t self)
{
    const struct renderer *const o = MP_OBJ_TO_PTR(self);
    const char *const why = ph_why_empty(&o->r);
    const mp_obj_t all[3] = {mp_obj_new_int_from_uint(o->r.stats.triangles_drawn),
                             mp_obj_new_int_from_uint(o->r.stats.triangles_dropped),
                             why != NULL ? mp_obj_new_str(why, strlen(why)) : mp_const_none};
    return mp_obj_new_tuple(3, all);
}
static MP_DEFINE_CONST_FUN_OBJ_1(renderer_stats_obj, renderer_stats);

static const mp_rom_map_elem_t renderer_names[] = {
    {MP_ROM_QSTR(MP_QSTR_begin), MP_ROM_PTR(&renderer_begin_obj)},
    {MP_ROM_QSTR(MP_QSTR_draw), MP_ROM_PTR(&renderer_draw_obj)},
    {MP_ROM_QSTR(MP_QSTR_show), MP_ROM_PTR(&renderer_show_obj)},
    {MP_ROM_QSTR(MP_QSTR_text), MP_ROM_PTR(&renderer_text_obj)},
    {MP_ROM_QSTR(MP_QSTR_stats), MP_ROM_PTR(&renderer_stats_obj)},
};
static MP_DEFINE_CONST_DICT(renderer_dict, renderer_names);
MP_DEFINE_CONST_OBJ_TYPE(pinhole_renderer, MP_QSTR_Renderer, MP_TYPE_FLAG_NONE, make_new, renderer_make, locals_dict,
                         &renderer_dict);
