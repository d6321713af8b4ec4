/*
 * Changed OBJ, MTL, STL and PLY files into the reader of models: each gives a model or one line, never a crash or a
 * hang. (fuzz_gltf has glTF and GLB.) assimp reads in a process with limits: a file that it breaks on costs one line,
 * which is counted here and is no failure.
 *
 *   fuzz_model [quick | long | INPUTS [SEED]]
 */
#include "complain.h"
#include "fuzz.h"
#include "model_files.h"

#include <assimp/cimport.h> /* tests/run.sh skips this program where a library is not installed */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROOM = 8192, SEEDS = 5 };

static uint8_t right[SEEDS][ROOM];
static size_t lengths[SEEDS];
static const char *const names[SEEDS] = {"fuzz.obj", "text.stl", "binary.stl", "text.ply", "binary.ply"};
static uint32_t broken;

static const char material[] = "newmtl a\nKd 0.5 0.25 1\nKe 0 0.5 0\nd 0.5\nmap_Kd fuzz.png\nnewmtl b\nKd 1 0 0\n"
                               "map_d -clamp on fuzz.png\nTf 1 1 1\nillum 2\n";
static const char object[] =
    "# a roof\nmtllib fuzz.mtl\no roof\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 1 1\nvt 0 0\n"
    "vt 1 0 0\nvt 1 1\nvn 0 0 1\nvn 0 1 0\nusemtl a\ns 1\nf 1/1/1 2/2/1 3/3/1 4/1/1\nf 1 2 5\n"
    "g side\nusemtl b\ns off\nf -1/-1/-1 -2/-2/-1 -3//-1\nf 2//2 3//2 5//2\nl 1 2 3\np 1\n";

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
    const bool is_text = kind != 2 && kind != 4;
    n = is_text ? fuzz_change_text((char *)bytes, n, ROOM) : fuzz_change(bytes, n, ROOM);
    if (kind == 0) {
        change_material();
    }
    struct model *model;
    const int status = model_open(&model, file_bytes(names[kind], bytes, n), NULL);
    broken += strstr(fuzz_said(status == 0), "crashed or hung") != NULL;
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
    printf("assimp broke on %u\n", (unsigned)broken);
    return files_end(&state) == 0 ? status : 1;
}
