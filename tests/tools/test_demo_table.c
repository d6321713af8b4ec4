/*
 * The table of demos in boards/README.md says how many triangles each demo has on each microcontroller kit, and that
 * nothing of it is left out. It is made by opening each demo on each simulated kit: `build/tests/tools/test_demo_table
 * print` writes it, and the test compares.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "boards.h"
#include "runner.h"
#include "sim.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PLENTY    (1u << 20) /* bytes; a board with more is a computer */
#define KITS_MAX  32
#define ROW_BYTES 1024

/* A demo on a kit. */
struct shown {
    const char *kit;
    uint32_t triangles; /* in its first frame, those of both sides and behind the camera too */
    bool whole, blurred;
};

static struct shown show(const struct board *board, const struct demo *demo)
{
    struct hal hal;
    struct sim *const sim = sim_open(board, &hal);
    struct runner runner;
    struct runner_config config = {.board = board,
                                   .depth_format = PH_DEPTH_AUTO,
                                   .rotation = board->rotation,
                                   .band_height = board->band_height,
                                   .budget_bytes = board->scene_bytes,
                                   .demo = demo};
    const struct memory_plan plan = memory_plan(&config, demo);
    config.memory_bytes = runner_bytes(&config);
    config.memory = malloc(config.memory_bytes);
    if (sim == NULL || config.memory == NULL || runner_open(&runner, &hal, &config) != 0 ||
        runner_scene(&runner, 0) != 0) {
        abort();
    }
    const struct ph_stats stats = runner.renderer.stats;
    const struct shown shown = {.kit = board->name,
                                .triangles = stats.triangles_in,
                                .whole = plan.scene.whole && stats.triangles_dropped + stats.vertices_dropped == 0,
                                .blurred = !plan.scene.lacks_scratch};
    runner_close(&runner);
    free(config.memory);
    sim_close(sim);
    return shown;
}

struct row {
    char text[ROW_BYTES];
    size_t length;
};

__attribute__((format(printf, 2, 3))) static void add(struct row *row, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int n = vsnprintf(row->text + row->length, ROW_BYTES - row->length, format, arguments);
    va_end(arguments);
    if (n < 0 || (size_t)n >= ROW_BYTES - row->length) {
        abort();
    }
    row->length += (size_t)n;
}

/* The kits on which the demo has so many triangles: "440 on `a`, `b`". */
static void add_kits(struct row *row, const struct shown *all, uint32_t count, uint32_t triangles)
{
    add(row, "%s%u on", row->text[row->length - 1] == '|' ? " " : "; ", (unsigned)triangles);
    const char *separator = " ";
    for (uint32_t i = 0; i < count; i++) {
        if (all[i].triangles == triangles) {
            add(row, "%s`%s`", separator, all[i].kit);
            separator = ", ";
        }
    }
}

/* The largest number of triangles below a limit; 0: there is none. */
static uint32_t most_below(const struct shown *all, uint32_t count, uint32_t limit)
{
    uint32_t most = 0;
    for (uint32_t i = 0; i < count; i++) {
        most = all[i].triangles < limit && all[i].triangles > most ? all[i].triangles : most;
    }
    return most;
}

static void add_faults(struct row *row, const struct shown *all, uint32_t count)
{
    const char *separator = " ";
    const size_t before = row->length;
    for (uint32_t i = 0; i < count; i++) {
        if (!all[i].whole || !all[i].blurred) {
            add(row, "%s`%s` %s", separator, all[i].kit, all[i].whole ? "without the blur" : "IS NOT WHOLE");
            separator = ", ";
        }
    }
    add(row, row->length == before ? "  |" : " |");
}

/* "| `name` | most | fewer on which kits | what is missing where |" */
static struct row row_of(const struct demo *demo)
{
    struct shown all[KITS_MAX];
    struct row row = {{0}, 0};
    uint32_t count = 0;
    for (uint32_t b = 0; b < board_count; b++) {
        if (board_list[b]->scene_bytes <= PLENTY && count < KITS_MAX) {
            all[count++] = show(board_list[b], demo);
        }
    }
    const uint32_t most = most_below(all, count, UINT32_MAX);
    add(&row, "| `%s` | %u |", demo->name, (unsigned)most);
    const size_t before = row.length;
    for (uint32_t next = most_below(all, count, most); next > 0; next = most_below(all, count, next)) {
        add_kits(&row, all, count, next);
    }
    add(&row, row.length == before ? "  |" : " |");
    add_faults(&row, all, count);
    return row;
}

static void the_table_is_what_the_kits_show(void **state)
{
    (void)state;
    FILE *const file = fopen("boards/README.md", "rb");
    assert_non_null(file);
    char *const readme = calloc(1, 1 << 20);
    assert_non_null(readme);
    assert_true(fread(readme, 1, (1 << 20) - 1, file) > 0);
    assert_int_equal(fclose(file), 0);
    uint32_t missing = 0;
    for (uint32_t d = 0; d < demo_count; d++) {
        const struct row row = row_of(demo_list[d]);
        char line[ROW_BYTES + 2];
        snprintf(line, sizeof line, "\n%s\n", row.text);
        if (strstr(readme, line) == NULL) {
            fprintf(stderr, "%s\n", row.text);
            missing++;
        }
    }
    free(readme);
    assert_int_equal(missing, 0);
}

int main(int argc, char *argv[])
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_table_is_what_the_kits_show)};
    if (argc < 2 || strcmp(argv[1], "print") != 0) {
        return cmocka_run_group_tests(tests, NULL, NULL);
    }
    printf(
        "| demo | triangles | fewer, on kits with less memory or a smaller picture | without |\n|---|---|---|---|\n");
    for (uint32_t d = 0; d < demo_count; d++) {
        printf("%s\n", row_of(demo_list[d]).text);
    }
    return 0;
}
