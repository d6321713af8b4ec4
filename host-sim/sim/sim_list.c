/* See sim_list.h. */
#include "sim_list.h"

#include "board.h"
#include "json_text.h"

#include <stdio.h>

void sim_list_views(const struct demo *demo, char *text, size_t size)
{
    size_t n = 0;
    text[0] = '\0';
    for (size_t i = 0; demo->views != NULL && demo->views[i] != NULL && n < size; i++) {
        n += (size_t)snprintf(text + n, size - n, " %s", demo->views[i]);
    }
}

void sim_list_print(void)
{
    for (uint32_t i = 0; i < demo_count; i++) {
        char loop[24], views[200];
        sim_list_views(demo_list[i], views, sizeof views);
        snprintf(loop, sizeof loop, "%u frame%s", (unsigned)demo_list[i]->loop_frames,
                 demo_list[i]->loop_frames == 1 ? "" : "s");
        printf("demo   %-26s %-11s %s%s%s%s\n", demo_list[i]->name, loop, demo_list[i]->summary,
               views[0] != '\0' ? "; --view" : "", views, demo_list[i]->by_name_only ? "; by name only" : "");
    }
    for (uint32_t i = 0; i < board_count; i++) {
        const struct panel *panel = board_list[i]->panel;
        char size[16];
        snprintf(size, sizeof size, "%ux%u", (unsigned)panel_width(panel, board_list[i]->rotation),
                 (unsigned)panel_height(panel, board_list[i]->rotation));
        printf("board  %-26s %-8s %s\n", board_list[i]->name, size, board_list[i]->title);
    }
}

void sim_list_print_json(void)
{
    fputs("{\"demos\": [", stdout);
    for (uint32_t i = 0; i < demo_count; i++) {
        const struct demo *const d = demo_list[i];
        printf("%s\n  {\"name\": \"%s\", \"frames\": %u, \"summary\": ", i > 0 ? "," : "", d->name,
               (unsigned)d->loop_frames);
        json_text(stdout, d->summary);
        fputs(", \"views\": [", stdout);
        for (size_t k = 0; d->views != NULL && d->views[k] != NULL; k++) {
            printf("%s\"%s\"", k > 0 ? ", " : "", d->views[k]);
        }
        fputs("]}", stdout);
    }
    fputs("\n ], \"boards\": [", stdout);
    for (uint32_t i = 0; i < board_count; i++) {
        const struct board *const b = board_list[i];
        printf("%s\n  {\"name\": \"%s\", \"width\": %u, \"height\": %u, \"panel\": \"%s\", \"title\": ",
               i > 0 ? "," : "", b->name, (unsigned)panel_width(b->panel, b->rotation),
               (unsigned)panel_height(b->panel, b->rotation), b->panel->name);
        json_text(stdout, b->title);
        fputs("}", stdout);
    }
    fputs("\n ]}\n", stdout);
}
