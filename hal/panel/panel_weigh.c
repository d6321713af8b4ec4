/* See panel_weigh.h. */
#include "panel_weigh.h"

#define TRIES_LEAST  16 /* frames until the slower way is tried again, and more for what a try costs: */
#define TRIES_A_LOSS 64 /* it loses about one frame in so many */
#define TRIES_MOST   1024

static uint32_t median(const uint32_t us[3])
{
    const bool rises = us[0] < us[1];
    const uint32_t low = us[rises ? 0 : 1], high = us[rises ? 1 : 0], third = us[2];
    return third < low ? low : third < high ? third : high;
}

/* Keeps the time of the frame that ends now; `whole` is how it was sent. */
static void keep_time(struct panel_diff *diff, uint32_t us)
{
    const int way = diff->whole;
    for (int i = diff->taken[way] == 0 ? 0 : 2; i < 3; i++) { /* the first one counts for all three */
        diff->taken_us[way][diff->oldest[way]] = us;
        diff->oldest[way] = (uint8_t)((diff->oldest[way] + 1) % 3);
    }
    diff->taken[way] = 1;
}

/* Frames until the slower way is tried again: the more it loses, the later. */
static uint32_t tries_after(uint32_t windows_us, uint32_t whole_us)
{
    const uint32_t fast = windows_us < whole_us ? windows_us : whole_us,
                   slow = windows_us < whole_us ? whole_us : windows_us;
    const uint64_t loss = (uint64_t)TRIES_A_LOSS * (slow - fast) / (fast > 0 ? fast : 1);
    return loss < TRIES_MOST - TRIES_LEAST ? TRIES_LEAST + (uint32_t)loss : TRIES_MOST;
}

/* Decides whether this frame, which could be sent as windows, is better sent whole. */
static bool better_whole(struct panel_diff *diff)
{
    const uint32_t windows_us = median(diff->taken_us[0]), whole_us = median(diff->taken_us[1]);
    if (diff->taken[1] == 0 || windows_us <= diff->bits_us) {
        return windows_us > diff->bits_us; /* else no whole frame can be faster */
    }
    const bool whole = whole_us + whole_us / 16 < windows_us, tries = diff->tries == 0;
    diff->tries = tries ? tries_after(windows_us, whole_us) : diff->tries - 1;
    return whole != tries;
}

bool panel_weigh(struct panel_diff *diff, const struct panel_driver *d)
{
    if (d->hal.ops->write_ns == NULL) {
        return false;
    }
    const uint32_t now_us = d->hal.ops->time_us(d->hal.context);
    if (diff->timed && !diff->unknown) {
        keep_time(diff, now_us - diff->begun_us);
    }
    diff->begun_us = now_us;
    diff->timed = d->lit && !diff->unknown;
    diff->bits_us = panel_frame_us(d->config.panel, d->config.format, d->config.rotation, (uint32_t)d->clock_hz);
    return !diff->unknown && better_whole(diff);
}
