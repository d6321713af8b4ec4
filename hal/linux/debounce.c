/* See debounce.h. */
#include "debounce.h"

static void hold(struct linux_button *button, bool pressed, uint64_t time_ns)
{
    button->held = pressed;
    button->held_ns = time_ns;
    button->was_held |= pressed;
}

void linux_debounce_start(struct linux_button *button, bool pressed, uint64_t now_ns)
{
    button->raw = pressed;
    button->edge_ns = now_ns;
    button->was_held = false;
    hold(button, pressed, now_ns);
}

void linux_debounce_edge(struct linux_button *button, bool pressed, uint64_t time_ns, uint64_t settle_ns)
{
    button->raw = pressed;
    button->edge_ns = time_ns;
    if (pressed != button->held && time_ns >= button->held_ns + settle_ns) {
        hold(button, pressed, time_ns);
    }
}

bool linux_debounce_look(struct linux_button *button, uint64_t now_ns, uint64_t settle_ns)
{
    if (button->raw != button->held && now_ns >= button->edge_ns + settle_ns) {
        hold(button, button->raw, now_ns);
    }
    const bool seen = button->held || button->was_held;
    button->was_held = false;
    return seen;
}
