/*
 * Calls of the renderer in any order, right and wrong: refused frames, bands out of turn, flushes that stop, a frame
 * that is shown twice, renderers that were refused; pointers that are NULL, indices that name nothing, materials that
 * change between a draw and the bands, and lead nowhere then. No call may write outside the caller's memory
 * (AddressSanitizer), every return value must be what the order so far makes it, and a frame drawn in the right order
 * afterwards must have the pixels that it has on a fresh renderer.
 *
 * Usage: fuzz_order [quick | long | CALLS [SEED]]
 * quick (the default) is half a million calls, long ten million.
 */
#include "list.h"
#include "shadow.h"
#include "status.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define QUICK 500000
#define LONG  10000000
#define WIDTH 40
#define LINES 32

static uint64_t state;

static uint32_t below(uint32_t n)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((state >> 33) * n >> 31);
}

static void check(bool right, const char *what)
{
    if (!right) {
        printf("%s\n", what);
        exit(1);
    }
}

/* ---- a renderer, and where its frame stands as the test has it -------------------------------------------------- */

enum stage { REFUSED, IDLE, DRAWING, BANDS };

struct subject {
    struct ph_config config;
    struct ph_renderer r;
    enum stage stage;
    uint32_t bands, next;            /* while stage is BANDS */
    struct ph_material materials[3]; /* as `materials` while something is drawn */
    uint32_t flushes, stop_at;
};

static const struct fx_vec3 corners[] = {{-FX_ONE, -FX_ONE, 0}, {FX_ONE, -FX_ONE, 0}, {0, FX_ONE, 0}, {0, 0, FX_ONE}};
static const uint16_t faces[][3] = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
static const uint16_t edges[][2] = {{0, 1}, {1, 2}};
static const struct ph_part all = {.count = 4};
static struct ph_material materials[3];
static struct ph_mesh meshes[3];
static struct ph_projection lens;
static struct ph_xform view;

static void make_scene(void)
{
    static const struct ph_blend half = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 16};
    for (uint32_t i = 0; i < 3; i++) {
        materials[i] = (struct ph_material){.shading = i == 2 ? PH_SHADE_WIRE : PH_SHADE_UNLIT,
                                            .colour = 0xffff,
                                            .two_sided = 1,
                                            .blend = i == 1 ? &half : NULL};
        meshes[i] = (struct ph_mesh){.positions = corners,
                                     .triangles = faces,
                                     .edges = edges,
                                     .parts = &all,
                                     .materials = &materials[i],
                                     .vertex_count = 4,
                                     .triangle_count = 4,
                                     .edge_count = 2,
                                     .part_count = 1,
                                     .material_count = 1};
    }
    view = ph_xform_translate(0, 0, FX_INT(-3));
    check(ph_projection_perspective(&lens, FX_INT(45), FX_ONE, FX_HALF, FX_INT(10)) == PH_OK, "the lens");
}

static bool run_here(void (*run)(void *argument), void *argument)
{
    run(argument);
    return true;
}

static void join_here(void)
{
}

static void *memory(size_t bytes)
{
    void *const p = malloc(bytes);
    check(p != NULL, "out of memory");
    memset(p, (int)below(256), bytes);
    return p;
}

/* Little memory, often less than the scene needs. */
static void open_subject(struct subject *s)
{
    const uint32_t lines = 1 + below(LINES), bands = (LINES + lines - 1) / lines, n = 4 + below(60);
    memset(s, 0, sizeof *s);
    s->config = (struct ph_config){.width = WIDTH,
                                   .height = LINES,
                                   .band_height = (uint16_t)lines,
                                   .depth_format = PH_DEPTH_AUTO,
                                   .colouring = PH_COLOURS,
                                   .vertices = memory(n * ph_vertex_bytes),
                                   .vertex_max = n,
                                   .triangles = memory(n * ph_triangle_bytes),
                                   .triangle_max = n,
                                   .bins = memory(bands * sizeof(uint32_t)),
                                   .bin_max = bands,
                                   .depth = memory((size_t)WIDTH * lines * 2),
                                   .pixels = memory((size_t)WIDTH * lines * 2),
                                   .shown = below(2) != 0 ? memory((size_t)WIDTH * LINES * 2) : NULL};
    if (below(2) != 0) {
        s->config.other_core = run_here;
        s->config.other_core_join = join_here;
        s->config.cores = PH_TWO_CORES;
    }
}

static void close_subject(struct subject *s)
{
    free(s->config.vertices);
    free(s->config.triangles);
    free(s->config.bins);
    free(s->config.depth);
    free(s->config.pixels);
    free(s->config.shown);
}

/* ---- the calls -------------------------------------------------------------------------------------------------- */

/* Makes one thing wrong. Returns what ph_renderer_init must say. */
static int spoil(struct ph_config *c)
{
    switch (below(9)) {
    case 0:
        c->vertices = (uint8_t *)c->vertices + 1;
        return PH_ERR_INVAL;
    case 1:
        c->triangles = (uint8_t *)c->triangles + 2;
        return PH_ERR_INVAL;
    case 2:
        c->bins = (uint32_t *)(void *)((uint8_t *)c->bins + 2);
        return PH_ERR_INVAL;
    case 3:
        c->depth = (uint8_t *)c->depth + 1;
        return PH_ERR_INVAL;
    case 4:
        c->cores = PH_TWO_CORES;
        c->other_core = run_here;
        c->other_core_join = NULL;
        return PH_ERR_INVAL;
    case 5:
        c->bin_max--;
        return PH_ERR_NOMEM;
    case 6:
        c->band_height = 0;
        return PH_ERR_INVAL;
    case 7:
        c->depth_format = NULL;
        return PH_ERR_FORMAT;
    default:
        c->bins = NULL;
        return PH_ERR_INVAL;
    }
}

/* A mesh that must be refused: something is not there. */
static struct ph_mesh spoilt_mesh(const struct ph_mesh *from)
{
    static const struct ph_part parts[] = {{.first = 1, .count = 4},          {.first = 5},
                                           {.first = UINT32_MAX, .count = 2}, {.count = UINT32_MAX},
                                           {.count = 4, .material = 1},       {.count = 4, .material = UINT16_MAX}};
    static const uint16_t stray[][3] = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 4}};
    static const uint16_t stray_edges[][2] = {{0, 1}, {UINT16_MAX, 2}};
    struct ph_mesh mesh = *from;
    switch (below(7)) {
    case 0:
        mesh.positions = NULL;
        break;
    case 1:
        mesh.triangles = NULL;
        break;
    case 2:
        mesh.parts = NULL;
        break;
    case 3:
        mesh.materials = NULL;
        break;
    case 4: /* the parts of edges name no triangles */
        mesh.parts = &parts[mesh.materials->shading == PH_SHADE_WIRE ? 4 + below(2) : below(6)];
        break;
    case 5:
        mesh.triangles = stray;
        break;
    default:
        mesh.edges = below(2) != 0 ? stray_edges : NULL;
        break;
    }
    return mesh;
}

static void call_init(struct subject *s)
{
    struct ph_config config = s->config;
    const int must = below(3) == 0 ? spoil(&config) : PH_OK;
    check(ph_renderer_init(&s->r, &config) == must, "ph_renderer_init");
    s->stage = must == PH_OK ? IDLE : REFUSED;
}

static void call_begin(struct subject *s)
{
    struct ph_projection wrong = lens;
    wrong.far_z = wrong.near_z;
    const bool refused = below(4) == 0;
    const int status = ph_frame_begin(&s->r, &view, refused ? &wrong : &lens, NULL, 0);
    check(status == (s->stage == REFUSED ? PH_ERR_STATE : refused ? PH_ERR_INVAL : PH_OK), "ph_frame_begin");
    s->stage = s->stage == REFUSED ? REFUSED : refused ? IDLE : DRAWING;
}

static void call_draw(struct subject *s)
{
    static const struct ph_plane_equation floor = {.normal_q30 = {0, 1 << 30, 0}, .d = FX_ONE};
    const struct ph_xform place = ph_xform_rotate_y(below(UINT32_MAX));
    const struct fx_vec3 lamp = {0, FX_INT(4), 0};
    const uint32_t kind = below(3), what = below(6);
    const struct ph_material *const own = s->materials;
    struct ph_mesh mesh = meshes[kind];
    int status = PH_OK;
    mesh.materials = &own[kind];
    memcpy(s->materials, materials, sizeof materials);
    switch (what) {
    case 0:
        status = ph_draw_line(&s->r, corners[0], corners[2], &own[0]);
        break;
    case 1:
        status = ph_draw_billboard(&s->r, corners[1], FX_ONE, FX_ONE, &own[kind % 2]);
        break;
    case 2:
        status = ph_draw_shadow(&s->r, &meshes[0], &place, lamp, &floor, &own[kind % 2]);
        break;
    case 3:
        status = ph_frame_camera(&s->r, &view, &lens);
        break;
    case 4:
        status = ph_frame_fog(&s->r, &(struct ph_fog){0, FX_ONE, FX_INT(4)});
        break;
    default:
        status = ph_draw_mesh(&s->r, &mesh, &place);
        break;
    }
    memset(s->materials, 0xA5, sizeof s->materials);
    check(status == (s->stage == DRAWING ? PH_OK : PH_ERR_STATE), "a draw");
}

/* Draws what must be refused, and nothing of it is listed. */
static void call_draw_wrong(struct subject *s)
{
    static const struct ph_plane_equation floor = {.normal_q30 = {0, 1 << 30, 0}, .d = FX_ONE};
    const struct fx_vec3 lamp = {0, FX_INT(4), 0};
    const struct ph_mesh wrong = spoilt_mesh(&meshes[below(3)]);
    const struct ph_ref *const to = s->r.list.to;
    int status = PH_ERR_INVAL;
    switch (below(8)) {
    case 0:
        status = ph_draw_line(&s->r, corners[0], corners[2], NULL);
        break;
    case 1:
        status = ph_draw_billboard(&s->r, corners[1], FX_ONE, FX_ONE, NULL);
        break;
    case 2:
        status = ph_draw_shadow(&s->r, &meshes[0], &view, lamp, &floor, NULL);
        break;
    case 3:
        status = ph_draw_shadow(&s->r, &wrong, &view, lamp, &floor, &materials[0]);
        break;
    case 4:
        status = ph_draw_mesh(&s->r, &meshes[0], NULL);
        break;
    case 5:
        status = ph_draw_mesh(&s->r, NULL, &view);
        break;
    default:
        status = ph_draw_mesh(&s->r, &wrong, &view);
        break;
    }
    check(status == PH_ERR_INVAL && s->r.list.to == to, "a wrong draw");
}

static void call_bands(struct subject *s)
{
    const uint32_t all_bands = (LINES + s->config.band_height - 1u) / s->config.band_height;
    const uint32_t bands = ph_frame_bands(&s->r);
    check(bands == (s->stage == DRAWING ? all_bands : 0), "ph_frame_bands");
    if (s->stage == DRAWING) {
        s->stage = BANDS;
        s->bands = bands;
        s->next = 0;
    }
}

static void call_band(struct subject *s)
{
    static const uint32_t far[] = {UINT16_MAX, UINT16_MAX + 1, UINT32_MAX, 1024};
    const uint32_t band = below(3) != 0 ? s->next : below(2) != 0 ? below(LINES) : far[below(4)];
    const bool right = s->stage == BANDS && band == s->next && band < s->bands;
    const uint32_t lines = ph_draw_band(&s->r, band, s->config.pixels);
    check(right == (lines > 0) && lines <= s->config.band_height, "ph_draw_band");
    s->next += right;
}

static int flush(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    struct subject *s = context;
    check(pixels == s->config.pixels && width > 0 && height > 0 && x + width <= WIDTH && y + height <= LINES, "flush");
    return s->flushes++ == s->stop_at ? 7 : 0;
}

static void call_show(struct subject *s)
{
    s->flushes = 0;
    s->stop_at = below(2) != 0 ? below(4) : UINT32_MAX;
    const enum stage stage = s->stage;
    const int status = ph_show(&s->r, flush, s);
    const bool begins = stage == DRAWING;
    check(begins ? status == (s->flushes > s->stop_at ? 7 : 0) : status == PH_ERR_STATE && s->flushes == 0, "ph_show");
    if (begins) {
        s->stage = BANDS;
        s->bands = (LINES + s->config.band_height - 1u) / s->config.band_height;
        s->next = s->r.list.band; /* a flush that stopped it leaves the bands below */
    }
}

/* ---- a whole frame ---------------------------------------------------------------------------------------------- */

/* The pixels of a frame in the right order, as a checksum. */
static uint32_t whole_frame(struct ph_renderer *r, const struct ph_config *config)
{
    const struct ph_xform place = ph_xform_rotate_y(0x12345678);
    const uint16_t *const pixels = config->pixels;
    uint32_t sum = 0;
    check(ph_frame_begin(r, &view, &lens, NULL, 0x1f00) == PH_OK, "a right frame begins");
    check(ph_draw_mesh(r, &meshes[0], &place) == PH_OK, "a right mesh");
    for (uint32_t band = 0, bands = ph_frame_bands(r); band < bands; band++) {
        const uint32_t lines = ph_draw_band(r, band, config->pixels);
        check(lines > 0, "a right band");
        for (uint32_t i = 0; i < lines * WIDTH; i++) {
            sum = (sum ^ pixels[i]) * 16777619u;
        }
    }
    return sum;
}

/* After any order the next frame is as on a fresh renderer. */
static void check_recovery(struct subject *s)
{
    struct ph_renderer fresh;
    if (s->stage == REFUSED) {
        call_init(s);
    }
    if (s->stage != REFUSED) {
        const uint32_t sum = whole_frame(&s->r, &s->config);
        check(ph_renderer_init(&fresh, &s->config) == PH_OK, "a fresh renderer");
        check(whole_frame(&fresh, &s->config) == sum, "a frame after a wrong order has other pixels");
    }
}

static int fuzz(uint32_t calls, uint64_t seed)
{
    static void (*const call[])(struct subject * s) = {call_begin, call_begin, call_draw,       call_draw,
                                                       call_draw,  call_draw,  call_draw_wrong, call_bands,
                                                       call_band,  call_band,  call_show};
    uint32_t seen[4] = {0};
    printf("%u calls, seed %llu\n", (unsigned)calls, (unsigned long long)seed);
    make_scene();
    for (uint32_t n = 0, subjects = 0; n < calls; subjects++) {
        struct subject s;
        state = seed + subjects;
        open_subject(&s);
        s.stage = REFUSED;
        call_init(&s);
        for (uint32_t i = below(60); i > 0; i--, n++) {
            if (below(40) == 0) {
                call_init(&s);
            } else {
                call[below(sizeof call / sizeof *call)](&s);
            }
            seen[s.stage]++;
        }
        check_recovery(&s);
        close_subject(&s);
    }
    printf("refused %u, idle %u, drawing %u, bands %u\n", (unsigned)seen[0], (unsigned)seen[1], (unsigned)seen[2],
           (unsigned)seen[3]);
    return seen[0] > calls / 50 && seen[1] > calls / 50 && seen[2] > calls / 50 && seen[3] > calls / 50 ? 0 : 1;
}

int main(int argc, char **argv)
{
    uint32_t calls = QUICK;
    uint64_t seed = 20261126;
    if (argc > 3 || (argc > 1 && argv[1][0] == '-')) {
        fprintf(argc == 2 ? stdout : stderr, "usage: fuzz_order [quick | long | CALLS [SEED]]\n");
        return argc == 2 && strcmp(argv[1], "--help") == 0 ? 0 : 2;
    }
    if (argc > 1 && strcmp(argv[1], "quick") != 0) {
        calls = strcmp(argv[1], "long") == 0 ? LONG : (uint32_t)strtoul(argv[1], NULL, 10);
    }
    if (argc > 2) {
        seed = strtoull(argv[2], NULL, 10);
    }
    return fuzz(calls, seed);
}
