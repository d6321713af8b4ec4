/*
 * modpinhole: Pinhole as a module of MicroPython, `import pinhole`. hello.py beside it shows all of it.
 *
 *   Renderer(width, height, vertices=, triangles=, lines=16, order=NATIVE)   a picture, and room for what is drawn
 *   .begin(eye, target, fov=60, near=.5, far=100, background=, ambient=, lights=)
 *   .draw(mesh, position=, turn=, scale=)    .show(to)    .text(to, x, y, text)    .stats()
 *   Mesh(positions, triangles, ..)    Texture(texels, width, height, ..)    Model(binary scene)
 *
 * Positions are in any unit, angles in degrees, colours 0xRRGGBB, orders WIRE, NATIVE (both RGB565) or RGB888 (without
 * text). What is wrong raises ValueError, a call out of turn RuntimeError, and what has no room MemoryError.
 */
#include "modpinhole.h"

#include "status.h"

void pinhole_raise_if(int status)
{
    switch (status) {
    case PH_OK:
        return;
    case PH_ERR_NOMEM:
        mp_raise_msg(&mp_type_MemoryError, MP_ERROR_TEXT("the Renderer has too few vertices for it"));
    case PH_ERR_STATE:
        mp_raise_msg(&mp_type_RuntimeError,
                     MP_ERROR_TEXT("no frame has begun: call begin() before each show(), not inside one"));
    case PH_ERR_RANGE:
        mp_raise_ValueError(MP_ERROR_TEXT("the camera's numbers do not fit Q16.16: see ph_frame_begin() of render.h"));
    default:
        mp_raise_ValueError(MP_ERROR_TEXT("near, far, fov or a size makes no sense: 0 < near < far is needed"));
    }
}

fx_t pinhole_fx(mp_obj_t number)
{
    const mp_float_t v = mp_obj_get_float(number) * 65536;
    if (v != v) {
        mp_raise_ValueError(MP_ERROR_TEXT("NaN is no number of Pinhole"));
    }
    return v >= 2147483647    ? FX_MAX
           : v <= -2147483647 ? FX_MIN
                              : (fx_t)(v < 0 ? v - MICROPY_FLOAT_CONST(.5) : v + MICROPY_FLOAT_CONST(.5));
}

struct fx_vec3 pinhole_vec(mp_obj_t three)
{
    mp_obj_t *of;
    mp_obj_get_array_fixed_n(three, 3, &of);
    return (struct fx_vec3){pinhole_fx(of[0]), pinhole_fx(of[1]), pinhole_fx(of[2])};
}

uint32_t pinhole_rgb(mp_obj_t rgb)
{
    const mp_int_t v = mp_obj_get_int(rgb);
    if (v < 0 || v > 0xffffff) {
        mp_raise_ValueError(MP_ERROR_TEXT("a colour is 0 .. 0xffffff"));
    }
    return (uint32_t)v;
}

uint16_t pinhole_colour(mp_obj_t rgb)
{
    const uint32_t v = pinhole_rgb(rgb);
    return ph_rgb565((uint8_t)(v >> 16), (uint8_t)(v >> 8), (uint8_t)v);
}

uint16_t pinhole_native(uint16_t pixel)
{
    return MP_ENDIANNESS_LITTLE ? (uint16_t)(pixel << 8 | pixel >> 8) : pixel;
}

void *pinhole_want(mp_obj_t of, const mp_obj_type_t *type)
{
    const mp_obj_t native = mp_obj_cast_to_native_base(of, MP_OBJ_FROM_PTR(type));
    if (native == MP_OBJ_NULL || !mp_obj_is_type(native, type)) { /* it is a class before super().__init__() */
        mp_raise_msg_varg(&mp_type_TypeError, MP_ERROR_TEXT("%q is needed, not %s"), type->name,
                          mp_obj_get_type_str(of));
    }
    return MP_OBJ_TO_PTR(native);
}

static const mp_rom_map_elem_t names[] = {
    {MP_ROM_QSTR(MP_QSTR___name__), MP_ROM_QSTR(MP_QSTR_pinhole)},
    {MP_ROM_QSTR(MP_QSTR_Renderer), MP_ROM_PTR(&pinhole_renderer)},
    {MP_ROM_QSTR(MP_QSTR_Mesh), MP_ROM_PTR(&pinhole_mesh)},
    {MP_ROM_QSTR(MP_QSTR_Texture), MP_ROM_PTR(&pinhole_texture)},
    {MP_ROM_QSTR(MP_QSTR_Model), MP_ROM_PTR(&pinhole_model)},
    {MP_ROM_QSTR(MP_QSTR_WIRE), MP_ROM_INT(PH_PIXELS_WIRE)},
    {MP_ROM_QSTR(MP_QSTR_NATIVE), MP_ROM_INT(PH_PIXELS_NATIVE)},
    {MP_ROM_QSTR(MP_QSTR_RGB888), MP_ROM_INT(PH_PIXELS_RGB888)},
};
static MP_DEFINE_CONST_DICT(module_dict, names);

const mp_obj_module_t pinhole_module = {.base = {&mp_type_module}, .globals = (mp_obj_dict_t *)&module_dict};
MP_REGISTER_MODULE(MP_QSTR_pinhole, pinhole_module);
