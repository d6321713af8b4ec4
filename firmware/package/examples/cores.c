/* Two cores: the second one takes half of the work. Here it is a thread; on an RP2040 it is core 1. */
#include "example.h"
#include "shapes.h"

#include <pthread.h>

static pthread_t thread;
static void (*work)(void *argument);
static void *work_on;

static void *run_work(void *unused)
{
    work(work_on);
    return unused;
}

/* Starts `run` on the other core; false: it is busy. The renderer calls the join before it starts something again. */
static bool other_core(void (*run)(void *argument), void *argument)
{
    work = run;
    work_on = argument;
    return pthread_create(&thread, NULL, run_work, NULL) == 0;
}

static void other_core_join(void)
{
    pthread_join(thread, NULL);
}

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct shape torus;
    static uint16_t ramp[PH_RAMP_SIZE];
    const struct ph_material material = shape_lit(ramp, 80, 210, 210);
    const struct ph_mesh mesh = shape_torus(&torus, FX_ONE / 2, &material);
    const struct ph_xform turn = ph_xform_rotate_x(frame << 25);
    const int status = example_look(r, (struct fx_vec3){0, 0, FX_INT(4)}, (struct fx_vec3){0, 0, 0}, &shapes_daylight,
                                    ph_rgb565(20, 28, 30));
    return status != 0 ? status : ph_draw_mesh(r, &mesh, &turn);
}

int main(int argc, char *argv[])
{
    struct ph_config config = example_config();
    config.other_core = other_core;
    config.other_core_join = other_core_join;
    config.cores = PH_TWO_CORES; /* a program that does not say this links nothing that shares work */
    return example_run(argc, argv, &config, draw);
}
