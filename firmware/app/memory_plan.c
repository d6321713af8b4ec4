/* See memory_plan.h. */
#include "memory_plan.h"

#define WIRE_MAX    4096  /* bytes of scratch memory for the panel driver */
#define BUFFERS_MIN 2U    /* one is drawn while the other is sent */
#define SLOTS_LEAST 16U   /* for triangles that go on from band to band */
#define SLOTS_USUAL 160U  /* with more there is nothing to gain */
#define LIST_LEAST  2048U /* beside the vertices; with less a demo is not shown at all */

#define ROUND8(n)  (((n) + 7) & ~(uint64_t)7)
#define ROUND16(n) (((n) + 15) & ~(uint64_t)15)

static bool sender_copies(const struct runner_config *config)
{
    return config->sender.ops != NULL && config->sender.ops->copies;
}

bool memory_plan_has_queue(const struct runner_config *config)
{
    return config->board->band_buffers > BUFFERS_MIN && config->board->format == PANEL_RGB565 && !sender_copies(config);
}

struct picture_memory memory_plan_picture(const struct runner_config *config, uint16_t lines)
{
    const struct panel *panel = config->board->panel;
    struct picture_memory p = {.width = panel_width(panel, config->rotation),
                               .height = panel_height(panel, config->rotation),
                               .buffers = BUFFERS_MIN};
    const uint32_t samples = config->antialiasing != NULL ? 4 : 1; /* samples a pixel */
    p.lines = lines < p.height ? lines : p.height;
    p.lines = (uint16_t)((p.lines + samples - 1) / samples);
    p.bands = p.lines > 0 ? (p.height + p.lines - 1U) / p.lines : 0;
    const uint32_t pixels = (uint32_t)p.width * p.lines;
    p.band_bytes = (uint32_t)ROUND8(2 * pixels);
    p.depth_bytes = (uint32_t)ROUND8(ph_depth_bytes(config->depth_format) * pixels * samples);
    p.sample_bytes = config->antialiasing != NULL ? (uint32_t)ROUND8(2 * pixels * samples) : 0;
    p.bin_bytes = (uint32_t)ROUND8(4 * p.bands);
    if (sender_copies(config)) { /* the driver collects windows in its scratch memory */
        p.wire_bytes = WIRE_MAX;
    } else if (config->board->format != PANEL_RGB565) { /* half a band of the smallest format */
        const uint32_t wire = (uint32_t)ROUND8(pixels / 2);
        const uint32_t least = wire < PANEL_SCRATCH_MIN ? PANEL_SCRATCH_MIN : wire;
        p.wire_bytes = least < WIRE_MAX ? least : WIRE_MAX;
    }
    return p;
}

uint64_t memory_plan_picture_bytes(const struct picture_memory *p)
{
    return (uint64_t)p->buffers * p->band_bytes + p->depth_bytes + p->bin_bytes + p->wire_bytes + p->sample_bytes;
}

/* The list of a frame: vertices, corners, references, and so many slots. The same on every machine. */
static uint64_t list_bytes(const struct demo_level *level, uint32_t slots)
{
    return ROUND16(((uint64_t)level->vertex_max + level->corner_max) * PH_VERTEX_BYTES_32 +
                   (uint64_t)level->triangle_max * PH_REFERENCE_BYTES + (uint64_t)slots * PH_SLOT_BYTES_32);
}

/* A level of a demo, 0 for the finest, with what its arena takes on a 32-bit target. */
static struct demo_level level_at(const struct demo *demo, uint32_t number)
{
    struct demo_level level = number > 0 ? demo->coarser[number - 1]
                                         : (struct demo_level){.arena_bytes = demo->arena_bytes,
                                                               .vertex_max = demo->vertex_max,
                                                               .triangle_max = demo->triangle_max,
                                                               .corner_max = demo->corner_max};
    level.arena_bytes_32 = demo_arena_bytes_32(demo, number);
    return level;
}

/* What a level of a demo takes on a 32-bit target. */
static uint64_t level_bytes_32(const struct demo_level *level, uint32_t slots)
{
    return ROUND8(level->arena_bytes_32) + list_bytes(level, slots);
}

static void place_scene(struct scene_memory *s)
{
    s->arena_at = (size_t)ROUND16(s->list_bytes);
    s->scratch_at = s->arena_at + (size_t)ROUND8(s->arena_bytes);
}

/* Slots for a level that fits whole, in what it leaves. */
static uint32_t slots_of(const struct demo_level *level, uint64_t left)
{
    const uint32_t most = level->triangle_max < SLOTS_USUAL ? level->triangle_max : SLOTS_USUAL;
    const uint64_t slots = SLOTS_LEAST + left / PH_SLOT_BYTES_32;
    return most < SLOTS_LEAST ? SLOTS_LEAST : slots < most ? (uint32_t)slots : most;
}

/* A level as it is drawn: with samples a line is two. */
static struct demo_level drawn_level(const struct demo *demo, uint32_t number, const struct picture_memory *p)
{
    struct demo_level level = level_at(demo, number);
    level.triangle_max *= p->sample_bytes > 0 ? 2 : 1;
    return level;
}

/* Whether a coarser level of a demo is to be taken instead of this one. */
static bool is_too_fine(const struct demo_level *level, const struct demo_level *coarser,
                        const struct picture_memory *p, uint64_t budget)
{
    const uint16_t smaller_side = p->width < p->height ? p->width : p->height;
    return level_bytes_32(level, SLOTS_LEAST) > budget || smaller_side <= coarser->enough_px;
}

/* The finest level that fits whole and whose triangles are not too small for the picture; if none fits, the coarsest
 * with as many of its triangles as the list has room for, about. */
static struct scene_memory scene_within(const struct demo *demo, const struct picture_memory *p, uint64_t budget)
{
    struct demo_level level = drawn_level(demo, 0, p);
    for (uint32_t i = 0; i < demo->coarser_count && is_too_fine(&level, &demo->coarser[i], p, budget); i++) {
        level = drawn_level(demo, i + 1, p);
    }
    const uint64_t whole = level_bytes_32(&level, SLOTS_LEAST), arena = ROUND8(level.arena_bytes_32);
    struct scene_memory s = {.arena_bytes = level.arena_bytes, .whole = whole <= budget};
    if (s.whole) {
        const size_t scratch = demo_scratch_bytes(demo, p->width, p->lines);
        s.triangle_max = level.triangle_max;
        s.scratch_bytes = whole + ROUND8(scratch) <= budget ? scratch : 0;
        s.lacks_scratch = s.scratch_bytes < scratch;
        s.list_bytes = (size_t)list_bytes(&level, slots_of(&level, budget - whole - ROUND8(s.scratch_bytes)));
    } else if (arena + (uint64_t)level.vertex_max * PH_VERTEX_BYTES_32 + LIST_LEAST <= budget) {
        s.list_bytes = (size_t)(budget - arena) & ~(size_t)15;
        s.triangle_max = (uint32_t)(level.triangle_max * (uint64_t)s.list_bytes / list_bytes(&level, SLOTS_LEAST));
    }
    s.bytes_32 = arena + s.list_bytes + ROUND8(s.scratch_bytes);
    place_scene(&s);
    return s;
}

/* The scene in what the budget leaves beside the picture. */
static struct scene_memory scene_beside(const struct runner_config *config, const struct demo *demo,
                                        const struct picture_memory *p)
{
    const uint64_t taken = memory_plan_picture_bytes(p);
    return scene_within(demo, p, config->budget_bytes > taken ? config->budget_bytes - taken : 0);
}

/*
 * The plan in bands of the board's own height. It begins with as many buffers as the board usually takes. Buffers are
 * taken away while the demo does not fit whole, and added while there is room.
 */
static struct memory_plan plan_in_own_bands(const struct runner_config *config, const struct demo *demo)
{
    const bool queue = memory_plan_has_queue(config);
    struct memory_plan plan = {.picture = memory_plan_picture(config, config->board->band_height)};
    struct picture_memory *p = &plan.picture;
    p->buffers = queue ? config->board->band_buffers : BUFFERS_MIN;
    plan.scene = scene_beside(config, demo, p);
    while ((!plan.scene.whole || plan.scene.lacks_scratch) && p->buffers > BUFFERS_MIN) {
        p->buffers--;
        plan.scene = scene_beside(config, demo, p);
    }
    while (queue && plan.scene.whole && p->buffers < p->bands && p->buffers < RUNNER_BANDS_MAX &&
           memory_plan_picture_bytes(p) + p->band_bytes + plan.scene.bytes_32 <= config->budget_bytes) {
        p->buffers++;
    }
    return plan;
}

/* The scene is that of the board's own bands, so that other bands show the same picture. Of higher bands are fewer. */
struct memory_plan memory_plan(const struct runner_config *config, const struct demo *demo)
{
    struct memory_plan plan = plan_in_own_bands(config, demo);
    struct picture_memory p = memory_plan_picture(config, config->band_height);
    const uint32_t all_lines = plan.picture.buffers * plan.picture.lines, fit = p.lines > 0 ? all_lines / p.lines : 0;
    const uint32_t count = fit < plan.picture.buffers ? fit : plan.picture.buffers;
    p.buffers = count > BUFFERS_MIN ? count : BUFFERS_MIN;
    plan.picture = p;
    if (plan.scene.scratch_bytes > 0) {
        plan.scene.scratch_bytes = demo_scratch_bytes(demo, p.width, p.lines);
    }
    return plan;
}

uint64_t memory_plan_bytes(const struct memory_plan *plan)
{
    return memory_plan_picture_bytes(&plan->picture) + plan->scene.scratch_at + ROUND8(plan->scene.scratch_bytes);
}

size_t runner_bytes(const struct runner_config *config)
{
    const struct memory_plan own = memory_plan(config, config->demo);
    uint64_t most = memory_plan_bytes(&own);
    for (uint32_t i = 0; i < demo_count; i++) {
        const struct memory_plan listed = memory_plan(config, demo_list[i]);
        const uint64_t bytes = listed.scene.triangle_max > 0 ? memory_plan_bytes(&listed) : 0;
        most = bytes > most ? bytes : most;
    }
    return (size_t)most;
}

uint64_t runner_whole_bytes(const struct runner_config *config)
{
    const struct demo *demo = config->demo;
    const struct picture_memory p = memory_plan_picture(config, config->board->band_height);
    const struct demo_level level = level_at(demo, 0);
    return memory_plan_picture_bytes(&p) + level_bytes_32(&level, SLOTS_LEAST);
}
