/* See self_test.h. */
#include "self_test.h"

#include "version.h"

#define RATE_US     1000000U /* turntable: so long, or */
#define RATE_FRAMES 16U      /* so many frames */

/* Frame 0 of the demos of known_demos. tests/host-sim/test_self_test.sh compares with pinhole-sim. */
static const char *const known_demos[] = {"cube", "testcard"};
#define DEMOS (sizeof known_demos / sizeof known_demos[0])

static const struct known {
    uint16_t width, height;
    uint32_t crc[DEMOS];
} known_frames[] = {
    {64, 128, {0xB4ED8AD9, 0x7AF73D8D}},  {80, 160, {0xB8577310, 0xAA362D6D}},  {128, 64, {0x8AEB56A3, 0x84857ED7}},
    {128, 128, {0xE6A27136, 0x50FC6910}}, {128, 160, {0x0BA63CB1, 0x1783D627}}, {135, 240, {0x3EE659E5, 0xD741FEFC}},
    {160, 80, {0xA021936B, 0x311DC16C}},  {160, 128, {0xCEE7198D, 0xABE9AAF2}}, {170, 320, {0x291EAA5E, 0x0579DB01}},
    {240, 135, {0xE7B4F73C, 0x99FF17F2}}, {240, 240, {0xB050793F, 0x286B7E67}}, {240, 280, {0x412CBA78, 0x364D03D3}},
    {240, 320, {0x9587B3C7, 0x4D81C648}}, {280, 240, {0x25DEF850, 0xDFC94F41}}, {320, 170, {0xC3AC957E, 0xC0243EE8}},
    {320, 240, {0xBA5B3AFC, 0x1E0BC436}}, {320, 480, {0x1FEFDBB4, 0x7D6870C3}}, {480, 320, {0x586FC948, 0x0CD1DCA1}},
};

/* ---- text --------------------------------------------------------------------------------------- */

/* The number with `digits` digits at least. */
static void put_number(self_test_put *put, uint32_t value, bool hex, uint32_t digits)
{
    const uint32_t base = hex ? 16 : 10;
    char text[11];
    uint32_t i = sizeof text - 1;
    text[i] = '\0';
    while (value > 0 || sizeof text - 1 - i < digits) {
        text[--i] = "0123456789ABCDEF"[value % base];
        value /= base;
    }
    put(text + i);
}

static void put_named(self_test_put *put, const char *name, uint32_t value)
{
    put(name);
    put_number(put, value, false, 1);
}

static void put_size(self_test_put *put, const struct runner *runner)
{
    put_named(put, " ", runner->context.width);
    put_named(put, "x", runner->context.height);
}

static void put_head(self_test_put *put, const struct runner *runner, const char *machine)
{
    const struct board *board = runner->config.board;
    put("---- Pinhole report: copy from here ----");
    put("\n");
    put("Pinhole " PH_VERSION " on ");
    put(board->name);
    put(": ");
    put(board->title);
    put(", ");
    put(machine);
    put("\n");
    put("display ");
    put(board->panel->name);
    put(",");
    put_size(put, runner);
    put_named(put, ", turned ", runner->config.rotation * 90U);
    put_named(put, ", bus ", (uint32_t)runner->driver.clock_hz);
    put(" Hz");
    put("\n");
}

static void put_tail(self_test_put *put, int result)
{
    put(result == 0 ? "self-test: passed" : result > 0 ? "self-test: FAILED" : "self-test: did not end, error ");
    if (result < 0) {
        put_number(put, (uint32_t)-result, false, 1);
    }
    put("\n");
    put("what the glass shows (yes or no): ring round ...  arrow up ...  first bar red ...  a dot in each corner ...");
    put("\n");
    put("---- Pinhole report: to here ----");
    put("\n");
}

/* ---- frames ------------------------------------------------------------------------------------- */

static int show(struct runner *runner, uint32_t frame)
{
    const int status = runner_scene(runner, frame);
    return status == PH_OK ? runner_send(runner) : status;
}

static int measure_rate(self_test_put *put, struct runner *runner)
{
    const struct hal *hal = &runner->hal;
    int status = runner_take(runner, demo_find("turntable"));
    status = status == PH_OK ? show(runner, 0) : status; /* the panel lights up */
    status = status == PH_OK ? runner_finish(runner) : status;
    const uint32_t from = hal->ops->time_us(hal->context);
    uint32_t frames = 0, us = 0;
    while (status == PH_OK && frames < RATE_FRAMES && us < RATE_US) {
        status = show(runner, ++frames);
        us = hal->ops->time_us(hal->context) - from;
    }
    status = status == PH_OK ? runner_finish(runner) : status;
    us = hal->ops->time_us(hal->context) - from;
    put_named(put, "turntable: ", frames);
    put_named(put, " frames in ", us / 1000);
    put_named(put, " ms, ", us > 0 ? (uint32_t)(frames * 10000000ULL / us) / 10 : 0);
    put_named(put, ".", us > 0 ? (uint32_t)(frames * 10000000ULL / us) % 10 : 0);
    put_named(put, " frames/s, left out ", runner->renderer.stats.triangles_dropped);
    put_named(put, " triangles ", runner->renderer.stats.vertices_dropped);
    put(" vertices");
    put("\n");
    return status;
}

/* Returns NULL if there is none for this size. */
static const struct known *find_known(uint32_t width, uint32_t height)
{
    for (size_t i = 0; i < sizeof known_frames / sizeof known_frames[0]; i++) {
        if (known_frames[i].width == width && known_frames[i].height == height) {
            return &known_frames[i];
        }
    }
    return NULL;
}

/* 1: it is not the known CRC; 0: it is, or none is known; or an error. */
static int compare(self_test_put *put, struct runner *runner, uint32_t demo)
{
    int status = runner_take(runner, demo_find(known_demos[demo]));
    status = status == PH_OK ? runner_scene(runner, 0) : status;
    if (status != PH_OK) {
        return status;
    }
    const uint32_t crc = runner_crc(runner);
    const struct known *known = find_known(runner->context.width, runner->context.height);
    const bool same = known == NULL || known->crc[demo] == crc;
    put(known_demos[demo]);
    put_size(put, runner);
    put(" crc32 ");
    put_number(put, crc, true, 8);
    put(known == NULL ? ", none is known for this size" : same ? ", as known" : ", but known is ");
    if (!same) {
        put_number(put, known->crc[demo], true, 8);
    }
    put("\n");
    return same ? 0 : 1;
}

int self_test_report(struct runner *runner, const char *machine, self_test_put *put)
{
    int bad = 0, status = 0;
    put_head(put, runner, machine);
    status = measure_rate(put, runner);
    for (uint32_t i = 0; i < DEMOS && status >= 0; i++) {
        status = compare(put, runner, i);
        bad += status > 0;
    }
    status = status >= 0 ? show(runner, 0) : status;
    status = status == 0 ? runner_finish(runner) : status;
    put_tail(put, status < 0 ? status : bad);
    return status < 0 ? status : bad;
}
