/* See sim_player.h. */
#include "sim_player.h"

#include "complain.h"

#include <stdlib.h>

static int refuse(const struct sim_player_setup *setup, int status)
{
    if (status == PH_ERR_NOMEM) {
        return complain("%s: its %u bytes do not hold %s; %s", setup->board->name, (unsigned)setup->board->scene_bytes,
                        setup->file != NULL ? setup->file : setup->demo->name,
                        setup->cure != NULL ? setup->cure : "take a smaller scene or another board");
    }
    return complain("%s: the panel does not open (%d)", setup->board->name, status);
}

int sim_player_open(struct sim_player *p, const struct sim_player_setup *setup)
{
    const struct board *board = setup->board;
    *p = (struct sim_player){.setup = *setup};
    p->sim = sim_open(board, &p->hal);
    if (p->sim == NULL) {
        return complain("%s: no memory, or no model of its display controller", board->name);
    }
    struct runner_config config = {.board = board,
                                   .rotation = (uint8_t)setup->rotation,
                                   .depth_format = setup->depth.format != NULL ? setup->depth.format : PH_DEPTH_AUTO,
                                   .depth_exponent = setup->depth.exponent,
                                   .band_height = setup->band_height,
                                   .budget_bytes = board->scene_bytes,
                                   .demo = setup->demo,
                                   .state = setup->state,
                                   .view = setup->view,
                                   .camera = setup->camera,
                                   .clip_fps = setup->clip_fps,
                                   .overlay = setup->overlay,
                                   .antialiasing = setup->antialias ? PH_ANTIALIAS_2X2 : NULL};
    p->dither = (struct ph_dither){.ramps = p->dithered_ramps, .ramp_max = SIM_DITHERED_RAMPS};
    if (setup->dither) {
        config.dither = &p->dither;
        config.set_dither = ph_dither;
    }
    const uint16_t width = panel_width(board->panel, setup->rotation);
    const uint16_t height = panel_height(board->panel, setup->rotation);
    config.memory_bytes = runner_bytes(&config);
    config.memory = p->memory = malloc(config.memory_bytes);
    p->picture = (struct ppm){width, height, malloc((size_t)width * height * 3)};
    if (p->memory == NULL || p->picture.rgb == NULL) {
        return complain("not enough memory for this scene");
    }
    const int status = runner_open(&p->runner, &p->hal, &config);
    return status == 0 ? 0 : refuse(setup, status);
}

int sim_player_scene(struct sim_player *p, uint32_t frame)
{
    const int status = runner_scene(&p->runner, frame);
    return status == 0 ? 0
                       : complain("frame %u cannot be drawn with this camera or budget (%d)", (unsigned)frame, status);
}

/* Says once that something is left out. */
static void tell_drops(struct sim_player *p, uint32_t frame)
{
    const struct ph_stats *s = &p->runner.renderer.stats;
    if (p->drops_told || (s->triangles_dropped == 0 && s->vertices_dropped == 0)) {
        return;
    }
    p->drops_told = true;
    complain_note("frame %u: %u triangles and %u vertices of '%s' do not fit %s's %u bytes and are left out%s%s",
                  (unsigned)frame, (unsigned)s->triangles_dropped, (unsigned)s->vertices_dropped, p->runner.demo->name,
                  p->setup.board->name, (unsigned)p->setup.board->scene_bytes, p->setup.cure != NULL ? "; " : "",
                  p->setup.cure != NULL ? p->setup.cure : "");
}

void sim_player_move(struct sim_player *p, uint32_t turn32, int32_t up32, fx_t away)
{
    const int64_t tilt = (int64_t)p->runner.context.tilt + up32, most = 1 << 30; /* a quarter turn */
    p->runner.context.tilt = (int32_t)(tilt < -most ? -most : tilt > most ? most : tilt);
    p->runner.context.orbit += turn32;
    p->runner.context.dolly += away;
}

#define DRAG_TURN  (1u << 24)    /* 256 pixels of the picture are a turn */
#define WHEEL_AWAY (FX_ONE / 16) /* of the distance, a notch */

void sim_player_drag(struct sim_player *p, int32_t right, int32_t down, int32_t notches)
{
    const int32_t up = down < -64 ? -64 : down > 64 ? 64 : down;
    sim_player_move(p, 0u - (uint32_t)right * DRAG_TURN, up * (int32_t)DRAG_TURN, -notches * WHEEL_AWAY);
}

int sim_player_frame(struct sim_player *p, uint32_t frame)
{
    p->counters = sim_counters(p->sim);
    if (runner_buttons(&p->runner, 0) != 0) {
        return refuse(&p->setup, PH_ERR_NOMEM);
    }
    if (sim_player_scene(p, frame) != 0) {
        return COMPLAINED;
    }
    int status = runner_send(&p->runner);
    if (status == 0) {
        status = runner_finish(&p->runner);
    }
    if (status != 0) {
        return complain("frame %u: the panel failed (%d)", (unsigned)frame, status);
    }
    tell_drops(p, frame);
    sim_pixels(p->sim, p->setup.rotation, p->picture.rgb);
    return 0;
}

uint64_t sim_player_bus_ns(const struct sim_player *p)
{
    return sim_counters(p->sim).bus_ns - p->counters.bus_ns;
}

static const char *depth_name(const struct ph_stats *s, char text[OPTION_DEPTH_NAME])
{
    return option_text_depth_name((struct option_depth){s->depth_format, s->depth_exponent}, text);
}

void sim_player_print_stats(const struct sim_player *p, uint32_t frame)
{
    const struct ph_stats *s = &p->runner.renderer.stats;
    char depth[OPTION_DEPTH_NAME];
    const struct sim_counters now = sim_counters(p->sim);
    const double bus_us = (double)sim_player_bus_ns(p) / 1000;
    fprintf(stderr, "frame %u: vertices %u, triangles in %u, culled %u, clipped %u, drawn %u, dropped %u; ",
            (unsigned)frame, (unsigned)s->vertices, (unsigned)s->triangles_in, (unsigned)s->triangles_culled,
            (unsigned)s->triangles_clipped, (unsigned)s->triangles_drawn, (unsigned)s->triangles_dropped);
    fprintf(stderr,
            "vertices dropped %u, culled whole %u meshes and %u parts; fragments %u, depth %s; wire %llu bytes, writes "
            "%u, bus %.0f us at %u Hz, %.1f "
            "frames/s\n",
            (unsigned)s->vertices_dropped, (unsigned)s->meshes_culled, (unsigned)s->parts_culled,
            (unsigned)s->fragments, depth_name(s, depth), (unsigned long long)(now.bytes - p->counters.bytes),
            (unsigned)(now.writes - p->counters.writes), bus_us, (unsigned)now.clock_hz, bus_us > 0 ? 1e6 / bus_us : 0);
}

void sim_player_print_json(const struct sim_player *p, uint32_t frame)
{
    const struct ph_stats *s = &p->runner.renderer.stats;
    char depth[OPTION_DEPTH_NAME];
    const struct sim_counters now = sim_counters(p->sim);
    const double bus_us = (double)sim_player_bus_ns(p) / 1000;
    fprintf(
        stderr,
        "{\"frame\": %u, \"vertices\": %u, \"triangles_in\": %u, \"triangles_culled\": %u, \"triangles_clipped\": %u, "
        "\"triangles_drawn\": %u, \"triangles_dropped\": %u, \"vertices_dropped\": %u, \"meshes_culled\": %u, "
        "\"parts_culled\": %u, ",
        (unsigned)frame, (unsigned)s->vertices, (unsigned)s->triangles_in, (unsigned)s->triangles_culled,
        (unsigned)s->triangles_clipped, (unsigned)s->triangles_drawn, (unsigned)s->triangles_dropped,
        (unsigned)s->vertices_dropped, (unsigned)s->meshes_culled, (unsigned)s->parts_culled);
    fprintf(stderr,
            "\"fragments\": %u, \"depth\": \"%s\", \"wire_bytes\": %llu, \"writes\": %u, \"bus_us\": %.0f, "
            "\"clock_hz\": %u, "
            "\"fps\": %.1f}\n",
            (unsigned)s->fragments, depth_name(s, depth), (unsigned long long)(now.bytes - p->counters.bytes),
            (unsigned)(now.writes - p->counters.writes), bus_us, (unsigned)now.clock_hz, bus_us > 0 ? 1e6 / bus_us : 0);
}

static uint32_t print_complaints(const struct sim *sim)
{
    const uint32_t count = sim_complaint_count(sim);
    for (uint32_t i = 0; i < count && sim_complaint(sim, i) != NULL; i++) {
        complain("display controller: %s", sim_complaint(sim, i));
    }
    if (count > SIM_COMPLAINTS_KEPT) {
        complain("display controller: %u complaints in all", (unsigned)count);
    }
    return count;
}

int sim_player_close(struct sim_player *p)
{
    uint32_t complaints = 0;
    if (p->sim != NULL) {
        if (p->runner.driver.width != 0) { /* it was opened */
            runner_close(&p->runner);
        }
        complaints = print_complaints(p->sim);
        sim_close(p->sim);
    }
    free(p->picture.rgb);
    free(p->memory);
    return complaints == 0 ? 0 : COMPLAINED;
}
