/* See sim_window.h. The picture is enlarged by whole numbers, so that each pixel of the panel stays a square. */
#include "sim_window.h"

#include "complain.h"
#include "hal.h"

#include <SDL2/SDL.h>

struct sim_window {
    SDL_Window *window;
    SDL_Renderer *renderer;
    SDL_Texture *texture;
    int pitch;         /* bytes of a row */
    int width, height; /* of the picture */
    int scale;         /* pixels of the screen for one of the picture's, at the start */
    uint64_t due;      /* when the next picture is shown, in ticks of SDL's performance counter */
};

static const struct {
    SDL_Scancode key;
    uint32_t button; /* enum hal_button */
} keyboard[] = {
    {SDL_SCANCODE_UP, HAL_BUTTON_UP},           {SDL_SCANCODE_DOWN, HAL_BUTTON_DOWN},
    {SDL_SCANCODE_LEFT, HAL_BUTTON_LEFT},       {SDL_SCANCODE_RIGHT, HAL_BUTTON_RIGHT},
    {SDL_SCANCODE_RETURN, HAL_BUTTON_SELECT},   {SDL_SCANCODE_SPACE, HAL_BUTTON_SELECT},
    {SDL_SCANCODE_KP_ENTER, HAL_BUTTON_SELECT},
};

#define KEYS (sizeof keyboard / sizeof keyboard[0])

static int scale_for(int width, int height)
{
    SDL_Rect screen = {0, 0, 1024, 768};
    SDL_GetDisplayUsableBounds(0, &screen);
    const int across = screen.w * 3 / 4 / width, down = screen.h * 3 / 4 / height;
    const int scale = across < down ? across : down;
    return scale > 1 ? scale : 1;
}

static bool set_size(struct sim_window *w, int width, int height)
{
    w->pitch = 3 * width;
    w->width = width;
    w->height = height;
    SDL_DestroyTexture(w->texture);
    w->texture = SDL_CreateTexture(w->renderer, SDL_PIXELFORMAT_RGB24, SDL_TEXTUREACCESS_STREAMING, width, height);
    return w->texture != NULL && SDL_RenderSetLogicalSize(w->renderer, width, height) == 0;
}

void sim_window_title(struct sim_window *window, const char *title)
{
    SDL_SetWindowTitle(window->window, title);
}

int sim_window_resize(struct sim_window *window, uint16_t width, uint16_t height)
{
    return set_size(window, width, height) ? 0 : complain("--window: %s", SDL_GetError());
}

static bool open_parts(struct sim_window *w, const char *title, int width, int height)
{
    const int place = (int)SDL_WINDOWPOS_CENTERED;
    w->scale = scale_for(width, height);
    w->window = SDL_CreateWindow(title, place, place, width * w->scale, height * w->scale, SDL_WINDOW_RESIZABLE);
    w->renderer = w->window != NULL ? SDL_CreateRenderer(w->window, -1, 0) : NULL;
    return w->renderer != NULL && SDL_RenderSetIntegerScale(w->renderer, SDL_TRUE) == 0 && set_size(w, width, height);
}

/* Chooses SDL's video driver. It would fall back to a screen that nobody sees, so the drivers are named;
 * SDL_VIDEODRIVER of the user has priority. Without XDG_RUNTIME_DIR the library of Wayland does not work, and prints
 * lines of its own. */
static void choose_screen(void)
{
    const bool wayland = SDL_getenv("XDG_RUNTIME_DIR") != NULL;
    SDL_SetHint(SDL_HINT_VIDEODRIVER, wayland ? "x11,wayland,cocoa,KMSDRM" : "x11,cocoa,KMSDRM");
}

int sim_window_open(struct sim_window **window, const char *title, uint16_t width, uint16_t height)
{
    struct sim_window *w = SDL_calloc(1, sizeof *w);
    *window = NULL;
    if (w == NULL) {
        return complain("--window: not enough memory");
    }
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1"); /* the program has its own */
    choose_screen();
    if (SDL_Init(SDL_INIT_VIDEO) != 0 || !open_parts(w, title, width, height)) {
        const int status = complain("--window: no screen (%s); run it on a desktop, or set DISPLAY", SDL_GetError());
        sim_window_close(w);
        return status;
    }
    w->due = SDL_GetPerformanceCounter();
    *window = w;
    return 0;
}

static uint32_t button_of(SDL_Scancode key)
{
    uint32_t button = 0;
    for (size_t i = 0; i < KEYS; i++) {
        button |= keyboard[i].key == key ? keyboard[i].button : 0;
    }
    return button;
}

static uint16_t pixels(int on_screen, int scale)
{
    const int n = on_screen / scale;
    return (uint16_t)(n < 1 ? 1 : n > 1024 ? 1024 : n);
}

static void fill_screen(SDL_Window *window)
{
    const bool fills = (SDL_GetWindowFlags(window) & SDL_WINDOW_FULLSCREEN_DESKTOP) == SDL_WINDOW_FULLSCREEN_DESKTOP;
    SDL_SetWindowFullscreen(window, fills ? 0 : SDL_WINDOW_FULLSCREEN_DESKTOP);
}

/* A key went down; one that is up again counts, too, and one that is held counts once, but for the kit's buttons.
 * False: Esc. */
static bool take_key(SDL_Window *window, const SDL_KeyboardEvent *key, struct sim_window_input *input)
{
    const SDL_Scancode code = key->keysym.scancode;
    input->buttons |= button_of(code);
    input->step |= code == SDL_SCANCODE_N;
    if (key->repeat == 0) {
        input->pause ^= code == SDL_SCANCODE_P;
        input->save |= code == SDL_SCANCODE_S;
        if (code == SDL_SCANCODE_F) {
            fill_screen(window);
        }
    }
    return code != SDL_SCANCODE_ESCAPE;
}

bool sim_window_input(const struct sim_window *window, struct sim_window_input *input)
{
    bool open = true;
    *input = (struct sim_window_input){.buttons = 0};
    SDL_PumpEvents();
    for (SDL_Event event; !input->step && /* keys behind a step are of the next picture */
                          SDL_PeepEvents(&event, 1, SDL_GETEVENT, SDL_FIRSTEVENT, SDL_LASTEVENT) == 1;) {
        if (event.type == SDL_QUIT) {
            open = false;
        } else if (event.type == SDL_KEYDOWN) {
            open = take_key(window->window, &event.key, input) && open;
        } else if (event.type == SDL_MOUSEWHEEL) {
            input->notches += event.wheel.y;
        } else if (event.type == SDL_MOUSEMOTION && (event.motion.state & SDL_BUTTON_LMASK) != 0) {
            input->drag += event.motion.xrel;
            input->lift += event.motion.yrel;
        }
    }
    const uint8_t *down = SDL_GetKeyboardState(NULL);
    for (size_t i = 0; i < KEYS; i++) {
        input->buttons |= down[keyboard[i].key] ? keyboard[i].button : 0;
    }
    int width, height;
    SDL_GetWindowSize(window->window, &width, &height);
    input->width = pixels(width, window->scale);
    input->height = pixels(height, window->scale);
    return open;
}

/* Sleeps until the picture is due. If it is late, the time of the next one counts from now. */
static void wait_until_due(struct sim_window *w, uint64_t frame_ns)
{
    const uint64_t hz = SDL_GetPerformanceFrequency();
    w->due += frame_ns * (hz / 1000) / 1000000;
    const uint64_t now = SDL_GetPerformanceCounter();
    if (now < w->due) {
        SDL_Delay((uint32_t)((w->due - now) * 1000 / hz));
    } else {
        w->due = now;
    }
}

/* A picture becomes larger by whole numbers. In a window that is smaller it becomes smaller by any, so that all is
 * seen. */
static void fit(const struct sim_window *w)
{
    int width, height;
    SDL_GetRendererOutputSize(w->renderer, &width, &height);
    const SDL_bool is_small = width < w->width || height < w->height;
    if (SDL_RenderGetIntegerScale(w->renderer) == is_small) {
        SDL_RenderSetIntegerScale(w->renderer, !is_small);
    }
}

void sim_window_show(struct sim_window *window, const uint8_t *rgb, uint64_t frame_ns)
{
    SDL_UpdateTexture(window->texture, NULL, rgb, window->pitch);
    fit(window);
    SDL_RenderClear(window->renderer);
    SDL_RenderCopy(window->renderer, window->texture, NULL, NULL);
    wait_until_due(window, frame_ns);
    SDL_RenderPresent(window->renderer);
}

void sim_window_close(struct sim_window *window)
{
    if (window != NULL) {
        SDL_DestroyTexture(window->texture);
        SDL_DestroyRenderer(window->renderer);
        SDL_DestroyWindow(window->window);
        SDL_free(window);
        SDL_Quit();
    }
}
