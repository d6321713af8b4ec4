/* Pinhole in a window of SDL2, by ph_show: cc sdl2.c $(pkg-config --cflags --libs pinhole sdl2). Its argument: frames.
 */
#include "triangle.h"

#include <SDL.h>
#include <stdlib.h>

static int flush(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    const SDL_Rect to = {(int)x, (int)y, (int)width, (int)height};
    return SDL_UpdateTexture(context, &to, pixels, (int)width * 3);
}

int main(int argc, char *argv[])
{
    const uint32_t frames = argc > 1 ? (uint32_t)atoi(argv[1]) : UINT32_MAX;
    static uint16_t pixels[WIDTH * BAND * 3 / 2]; /* ph_show takes an even address */
    struct ph_renderer r;
    if (SDL_Init(SDL_INIT_VIDEO) != 0 || triangle_init(&r, PH_PIXELS_RGB888) != 0) {
        return 1;
    }
    r.config.pixels = pixels;
    SDL_Window *window = SDL_CreateWindow("Pinhole", 0, 0, WIDTH, HEIGHT, 0);
    SDL_Renderer *renderer = SDL_CreateRenderer(window, -1, SDL_RENDERER_SOFTWARE);
    SDL_Texture *texture =
        SDL_CreateTexture(renderer, SDL_PIXELFORMAT_RGB24, SDL_TEXTUREACCESS_STREAMING, WIDTH, HEIGHT);
    SDL_Event event = {0};
    int status = texture != NULL ? 0 : 1;
    for (uint32_t frame = 0; status == 0 && frame < frames && event.type != SDL_QUIT; frame++) {
        status = triangle_draw(&r, frame);
        status = status != 0 ? status : ph_show(&r, flush, texture);
        SDL_RenderCopy(renderer, texture, NULL, NULL);
        SDL_RenderPresent(renderer);
        SDL_PollEvent(&event);
    }
    if (status == 0 && argc > 2) { /* a second argument: the last frame as BMP */
        SDL_Surface *shot = SDL_CreateRGBSurfaceWithFormat(0, WIDTH, HEIGHT, 24, SDL_PIXELFORMAT_RGB24);
        status = SDL_RenderReadPixels(renderer, NULL, SDL_PIXELFORMAT_RGB24, shot->pixels, shot->pitch) != 0 ||
                 SDL_SaveBMP(shot, argv[2]) != 0;
    }
    SDL_Quit();
    return status != 0;
}
