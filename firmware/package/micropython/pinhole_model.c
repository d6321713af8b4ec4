/* pinhole_model: Model of the module, a binary scene. See modpinhole.c. */
#include "modpinhole.h"

#include "scene_file.h"

#include <string.h>

struct scene_model {
    mp_obj_base_t base;
    mp_obj_t data; /* keeps it */
    const void *bytes;
    struct demo demo;
    struct demo_context context;
    mp_obj_t renderer; /* that it was begun for; or None */
};

/* Model(data): a binary scene, FILE.phs of pinhole-asset, drawn where it lies: bytes, or flash by a memoryview.
 * They must stay as they are: a bytearray that is changed or grows later brings the program down. */
static mp_obj_t model_make(const mp_obj_type_t *type, size_t n_args, size_t n_kw, const mp_obj_t *args)
{
    mp_buffer_info_t data;
    mp_arg_check_num(n_args, n_kw, 1, 1, false);
    mp_get_buffer_raise(args[0], &data, MP_BUFFER_READ);
    if ((uintptr_t)data.buf % 4 != 0) {
        mp_raise_ValueError(MP_ERROR_TEXT("a scene lies at an address that is a multiple of 4: give bytes of its own"));
    }
    const char *const wrong = scene_file_wrong(data.buf, data.len);
    if (wrong != NULL) {
        mp_raise_msg_varg(&mp_type_ValueError, MP_ERROR_TEXT("the scene %s"), wrong);
    }
    struct scene_model *const m = mp_obj_malloc(struct scene_model, type);
    m->data = args[0];
    m->bytes = data.buf;
    m->demo = scene_file_demo(data.buf);
    m->renderer = mp_const_none;
    return MP_OBJ_FROM_PTR(m);
}

/* The frame needs the model, and the arena even when the model has taken another one for another renderer. */
static void keep(const struct scene_model *m, struct renderer *o)
{
    mp_obj_list_append(o->drawn, MP_OBJ_FROM_PTR(m));
    mp_obj_list_append(o->drawn, MP_OBJ_FROM_PTR(m->context.arena.base));
}

/* draw(renderer, frame=0, orbit=0): all of a frame, in place of begin() and draw(): the turntable, or the file's
 * camera. */
static mp_obj_t model_draw(size_t n_args, const mp_obj_t *args, mp_map_t *kw)
{
    enum { RENDERER, FRAME, ORBIT };
    static const mp_arg_t allowed[] = {
        {MP_QSTR_renderer, MP_ARG_REQUIRED | MP_ARG_OBJ, {0}},
        {MP_QSTR_frame, MP_ARG_INT, {.u_int = 0}},
        {MP_QSTR_orbit, MP_ARG_OBJ, {.u_obj = MP_OBJ_NEW_SMALL_INT(0)}},
    };
    struct scene_model *const m = MP_OBJ_TO_PTR(args[0]);
    mp_arg_val_t a[MP_ARRAY_SIZE(allowed)];
    mp_arg_parse_all(n_args - 1, args + 1, kw, MP_ARRAY_SIZE(allowed), allowed, a);
    struct renderer *const o = pinhole_want(a[RENDERER].u_obj, &pinhole_renderer);
    if (m->renderer != a[RENDERER].u_obj) {
        m->renderer = mp_const_none;
        memset(&m->context, 0, sizeof m->context);
        m->context.arena.size = m->demo.arena_bytes;
        m->context.arena.base = m_new(uint8_t, m->demo.arena_bytes);
        m->context.state = (void *)(uintptr_t)m->bytes;
        m->context.width = o->r.config.width;
        m->context.height = o->r.config.height;
        pinhole_raise_if(m->demo.init(&m->context));
        m->renderer = a[RENDERER].u_obj;
    }
    m->context.orbit = fx_turn32_from_deg(pinhole_fx(a[ORBIT].u_obj));
    keep(m, o);
    pinhole_raise_if(m->demo.frame(&m->context, &o->r, (uint32_t)a[FRAME].u_int));
    pinhole_forget_drawn(o);
    keep(m, o); /* the list has room now */
    return mp_const_none;
}
static MP_DEFINE_CONST_FUN_OBJ_KW(model_draw_obj, 1, model_draw);

/* need(): (vertices, triangles) that a Renderer must have for it. */
static mp_obj_t model_need(mp_obj_t self)
{
    const struct scene_model *const m = MP_OBJ_TO_PTR(self);
    const mp_obj_t two[2] = {mp_obj_new_int_from_uint(m->demo.vertex_max),
                             mp_obj_new_int_from_uint(m->demo.triangle_max)};
    return mp_obj_new_tuple(2, two);
}
static MP_DEFINE_CONST_FUN_OBJ_1(model_need_obj, model_need);

static const mp_rom_map_elem_t model_names[] = {
    {MP_ROM_QSTR(MP_QSTR_draw), MP_ROM_PTR(&model_draw_obj)},
    {MP_ROM_QSTR(MP_QSTR_need), MP_ROM_PTR(&model_need_obj)},
};
static MP_DEFINE_CONST_DICT(model_dict, model_names);
MP_DEFINE_CONST_OBJ_TYPE(pinhole_model, MP_QSTR_Model, MP_TYPE_FLAG_NONE, make_new, model_make, locals_dict,
                         &model_dict);
