/*
 * See panel_diff.h.
 *
 * Lines, columns and areas below are in units: a unit is a pixel, or the pixels that share a byte. Lines count from
 * the first that is not yet decided. bits[0] has a bit for each unit, line by line; bits[1] has the same bits column by
 * column. A function that takes `turned` works on bits[turned], with x and y exchanged for 1. Costs are in half bytes,
 * because a pixel of RGB444 takes one and a half bytes.
 */
#include "panel_diff.h"

#include "panel_weigh.h"

#include <string.h>

#define DECIDE_LINES 32 /* fewer lines wait for the next call */
#define SLAB_LINES   64 /* highest slab; it bounds the time */
#define COARSE_LINES 4  /* where a write costs time slabs are cut at every fourth line: 1/16 of the time to plan */
#define WRITE_NS_MAX 10000000

struct area {
    uint32_t x0, x1, y0, y1; /* x1, y1: one past the end */
};

static uint32_t words_of(uint32_t width)
{
    return (width + 31) / 32;
}

static uint32_t lesser(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

static uint32_t larger(uint32_t a, uint32_t b)
{
    return a > b ? a : b;
}

/* Units of 1 << share pixels that n pixels take; `lead` pixels of the first one lie before them. */
static uint32_t units(uint32_t n, uint32_t share, uint32_t lead)
{
    return share == 0 ? n : (n + lead + (1U << share) - 1) >> share;
}

/* The next n bytes of memory, a multiple of 8; NULL if there is no memory and they are only counted. */
static void *take(uint8_t *memory, size_t *used, size_t n)
{
    void *part = memory != NULL ? memory + *used : NULL;
    *used += (n + 7) / 8 * 8;
    return part;
}

static size_t divide_memory(struct panel_diff *diff, uint8_t *memory)
{
    const size_t width = diff->width, height = diff->height, longer = larger(diff->width, diff->height);
    size_t used = 0;
    diff->shown = take(memory, &used, sizeof(uint16_t) * width * height);
    diff->bits[0] = take(memory, &used, sizeof(uint32_t) * words_of(diff->width) * height);
    diff->bits[1] = take(memory, &used, sizeof(uint32_t) * words_of(diff->height) * width);
    for (int i = 0; i < 2; i++) {
        diff->cost[i] = take(memory, &used, sizeof(uint32_t) * (longer + 1));
        diff->next[i] = take(memory, &used, sizeof(uint16_t) * (longer + 1));
        diff->merged[i] = take(memory, &used, sizeof(uint32_t) * words_of((uint32_t)longer));
    }
    return used;
}

size_t panel_diff_bytes(uint16_t width, uint16_t height)
{
    struct panel_diff diff = {.width = width, .height = height};
    return divide_memory(&diff, NULL);
}

/* The time of a write by itself, as the half bytes that the bus could send in that time. */
static uint32_t write_cost(const struct panel_driver *d)
{
    const struct hal_ops *ops = d->hal.ops;
    const uint32_t ns = ops->write_ns == NULL ? 0 : lesser(ops->write_ns(d->hal.context), WRITE_NS_MAX);
    return (uint32_t)((uint64_t)(ns / 100) * ((uint32_t)d->clock_hz / 1000) / 40000);
}

/* The cost of a window's borders, start and writes. A command and its parameters are two writes. */
static void set_costs(struct panel_diff *diff, const struct panel_driver *d)
{
    const struct panel_controller *c = d->config.panel->controller;
    const uint32_t write = write_cost(d);
    if (diff->pages) {
        diff->step = diff->slab = 1;
        diff->open_cost = diff->beside_cost = 2 * PANEL_PAGE_BYTES + 2 * write;
        return;
    }
    diff->slab = SLAB_LINES;
    if (c->lines != NULL) { /* a unit is a line, and comes with its address */
        diff->step = 1;
        diff->unit_cost = 2 * (diff->width / 8U + PANEL_LINE_BYTES);
        diff->open_cost = diff->beside_cost = 1 + write; /* lines beside each other are one window */
        return;
    }
    diff->step = write > 0 ? COARSE_LINES : 1;
    const uint32_t border = 2 * panel_border_bytes(c) + 2 * write, start = (2 + write) * panel_start_bytes(c);
    diff->open_cost = 2 * border + start + write;
    diff->beside_cost = c->memory_write == 0 ? diff->open_cost : diff->open_cost - border;
}

int panel_diff_init(struct panel_diff *diff, const struct panel_driver *d, uint32_t refresh_frames, void *memory,
                    size_t bytes)
{
    static const uint8_t unit_costs[PANEL_FORMATS] = {4, 6, 3, 2, 2, 2};
    if (bytes < panel_diff_bytes(d->width, d->height)) {
        return HAL_EINVAL;
    }
    memset(diff, 0, sizeof *diff);
    diff->refresh_frames = refresh_frames;
    diff->width = d->width;
    diff->height = d->height;
    diff->share_x = d->share_x;
    diff->share_y = d->share_y;
    diff->lead = d->lead;
    diff->pages = d->config.panel->controller->set_page != 0;
    diff->units_x = units(d->width, d->share_x, d->lead);
    diff->words[0] = words_of(diff->units_x);
    diff->words[1] = words_of(d->height);
    diff->unit_cost = unit_costs[d->config.format];
    diff->unknown = true;
    divide_memory(diff, memory);
    return HAL_OK;
}

/* ---- what changed ------------------------------------------------------------------------------- */

/* The line of units in which line y of the picture lies. */
static uint32_t unit_line(const struct panel_diff *diff, uint32_t y)
{
    const uint32_t lead = diff->share_y != 0 ? diff->lead : 0;
    return ((y + lead) >> diff->share_y) - ((diff->first + lead) >> diff->share_y);
}

static uint32_t unit_lines(const struct panel_diff *diff)
{
    return diff->row == diff->first ? 0 : unit_line(diff, diff->row - 1U) + 1;
}

/* Whether two pixels differ on the glass. */
static bool differ(const struct panel_diff *diff, const uint8_t *a, const uint8_t *b, uint32_t x, uint32_t y)
{
    switch (diff->out->config.format) {
    case PANEL_RGB444: /* it drops these bits */
        return (((a[0] ^ b[0]) & 0xF7) | ((a[1] ^ b[1]) & 0x9E)) != 0;
    case PANEL_GREY4:
        return (a[0] != b[0] || a[1] != b[1]) && panel_grey4(a[0], a[1], x, y) != panel_grey4(b[0], b[1], x, y);
    case PANEL_MONO_DITHER:
    case PANEL_MONO_THRESHOLD:
        return panel_mono(diff->out->config.format, a[0], a[1], x, y) !=
               panel_mono(diff->out->config.format, b[0], b[1], x, y);
    default:
        return a[0] != b[0] || a[1] != b[1];
    }
}

/* Compares line diff->row with the line on the glass, marks the units that changed, and keeps the line. */
static void take_line(struct panel_diff *diff, const uint16_t *pixels)
{
    uint16_t *shown = diff->shown + (size_t)diff->row * diff->width;
    const uint32_t line = unit_line(diff, diff->row);
    uint32_t *bits = diff->bits[0] + (size_t)line * diff->words[0];
    if (diff->row == diff->first || line != unit_line(diff, diff->row - 1U)) {
        memset(bits, 0, sizeof *bits * diff->words[0]);
    }
    if (memcmp(shown, pixels, sizeof *pixels * diff->width) != 0) {
        for (uint32_t x = 0; x < diff->width; x++) {
            if (differ(diff, (const uint8_t *)(shown + x), (const uint8_t *)(pixels + x), x, diff->row)) {
                const uint32_t unit = diff->share_x != 0 ? (x + diff->lead) >> diff->share_x : x;
                bits[unit / 32] |= 1U << unit % 32;
            }
        }
        memcpy(shown, pixels, sizeof *pixels * diff->width);
    }
    diff->row++;
}

/* The first unit, from `from` on, whose bit is `value`; or `end`. */
static uint32_t find_bit(const uint32_t *bits, uint32_t from, uint32_t end, bool value)
{
    const uint32_t flip = value ? 0 : UINT32_MAX;
    while (from < end) {
        const uint32_t rest = (bits[from / 32] ^ flip) >> from % 32;
        if (rest != 0) {
            const uint32_t found = from + (uint32_t)__builtin_ctz(rest);
            return found < end ? found : end;
        }
        from = (from / 32 + 1) * 32;
    }
    return end;
}

static void turn_bits(struct panel_diff *diff, const struct area *all)
{
    memset(diff->bits[1], 0, sizeof *diff->bits[1] * diff->words[1] * diff->units_x);
    for (uint32_t y = 0; y < all->y1; y++) {
        const uint32_t *line = diff->bits[0] + (size_t)y * diff->words[0];
        for (uint32_t x = find_bit(line, 0, all->x1, true); x < all->x1; x = find_bit(line, x + 1, all->x1, true)) {
            diff->bits[1][(size_t)x * diff->words[1] + y / 32] |= 1U << y % 32;
        }
    }
}

/* ---- which windows ------------------------------------------------------------------------------ */

/* Finds the slab's next window. It includes a gap that costs no more than another window. False: there is none. */
static bool next_window(const struct panel_diff *diff, const uint32_t *bits, uint32_t lines, struct area *window,
                        uint32_t from, uint32_t end)
{
    const uint32_t gap = diff->beside_cost / (lines * diff->unit_cost);
    window->x0 = find_bit(bits, from, end, true);
    if (window->x0 == end) {
        return false;
    }
    uint32_t next = window->x0;
    do {
        window->x1 = find_bit(bits, next, end, false);
        next = find_bit(bits, window->x1, end, true);
    } while (next < end && next - window->x1 <= gap);
    return true;
}

static uint32_t slab_cost(const struct panel_diff *diff, const uint32_t *bits, uint32_t lines, const struct area *area)
{
    struct area window = {0, area->x0, 0, 0};
    uint32_t cost = 0;
    while (next_window(diff, bits, lines, &window, window.x1, area->x1)) {
        cost += cost == 0 ? diff->open_cost : diff->beside_cost;
        cost += (window.x1 - window.x0) * lines * diff->unit_cost;
    }
    return cost;
}

/* Adds line y to the union of lines, in the words in which the area lies. */
static void merge_line(const struct panel_diff *diff, int turned, const struct area *area, uint32_t y, bool first)
{
    const uint32_t *bits = diff->bits[turned] + (size_t)y * diff->words[turned];
    uint32_t *merged = diff->merged[turned];
    for (uint32_t i = area->x0 / 32; i <= (area->x1 - 1) / 32; i++) {
        merged[i] = (first ? 0 : merged[i]) | bits[i];
    }
}

/*
 * Cuts an area into slabs so that the slabs' windows are cheapest together. Dynamic programming from the last line up:
 * the cheapest plan from line y on is a slab that starts there and the cheapest plan from the slab's end on.
 * next[turned] holds the slabs. Returns the cost.
 */
static uint32_t plan(struct panel_diff *diff, int turned, const struct area *area)
{
    uint32_t *cost = diff->cost[turned];
    const uint32_t *merged = diff->merged[turned];
    cost[area->y1] = 0;
    for (uint32_t steps = (area->y1 - area->y0 + diff->step - 1) / diff->step; steps-- > 0;) {
        const uint32_t y = area->y0 + steps * diff->step, last = lesser(area->y1, y + diff->slab);
        uint32_t best = UINT32_MAX;
        for (uint32_t from = y, end; from < last; from = end) {
            end = lesser(from + diff->step, last);
            for (uint32_t i = from; i < end; i++) {
                merge_line(diff, turned, area, i, i == y);
            }
            const uint32_t slab = slab_cost(diff, merged, end - y, area);
            if (slab >= best) {
                break; /* a longer slab costs more still */
            }
            if (slab + cost[end] < best) {
                best = slab + cost[end];
                diff->next[turned][y] = (uint16_t)end;
            }
            if (slab == 0) {
                break; /* nothing changed in this line, so it needs no window */
            }
        }
        cost[y] = best;
    }
    return cost[area->y0];
}

/* ---- sending ------------------------------------------------------------------------------------ */

static uint32_t pixel_of(uint32_t unit, uint32_t share, uint32_t lead, uint32_t origin, uint32_t size)
{
    if (share == 0) {
        return origin + unit;
    }
    const uint32_t pixel = (((origin + lead) >> share) + unit) << share;
    return pixel < lead ? 0 : pixel - lead < size ? pixel - lead : size;
}

/* The bytes of a window on the wire. Borders that the window before had, too, are not sent. */
static uint32_t predict(struct panel_diff *diff, const struct area *px)
{
    const struct panel_controller *c = diff->out->config.panel->controller;
    const bool again = c->memory_write == 0;
    const bool columns = again || diff->last[0] != px->x0 || diff->last[1] != px->x1;
    const bool lines = again || diff->last[2] != px->y0 || diff->last[3] != px->y1;
    const uint32_t width = px->x1 - px->x0, height = px->y1 - px->y0;
    const uint32_t lead = (uint32_t)diff->lead * ((diff->share_x != 0 ? px->x0 : px->y0) == 0);
    const uint32_t cells = units(width, diff->share_x, lead) * units(height, diff->share_y, lead);
    if (diff->pages) { /* turned, the driver collects at most `diff->width` lines for a page */
        return cells + PANEL_PAGE_BYTES * (diff->share_y != 0 ? 1 : (height + diff->width - 1) / diff->width);
    }
    diff->last[0] = (uint16_t)px->x0;
    diff->last[1] = (uint16_t)px->x1;
    diff->last[2] = (uint16_t)px->y0;
    diff->last[3] = (uint16_t)px->y1;
    return ((uint32_t)columns + lines) * panel_border_bytes(c) + panel_start_bytes(c) +
           (cells * diff->unit_cost + 1) / 2;
}

static bool unchanged(const struct panel_diff *diff, int turned, uint32_t y, uint32_t x0, uint32_t x1)
{
    return find_bit(diff->bits[turned] + (size_t)y * diff->words[turned], x0, x1, true) == x1;
}

/* The window without unchanged edges, which coarse cuts leave. Something changed in it, so the loops end. */
static struct area trimmed(const struct panel_diff *diff, struct area w)
{
    while (unchanged(diff, 0, w.y0, w.x0, w.x1)) {
        w.y0++;
    }
    while (unchanged(diff, 0, w.y1 - 1, w.x0, w.x1)) {
        w.y1--;
    }
    while (unchanged(diff, 1, w.x0, w.y0, w.y1)) {
        w.x0++;
    }
    while (unchanged(diff, 1, w.x1 - 1, w.y0, w.y1)) {
        w.x1--;
    }
    return w;
}

static uint32_t area_cost(const struct panel_diff *diff, const struct area *w)
{
    return (w->x1 - w->x0) * (w->y1 - w->y0) * diff->unit_cost;
}

static void send_window(struct panel_diff *diff, const struct area *window)
{
    const struct area px = {pixel_of(window->x0, diff->share_x, diff->lead, 0, diff->width),
                            pixel_of(window->x1, diff->share_x, diff->lead, 0, diff->width),
                            pixel_of(window->y0, diff->share_y, diff->lead, diff->first, diff->height),
                            pixel_of(window->y1, diff->share_y, diff->lead, diff->first, diff->height)};
    if (diff->status < 0) {
        return;
    }
    diff->windows++;
    diff->bytes += predict(diff, &px);
    diff->status = panel_window(diff->out, px.x0, px.y0, px.x1 - px.x0, px.y1 - px.y0);
    if (diff->status >= 0) {
        diff->status =
            panel_window_rows(diff->out, diff->shown + (size_t)px.y0 * diff->width + px.x0, diff->width, px.y1 - px.y0);
    }
}

/* Finds the window of slab y .. end after *window; its x1 says where to look from. False: there is no more window. */
static bool slab_window(struct panel_diff *diff, int turned, const struct area *area, struct area *window)
{
    for (uint32_t y = window->y0; y < window->y1; y++) {
        merge_line(diff, turned, area, y, y == window->y0);
    }
    return next_window(diff, diff->merged[turned], window->y1 - window->y0, window, window->x1, area->x1);
}

static struct area turn(const struct area *area)
{
    return (struct area){area->y0, area->y1, area->x0, area->x1};
}

static void send_turned(struct panel_diff *diff, int turned, const struct area *area)
{
    const struct area upright = turned ? turn(area) : *area;
    const struct area small = trimmed(diff, upright);
    const uint32_t borders = diff->open_cost - diff->beside_cost; /* the smaller one may need them sent again */
    send_window(diff, area_cost(diff, &small) + borders < area_cost(diff, &upright) ? &small : &upright);
}

/* Sends a window of the first cut, whole or cut in the other direction. */
static void send_or_cut(struct panel_diff *diff, int turned, const struct area *window)
{
    const uint32_t whole = diff->open_cost + area_cost(diff, window);
    const struct area area = turn(window);
    const int other = !turned;
    if (window->y1 - window->y0 == 1 || plan(diff, other, &area) >= whole) {
        send_turned(diff, turned, window);
        return;
    }
    for (uint32_t y = area.y0; y < area.y1; y = diff->next[other][y]) {
        struct area part = {0, area.x0, y, diff->next[other][y]};
        while (slab_window(diff, other, &area, &part)) {
            send_turned(diff, other, &part);
        }
    }
}

/* Sends the windows that plan() has found. */
static void send_plan(struct panel_diff *diff, int turned, const struct area *area)
{
    for (uint32_t y = area->y0; y < area->y1; y = diff->next[turned][y]) {
        struct area window = {0, area->x0, y, diff->next[turned][y]};
        while (slab_window(diff, turned, area, &window)) {
            send_or_cut(diff, turned, &window);
        }
    }
}

/* Finds the next group of neighbouring columns that no unchanged column separates. False: there is no more group. */
static bool next_group(struct panel_diff *diff, int turned, const struct area *all, struct area *group)
{
    struct area window = {0, group->x1, all->y0, all->y1};
    const bool found = slab_window(diff, turned, all, &window);
    group->x0 = window.x0;
    group->x1 = window.x1;
    return found;
}

/* The cost of all groups, each planned by itself. */
static uint32_t plan_groups(struct panel_diff *diff, int turned, const struct area *all)
{
    struct area group = *all;
    uint32_t cost = 0;
    for (group.x1 = 0; next_group(diff, turned, all, &group);) {
        cost += plan(diff, turned, &group);
    }
    return cost;
}

static void send_groups(struct panel_diff *diff, int turned, const struct area *all)
{
    struct area group = *all;
    for (group.x1 = 0; next_group(diff, turned, all, &group);) {
        plan(diff, turned, &group);
        send_plan(diff, turned, &group);
    }
}

/* Sends what changed in the lines that are not yet decided. Slabs of lines and slabs of columns are compared, each for
 * all columns at once and for each group by itself. */
static void decide(struct panel_diff *diff)
{
    const struct area upright = {0, diff->units_x, 0, unit_lines(diff)};
    const struct area all[2] = {upright, turn(&upright)};
    uint32_t cost[2], apart[2];
    turn_bits(diff, &upright);
    if (diff->pages) { /* each by itself: a slab is one */
        const int across = diff->share_y == 0;
        plan(diff, across, &all[across]);
        send_plan(diff, across, &all[across]);
        diff->first = diff->row;
        return;
    }
    for (int turned = 0; turned < 2; turned++) {
        apart[turned] = plan_groups(diff, turned, &all[turned]);
        cost[turned] = plan(diff, turned, &all[turned]);
    }
    const int turned = lesser(cost[1], apart[1]) < lesser(cost[0], apart[0]);
    if (apart[turned] < cost[turned]) {
        send_groups(diff, turned, &all[turned]);
    } else {
        plan(diff, turned, &all[turned]);
        send_plan(diff, turned, &all[turned]);
    }
    diff->first = diff->row;
}

/* ---- frames ------------------------------------------------------------------------------------- */

int panel_diff_begin(struct panel_diff *diff, struct panel_driver *d)
{
    const bool better = panel_weigh(diff, d);
    diff->whole = diff->unknown || better || (diff->refresh_frames != 0 && ++diff->frames >= diff->refresh_frames);
    diff->frames = diff->whole ? 0 : diff->frames;
    diff->unknown = true; /* until the frame has ended without error */
    diff->first = diff->row = 0;
    diff->windows = diff->bytes = 0;
    memset(diff->last, 0, sizeof diff->last);
    diff->status = HAL_OK;
    set_costs(diff, d);
    if (diff->whole) {
        diff->windows = 1;
        diff->bytes = panel_frame_bytes(d->config.panel, d->config.format, d->config.rotation);
        diff->status = panel_frame_begin(d);
    } else {
        diff->bytes = d->config.panel->controller->lines != NULL ? PANEL_MESSAGE_BYTES : 0;
        panel_windows_begin(d);
    }
    return diff->status;
}

static void send_whole(struct panel_diff *diff, const uint16_t *pixels, uint32_t lines)
{
    uint16_t *shown = diff->shown + (size_t)diff->row * diff->width;
    memcpy(shown, pixels, sizeof *pixels * diff->width * lines);
    diff->row = (uint16_t)(diff->row + lines);
    diff->status = panel_rows(diff->out, shown, lines);
}

static void send_changes(struct panel_diff *diff, const uint16_t *pixels, uint32_t lines)
{
    for (uint32_t i = 0; i < lines; i++) {
        take_line(diff, pixels + (size_t)i * diff->width);
    }
    const bool last = diff->row == diff->height;
    const bool between = diff->share_y == 0 || ((diff->row + diff->lead) & ((1U << diff->share_y) - 1)) == 0;
    if (diff->row > diff->first && (last || (between && diff->row - diff->first >= DECIDE_LINES))) {
        decide(diff);
    }
}

int panel_diff_rows(struct panel_diff *diff, struct panel_driver *d, const uint16_t *pixels, uint32_t lines)
{
    if (diff->status < 0 || lines > (uint32_t)(diff->height - diff->row)) {
        return diff->status < 0 ? diff->status : HAL_EINVAL;
    }
    diff->out = d;
    if (lines == 0) {
        return HAL_OK;
    }
    if (diff->whole) {
        send_whole(diff, pixels, lines);
    } else {
        send_changes(diff, pixels, lines);
    }
    return diff->status;
}

int panel_diff_end(struct panel_diff *diff, struct panel_driver *d)
{
    const int status = diff->whole ? panel_frame_end(d) : panel_wait(d);
    if (status < 0 || diff->status < 0) {
        return diff->status < 0 ? diff->status : status;
    }
    if (diff->row != diff->height) {
        return HAL_EINVAL;
    }
    diff->unknown = false;
    return HAL_OK;
}

/* ---- as a sender -------------------------------------------------------------------------------- */

static int sender_begin(void *diff, struct panel_driver *d)
{
    return panel_diff_begin(diff, d);
}

static int sender_rows(void *diff, struct panel_driver *d, const uint16_t *pixels, uint32_t lines)
{
    return panel_diff_rows(diff, d, pixels, lines);
}

static int sender_end(void *diff, struct panel_driver *d)
{
    return panel_diff_end(diff, d);
}

struct panel_sender panel_diff_sender(struct panel_diff *diff)
{
    static const struct panel_sender_ops ops = {
        .copies = true, .begin = sender_begin, .rows = sender_rows, .end = sender_end};
    return (struct panel_sender){&ops, diff};
}
