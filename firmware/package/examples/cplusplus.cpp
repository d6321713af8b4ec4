// C++11: the triangle of triangle.h, drawn by a class.
#include "triangle.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

class Picture
{
  public:
    Picture() : status_(triangle_init(&renderer_, PH_PIXELS_RGB888)), rgb_(WIDTH * HEIGHT * 3)
    {
        renderer_.config.pixels = pixels_; // three bytes a pixel need more room
    }

    int draw(uint32_t frame)
    {
        int status = status_ != 0 ? status_ : triangle_draw(&renderer_, frame);
        return status != 0 ? status : ph_show(&renderer_, flush, this);
    }

    bool save(std::FILE *file) const
    {
        std::fprintf(file, "P6\n%d %d\n255\n", int(WIDTH), int(HEIGHT));
        return std::fwrite(rgb_.data(), rgb_.size(), 1, file) == 1;
    }

  private:
    static int flush(void *context, uint32_t, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
    {
        const uint8_t *from = static_cast<const uint8_t *>(pixels);
        std::copy(from, from + width * height * 3, static_cast<Picture *>(context)->rgb_.begin() + y * WIDTH * 3);
        return 0;
    }

    ph_renderer renderer_;
    uint16_t pixels_[WIDTH * BAND * 3 / 2];
    int status_;
    std::vector<uint8_t> rgb_;
};

int main(int argc, char *argv[])
{
    static Picture picture;
    const int status = picture.draw(argc > 1 ? uint32_t(std::atoi(argv[1])) : 16);
    return status != 0 || !picture.save(stdout);
}
