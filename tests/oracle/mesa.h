/*
 * mesa: Mesa's software renderer without a screen. All of it is in this header, because the shared files of the tests
 * are also built on machines without Mesa.
 */
#ifndef MESA_H
#define MESA_H

#include <GL/osmesa.h>

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

struct mesa {
    OSMesaContext context;
    uint8_t *frame;
    int width, height;
};

/* A context with a depth buffer of 32 bits, made current; false where Mesa has none. */
static inline bool mesa_open(struct mesa *m, int width, int height)
{
    *m = (struct mesa){OSMesaCreateContextExt(OSMESA_RGBA, 32, 0, 0, NULL), malloc(4u * (size_t)(width * height)),
                       width, height};
    if (!m->context || !m->frame || !OSMesaMakeCurrent(m->context, m->frame, GL_UNSIGNED_BYTE, width, height)) {
        return false;
    }
    glViewport(0, 0, width, height);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    return true;
}

static inline void mesa_close(struct mesa *m)
{
    OSMesaDestroyContext(m->context);
    free(m->frame);
}

/* Finishes the picture; window depth (1 where nothing was drawn) and red, green, blue, rows from the top. */
static inline void mesa_read(const struct mesa *m, float *depth, uint8_t (*rgb)[3])
{
    glFinish();
    for (int y = 0; y < m->height; y++) {
        const int from_top = m->height - 1 - y;
        glReadPixels(0, y, m->width, 1, GL_DEPTH_COMPONENT, GL_FLOAT, depth + from_top * m->width);
        glReadPixels(0, y, m->width, 1, GL_RGB, GL_UNSIGNED_BYTE, rgb + from_top * m->width);
    }
}

#endif
