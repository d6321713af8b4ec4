/*
 * Changed OBJ, MTL, STL and PLY files into the reader of models: each gives a model or one line, never a crash or a
 * hang. (fuzz_gltf has glTF and GLB.)
 *
 *   fuzz_model [quick | long | INPUTS [SEED]]
 *
 * With libFuzzer, in its own process: clang -fsanitize=fuzzer,address,undefined -DLIBFUZZER. The first byte of an input
 * chooses the reader.
 */
#define _GNU_SOURCE /* memfd_create */

#ifdef LIBFUZZER
#include "model_meshes.h"
#include "model_obj.h"
#include "model_ply.h"
#include "model_stl.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) /* see long_libfuzzer.sh: the readers free little */
{
    static bool (*const readers[])(struct model_shared *, struct model_scene *) = {model_obj_read, model_stl_read,
                                                                                   model_ply_read};
    static uint8_t memory[16 << 20];
    char path[40];
    struct model_scene scene = {.root = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}, .first_node = MODEL_NONE};
    struct model_shared shared = {.arena = {.base = memory, .size = sizeof memory}, .folder.model = path};
    const int fd = size > 0 ? memfd_create("fuzz", 0) : -1;
    if (size == 0) {
        return 0;
    }
    if (fd < 0 || write(fd, data + 1, size - 1) != (ssize_t)size - 1) {
        abort();
    }
    snprintf(path, sizeof path, "/proc/self/fd/%d", fd);
    if (readers[data[0] % 3](&shared, &scene)) {
        model_meshes_read(&shared, &scene);
    }
    close(fd);
    return 0;
}
#else
#include "complain.h"
#include "fuzz.h"
#include "model_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROOM = 8192, SEEDS = 7 };

static uint8_t right[SEEDS][ROOM];
static size_t lengths[SEEDS];
static const char *const names[SEEDS] = {"fuzz.obj",   "text.stl",   "binary.stl", "text.ply",
                                         "binary.ply", "second.ply", "third.ply"};

static const char material[] = "newmtl a\nKd 0.5 0.25 1\nKe 0 0.5 0\nd 0.5\nmap_Kd fuzz.png\nnewmtl b\nKd 1 0 0\n"
                               "map_d -clamp on fuzz.png\nTf 1 1 1\nillum 2\n";
static const char object[] =
    "# a roof\nmtllib fuzz.mtl\no roof\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 1 1\nvt 0 0\n"
    "vt 1 0 0\nvt 1 1\nvn 0 0 1\nvn 0 1 0\nusemtl a\ns 1\nf 1/1/1 2/2/1 3/3/1 4/1/1\nf 1 2 5\n"
    "g side\nusemtl b\ns off\nf -1/-1/-1 -2/-2/-1 -3//-1\nf 2//2 3//2 5//2\nl 1 2 3\np 1\n";

/* What cubes lack: normals, colours, coordinates, strips, in text and in bytes. */
static const char second[] =
    "ply\nformat ascii 1.0\ncomment TextureFile fuzz.png\nelement vertex 4\nproperty float x\nproperty double "
    "y\nproperty "
    "short z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nproperty uchar "
    "green\nproperty "
    "uchar blue\nproperty float s\nproperty float t\nelement face 2\nproperty list uchar int vertex_indices\nproperty "
    "list "
    "uchar float texcoord\nproperty int flags\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
    "0 0 0 0 0 1 255 0 0 0 0\n1 0 0 0 0 1 0 255 0 1 0\n1 1 0 0 0 1 0 0 255 1 1\n0 1 1 0 0 1 9 9 9 0 1\n"
    "4 0 1 2 3 8 0 0 1 0 1 1 0 1 7\n3 0 1 2 0 7\n6 0 1 2 3 -1 0\n";
static const char third[] =
    "ply\nformat binary_big_endian 1.0\nelement vertex 4\nproperty char x\nproperty short y\nproperty uchar z\nelement "
    "face "
    "2\nproperty list ushort uchar vertex_index\nend_header\n\1\0\1\2\3\0\3\4\5\0\6\7\1\1\0\2\0\3\0\1\2\0\4\0\1\2\3";

static void keep(int i, const char *path)
{
    FILE *const file = fopen(path, "rb");
    lengths[i] = file != NULL ? fread(right[i], 1, ROOM, file) : 0;
    if (lengths[i] == 0 || lengths[i] == ROOM) {
        fuzz_fail("no right file");
    }
    fclose(file);
}

static void make_right(void)
{
    keep(0, file_text(names[0], object));
    keep(1, cube_stl_text());
    keep(2, cube_stl_binary());
    keep(3, cube_ply_text());
    keep(4, cube_ply_binary());
    keep(5, file_text(names[5], second));
    keep(6, file_bytes(names[6], third, sizeof third - 1));
}

/* One OBJ of three comes with a changed MTL. */
static void change_material(void)
{
    char text[ROOM];
    size_t n = sizeof material - 1;
    memcpy(text, material, n);
    if (fuzz_below(3) == 0) {
        n = fuzz_change_text(text, n, ROOM);
    }
    file_bytes("fuzz.mtl", text, n);
}

static bool one(void)
{
    uint8_t bytes[ROOM];
    const uint32_t kind = fuzz_below(SEEDS);
    size_t n = lengths[kind];
    memcpy(bytes, right[kind], n);
    const bool is_text = kind != 2 && kind != 4 && kind != 6;
    n = is_text ? fuzz_change_text((char *)bytes, n, ROOM) : fuzz_change(bytes, n, ROOM);
    if (kind == 0) {
        change_material();
    }
    struct model *model;
    const int status = model_open(&model, file_bytes(names[kind], bytes, n), NULL);
    if (strstr(fuzz_said(status == 0), "crashed or hung") != NULL) {
        fuzz_fail("the reader crashed or hung");
    }
    model_close(model);
    return status == 0;
}

int main(int argc, char **argv)
{
    void *state = NULL;
    if (files_begin(&state) != 0) {
        return 1;
    }
    make_right();
    const int status = fuzz_main(&(struct fuzz){"fuzz_model", 60, 2000, one}, argc, argv);
    return files_end(&state) == 0 ? status : 1;
}
#endif
