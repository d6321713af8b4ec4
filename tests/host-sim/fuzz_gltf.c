/*
 * Changed glTF files into the reader: each gives a model or one line, and never a crash, a hang or an error of the
 * sanitizers. A right file of text is changed in a few numbers, names or bytes; half of the time it becomes a GLB.
 *
 *   fuzz_gltf [quick | long | FILES [SEED]]
 *
 * With libFuzzer, in its own process: clang -fsanitize=fuzzer,address,undefined -DLIBFUZZER
 */
#define _GNU_SOURCE /* memfd_create */

#include "model_gltf.h"
#include "model_meshes.h"
#include "model_rig.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

static void fail(const char *what)
{
    fprintf(stderr, "fuzz_gltf: %s\n", what);
    abort();
}

#ifdef LIBFUZZER
/* A file that has no name; returns its descriptor, and a path to it. */
static int put_file(const uint8_t *bytes, size_t n, char path[40])
{
    const int fd = memfd_create("fuzz", 0);
    if (fd < 0 || write(fd, bytes, n) != (ssize_t)n) {
        fail("no memory for a file");
    }
    snprintf(path, 40, "/proc/self/fd/%d", fd);
    return fd;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) /* see long_libfuzzer.sh: the reader frees nothing */
{
    static uint8_t memory[64 << 20];
    char path[40];
    struct model_scene scene = {.root = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}, .first_node = MODEL_NONE};
    struct model_shared shared = {.arena = {.base = memory, .size = sizeof memory}, .folder.model = path};
    const int fd = put_file(data, size, path);
    if (model_gltf_read(&shared, &scene) && model_rig_find(&shared, &scene)) {
        model_meshes_read(&shared, &scene);
    }
    close(fd);
    return 0;
}
#else

#include "complain.h"
#include "stderr_capture.h"

enum { QUICK = 400, LONG = 20000, BYTES_MOST = 8192 };

/* A right file: interleaved and sparse accessors, every kind of index, textures, transforms, nodes, a camera, a skin,
 * morph targets, an animation. */
static const char right[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,2]}],\"nodes\":[{\"children\":[1],"
    "\"translation\":[1,2,3],\"rotation\":[0,0,0.6,0.8],\"scale\":[1,-1,2]},{\"mesh\":0,\"skin\":0},{\"camera\":0,"
    "\"matrix\":"
    "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,9,1]}],\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.7,"
    "\"znear\":0.1,\"zfar\":100}}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1,"
    "\"JOINTS_0\":4,\"WEIGHTS_0\":5},"
    "\"indices\":2,\"material\":0,\"targets\":[{\"POSITION\":0}]},{\"attributes\":{\"POSITION\":3,\"JOINTS_0\":9,"
    "\"WEIGHTS_0\":10},\"mode\":5,\"material\":1,\"targets\":[{}]}]}],\"skins\":[{\"joints\":[0,1]}],"
    "\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"rotation\"}},{\"sampler\":1,"
    "\"target\":{\"node\":1,\"path\":\"weights\"}}],\"samplers\":[{\"input\":6,\"output\":7},{\"input\":6,\"output\":8,"
    "\"interpolation\":\"CUBICSPLINE\"}]}],\"materials\":[{"
    "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,1,0.25,1],\"baseColorTexture\":{\"index\":0,\"texCoord\":0,"
    "\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0.5,0],\"rotation\":1,\"scale\":[2,2]}}}},"
    "\"doubleSided\":true},{\"emissiveFactor\":[1,0,0.5],\"emissiveTexture\":{\"index\":0},\"alphaMode\":\"MASK\","
    "\"extensions\":{\"KHR_materials_unlit\":{}}}],\"textures\":[{\"source\":0,\"sampler\":0}],\"samplers\":[{"
    "\"wrapS\":33648,\"wrapT\":33071}],\"images\":[{\"uri\":\"data:image/png;base64,iVBORw0KGgoAAAANSUhE"
    "UgAAAAIAAAACCAIAAAD91JpzAAAAEklEQVR4nGP4z8DAAMIM/4EAAB/"
    "uBfsL2WiLAAAAAElFTkSuQmCC\"}],\"accessors\":[{\"bufferView\":0,"
    "\"byteOffset\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},{\"bufferView\":0,\"byteOffset\":12,"
    "\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"},{\"bufferView\":1,\"componentType\":5121,\"count\":3,"
    "\"type\":\"SCALAR\"},{\"componentType\":5122,\"normalized\":true,\"count\":4,\"type\":\"VEC3\",\"sparse\":{"
    "\"count\":1,\"indices\":{\"bufferView\":1,\"componentType\":5121},\"values\":{\"bufferView\":1,\"byteOffset\":2}}}"
    ","
    "{\"componentType\":5121,\"count\":3,\"type\":\"VEC4\"},{\"componentType\":5126,\"count\":3,\"type\":\"VEC4\"},"
    "{\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\"},{\"componentType\":5126,\"count\":2,\"type\":\"VEC4\"},"
    "{\"componentType\":5126,\"count\":6,\"type\":\"SCALAR\"},{\"componentType\":5121,\"count\":4,\"type\":\"VEC4\"},"
    "{\"componentType\":5126,\"count\":4,\"type\":\"VEC4\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":60,"
    "\"byteStride\":20},{\"buffer\":0,\"byteOffset\":60,"
    "\"byteLength\":9}],\"buffers\":[{\"byteLength\":69,\"uri\":\"data:;base64,AAAAAAAAAAAA"
    "AAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAECAQACAAEA\"}]}";

static uint64_t state;

static uint32_t below(uint32_t n)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((state >> 32) * n >> 32);
}

/* Replaces the number that begins at or after a random place. */
static void change_number(char *text)
{
    static const char *const numbers[] = {"0",    "1",    "2",    "3",    "-1",         "255",        "252",
                                          "5120", "5125", "5126", "1e39", "4294967295", "4294967294", "2147483648",
                                          "0.5",  "-0",   "null", "[]",   "12000000",   "4000000",    "1e-40"};
    const size_t n = strlen(text);
    char *at = text + below((uint32_t)n);
    at += strcspn(at, "0123456789");
    const size_t old = strspn(at, "0123456789.");
    const char *with = numbers[below(sizeof numbers / sizeof numbers[0])];
    if (old > 0 && n + strlen(with) < BYTES_MOST - 64) {
        memmove(at + strlen(with), at + old, strlen(at + old) + 1);
        memcpy(at, with, strlen(with)); /* NOLINT(bugprone-not-null-terminated-result): the text goes on behind it */
    }
}

static size_t change(uint8_t *bytes)
{
    char *text = (char *)bytes;
    memcpy(text, right, sizeof right);
    for (uint32_t i = 1 + below(3); i > 0; i--) {
        const uint32_t n = (uint32_t)strlen(text), kind = below(8), at = n > 1 ? below(n) : 0;
        if (kind < 5) {
            change_number(text);
        } else if (kind == 5) {
            text[at] = (char)(1 + below(255));
        } else if (kind == 6) {
            const uint32_t lost = below(n - at < 40 ? n - at + 1 : 40);
            memmove(text + at, text + at + lost, n - at - lost + 1);
        } else {
            text[at] = '\0';
        }
    }
    size_t n = strlen(text);
    if (below(2) == 0) { /* a GLB with the text as its JSON */
        const uint32_t words[5] = {0x46546C67, 2, (uint32_t)n + 20 - below(2), (uint32_t)n - below(2), 0x4E4F534A};
        memmove(bytes + 20, bytes, n);
        for (int i = 0; i < 20; i++) {
            bytes[i] = (uint8_t)(words[i / 4] >> 8 * (i % 4));
        }
        n += 20;
    }
    return n;
}

/* Three frames of what moves. */
static void move(const struct model *model)
{
    const struct animation *a = &model->motion->animation;
    const struct animation_need need = animation_need(a);
    struct demo_arena arena = {.size = animation_bytes(&need, a, model->mesh_count, false)};
    arena.base = malloc(arena.size);
    const struct animation_stage *stage =
        arena.base != NULL ? animation_begin(&arena, a, model->meshes, model->mesh_count) : NULL;
    if (stage == NULL || arena.used > arena.size) {
        fail("its animation takes more memory than it says");
    }
    for (uint32_t frame = 0; frame < 3; frame++) {
        animation_move(stage, NULL, 7 * frame);
    }
    free(arena.base);
}

/* Reads a file with the reader under test. Was it read? */
static bool read_file(const uint8_t *bytes, size_t n, const char *path)
{
    struct model *model;
    struct stderr_capture said;
    FILE *file = fopen(path, "wb");
    if (file == NULL || fwrite(bytes, 1, n, file) != n || fclose(file) != 0) {
        fail("the file cannot be written");
    }
    stderr_capture_begin(&said);
    const int status = model_open(&model, path, NULL);
    stderr_capture_end(&said);
    const char *end = strchr(said.text, '\n');
    if (status == 0 ? said.text[0] != '\0' : end == NULL || end[1] != '\0') {
        fail("not one line");
    }
    if (strstr(said.text, "crashed or hung") != NULL) {
        fprintf(stderr, "%s holds it\n", path);
        fail("the reader crashed");
    }
    if (status == 0 && model->motion != NULL) {
        move(model);
    }
    model_close(model);
    return status == 0;
}

int main(int argc, char **argv)
{
    static uint8_t bytes[BYTES_MOST + 64];
    uint32_t files = QUICK, taken = 0;
    uint64_t seed = 20261123;
    if (argc > 1 && strcmp(argv[1], "quick") != 0) {
        files = strcmp(argv[1], "long") == 0 ? LONG : (uint32_t)strtoul(argv[1], NULL, 10);
    }
    if (argc > 2) {
        seed = strtoull(argv[2], NULL, 10);
    }
    char path[] = "/tmp/fuzz_gltf_XXXXXX.gltf";
    const int named = mkstemps(path, 5);
    if (named < 0) {
        fail("no file in /tmp");
    }
    if (!read_file((const uint8_t *)right, sizeof right - 1, path)) {
        fail("the right file was refused");
    }
    for (uint32_t i = 0; i < files; i++) {
        state = (seed + i) * 0xd1342543de82ef95u;
        const size_t n = change(bytes);
        taken += read_file(bytes, n, path);
    }
    close(named);
    unlink(path);
    printf("%" PRIu32 " files, seed %" PRIu64 ": %" PRIu32 " taken\n", files, seed, taken);
    return files < QUICK || (taken > files / 20 && taken < files) ? 0 : 1;
}
#endif
