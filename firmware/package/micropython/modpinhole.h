/* modpinhole: what the files of the module share. See modpinhole.c. */
#ifndef MODPINHOLE_H
#define MODPINHOLE_H

#include "py/obj.h"
#include "py/runtime.h"

#include "render.h"

#if !MICROPY_PY_BUILTINS_FLOAT
#error "pinhole: this port of MicroPython has no float: set MICROPY_FLOAT_IMPL to MICROPY_FLOAT_IMPL_FLOAT"
#endif

extern const mp_obj_type_t pinhole_renderer, pinhole_mesh, pinhole_texture, pinhole_model;

struct texture {
    mp_obj_base_t base;
    struct ph_texture of;
};

struct mesh {
    mp_obj_base_t base;
    struct ph_mesh of;
    struct ph_part part;
    struct ph_material material;
    struct ph_sphere bounds;
    mp_obj_t texture; /* keeps it */
    uint16_t ramp[PH_RAMP_SIZE];
};

struct renderer {
    mp_obj_base_t base;
    uint64_t *memory;
    mp_obj_t drawn; /* a list of what the frame shows: it must stay until the next one has begun */
    mp_obj_t to;    /* of show() */
    uint8_t *at;
    struct ph_renderer r;
};

/* A new frame has begun: what the last one showed need not stay. */
void pinhole_forget_drawn(struct renderer *o);

/* Raises what a status of status.h stands for; nothing for 0. */
void pinhole_raise_if(int status);

/* Numbers of Python as those of fx.h; what is beyond saturates, and NaN raises ValueError. */
fx_t pinhole_fx(mp_obj_t number);
struct fx_vec3 pinhole_vec(mp_obj_t three);

/* A colour, 0 .. 0xffffff; else ValueError. */
uint32_t pinhole_rgb(mp_obj_t rgb);

/* 0xRRGGBB in wire order, and a colour of the wire as this machine's uint16_t, or back. */
uint16_t pinhole_colour(mp_obj_t rgb);
uint16_t pinhole_native(uint16_t pixel);

/* The object, if it has that type, or a class of Python that is made of it; else TypeError. */
void *pinhole_want(mp_obj_t of, const mp_obj_type_t *type);

#endif
