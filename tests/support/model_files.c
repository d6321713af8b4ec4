/* See model_files.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "stderr_capture.h"
#include "model_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const signed char corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                          {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
static const unsigned char quads[6][4] = {{4, 5, 6, 7}, {1, 0, 3, 2}, {5, 1, 2, 6},
                                          {0, 4, 7, 3}, {7, 6, 2, 3}, {0, 1, 5, 4}};

void file_ones(const char *name, const int *places, int count, size_t n)
{
    uint8_t data[128] = {0};
    for (int i = 0; i < count; i++) {
        data[places[i] * 4 + 2] = 0x80;
        data[places[i] * 4 + 3] = 0x3f;
    }
    file_bytes(name, data, n);
}

int open_caught(struct model **model, const char *path, char said[1024])
{
    struct stderr_capture c;
    stderr_capture_begin(&c);
    const int status = model_open(model, path, NULL);
    stderr_capture_end(&c);
    snprintf(said, 1024, "%.1023s", c.text);
    return status;
}

struct model *open_good(const char *path)
{
    struct model *model;
    char said[1024];
    if (open_caught(&model, path, said) != 0 || said[0] != '\0') {
        fail_msg("%s", said);
    }
    return model;
}

/* ---- a text that grows, and bytes in little endian ---------------------------------------------------------- */

struct buffer {
    uint8_t bytes[16384];
    size_t n;
};

static void add_text(struct buffer *b, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void add_text(struct buffer *b, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    b->n += (size_t)vsnprintf((char *)b->bytes + b->n, sizeof b->bytes - b->n, format, arguments);
    va_end(arguments);
}

static void add_u8(struct buffer *b, unsigned value)
{
    b->bytes[b->n++] = (uint8_t)value;
}

static void add_u16(struct buffer *b, unsigned value)
{
    add_u8(b, value & 255);
    add_u8(b, value >> 8 & 255);
}

static void add_u32(struct buffer *b, uint32_t value)
{
    add_u16(b, value & 0xffff);
    add_u16(b, value >> 16);
}

static void add_float(struct buffer *b, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    add_u32(b, bits);
}

static void add_corners(struct buffer *b)
{
    for (int i = 0; i < 8; i++) {
        for (int axis = 0; axis < 3; axis++) {
            add_float(b, corners[i][axis]);
        }
    }
}

/* Corner 0 .. 2 of triangle t of the 12. */
static unsigned corner_of(int t, int corner)
{
    static const unsigned char of_quad[2][3] = {{0, 1, 2}, {0, 2, 3}};
    return quads[t / 2][of_quad[t % 2][corner]];
}

/* ---- formats ------------------------------------------------------------------------------------------------ */

const char *cube_obj(void)
{
    struct buffer b = {.n = 0};
    for (int i = 0; i < 8; i++) {
        add_text(&b, "v %d %d %d\n", corners[i][0], corners[i][1], corners[i][2]);
    }
    for (int q = 0; q < 6; q++) {
        add_text(&b, "f %d %d %d %d\n", quads[q][0] + 1, quads[q][1] + 1, quads[q][2] + 1, quads[q][3] + 1);
    }
    return file_bytes("cube.obj", b.bytes, b.n);
}

const char *cube_stl_text(void)
{
    struct buffer b = {.n = 0};
    add_text(&b, "solid cube\n");
    for (int t = 0; t < 12; t++) {
        add_text(&b, "facet normal 0 0 0\nouter loop\n");
        for (int i = 0; i < 3; i++) {
            const signed char *p = corners[corner_of(t, i)];
            add_text(&b, "vertex %d %d %d\n", p[0], p[1], p[2]);
        }
        add_text(&b, "endloop\nendfacet\n");
    }
    add_text(&b, "endsolid cube\n");
    return file_bytes("cube-text.stl", b.bytes, b.n);
}

const char *cube_stl_binary(void)
{
    struct buffer b = {.n = 80};
    add_u32(&b, 12);
    for (int t = 0; t < 12; t++) {
        for (int i = 0; i < 3; i++) {
            add_float(&b, 0);
        }
        for (int i = 0; i < 3; i++) {
            for (int axis = 0; axis < 3; axis++) {
                add_float(&b, corners[corner_of(t, i)][axis]);
            }
        }
        add_u16(&b, 0);
    }
    return file_bytes("cube-binary.stl", b.bytes, b.n);
}

static void add_ply_head(struct buffer *b, const char *format)
{
    add_text(b,
             "ply\nformat %s 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
             "element face 6\nproperty list uchar int vertex_index\nend_header\n",
             format);
}

const char *cube_ply_text(void)
{
    struct buffer b = {.n = 0};
    add_ply_head(&b, "ascii");
    for (int i = 0; i < 8; i++) {
        add_text(&b, "%d %d %d\n", corners[i][0], corners[i][1], corners[i][2]);
    }
    for (int q = 0; q < 6; q++) {
        add_text(&b, "4 %d %d %d %d\n", quads[q][0], quads[q][1], quads[q][2], quads[q][3]);
    }
    return file_bytes("cube-text.ply", b.bytes, b.n);
}

const char *cube_ply_binary(void)
{
    struct buffer b = {.n = 0};
    add_ply_head(&b, "binary_little_endian");
    add_corners(&b);
    for (int q = 0; q < 6; q++) {
        add_u8(&b, 4);
        for (int i = 0; i < 4; i++) {
            add_u32(&b, quads[q][i]);
        }
    }
    return file_bytes("cube-binary.ply", b.bytes, b.n);
}

/* 96 bytes of positions, then 72 of indices. */
static void add_gltf_data(struct buffer *b)
{
    add_corners(b);
    for (int t = 0; t < 12; t++) {
        for (int i = 0; i < 3; i++) {
            add_u16(b, corner_of(t, i));
        }
    }
}

static void add_gltf(struct buffer *b, const char *nodes, const char *uri)
{
    add_text(b, "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":%s,", nodes);
    add_text(b,
             "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":0}]}],"
             "\"materials\":[{\"doubleSided\":true,\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0,0.2158605,1]}}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\","
             "\"min\":[-1,-1,-1],\"max\":[1,1,1]},"
             "{\"bufferView\":1,\"componentType\":5123,\"count\":36,\"type\":\"SCALAR\"}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":96},{\"buffer\":0,\"byteOffset\":96,\"byteLength\":72}],");
    add_text(b, "\"buffers\":[{\"byteLength\":168%s}]}", uri);
}

const char *cube_gltf(const char *nodes)
{
    struct buffer text = {.n = 0}, data = {.n = 0};
    add_gltf_data(&data);
    file_bytes("cube.bin", data.bytes, data.n);
    add_gltf(&text, nodes, ",\"uri\":\"cube.bin\"");
    return file_bytes("cube.gltf", text.bytes, text.n);
}

const char *cube_glb(const char *nodes)
{
    struct buffer text = {.n = 0}, data = {.n = 0}, b = {.n = 0};
    add_gltf(&text, nodes, "");
    while (text.n % 4 != 0) {
        add_u8(&text, ' ');
    }
    add_gltf_data(&data);
    add_u32(&b, 0x46546c67);
    add_u32(&b, 2);
    add_u32(&b, (uint32_t)(12 + 8 + text.n + 8 + data.n));
    add_u32(&b, (uint32_t)text.n);
    add_u32(&b, 0x4e4f534a);
    memcpy(b.bytes + b.n, text.bytes, text.n);
    b.n += text.n;
    add_u32(&b, (uint32_t)data.n);
    add_u32(&b, 0x004e4942);
    memcpy(b.bytes + b.n, data.bytes, data.n);
    b.n += data.n;
    return file_bytes("cube.glb", b.bytes, b.n);
}
