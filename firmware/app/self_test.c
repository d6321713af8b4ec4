/* See self_test.h. */
#include "self_test.h"

#include "status.h"

#define RATE_US     1000000U /* turntable: so long, or */
#define RATE_FRAMES 16U      /* so many frames */
#define EDGES       8U       /* of TE are timed, */
#define EDGE_US     50000U   /* each of which comes within this time */
#define ID_BYTES    5U       /* of an answer: a dummy bit or byte, and three or four bytes */

#ifdef __clang__
#define COMPILER __VERSION__ /* it names itself */
#else
#define COMPILER "gcc " __VERSION__
#endif

/* Frame 0 of the demos of known_demos. tests/host-sim/test_known_crcs.sh compares with pinhole-sim. */
static const char *const known_demos[] = {"cube", "testcard"};
#define DEMOS (sizeof known_demos / sizeof known_demos[0])

static const struct known {
    uint16_t width, height;
    uint32_t crc[DEMOS];
} known_frames[] = {
    {72, 40, {0xD96A9C83, 0xD5377D00}},   {128, 32, {0xB718EE5E, 0x33023C3D}},  {172, 320, {0x3624B028, 0xFF9AFF27}},
    {320, 172, {0xF77932A8, 0xE8912FE1}}, {64, 128, {0xB4ED8AD9, 0x7AF73D8D}},  {80, 160, {0xB8577310, 0xAA362D6D}},
    {128, 64, {0x8AEB56A3, 0x84857ED7}},  {128, 128, {0xE6A27136, 0x50FC6910}}, {128, 160, {0x0BA63CB1, 0x1783D627}},
    {135, 240, {0x3EE659E5, 0xD741FEFC}}, {160, 80, {0xA021936B, 0x311DC16C}},  {160, 128, {0xCEE7198D, 0xABE9AAF2}},
    {170, 320, {0x291EAA5E, 0x0579DB01}}, {240, 135, {0xE7B4F73C, 0x99FF17F2}}, {240, 240, {0xB050793F, 0x286B7E67}},
    {240, 280, {0x412CBA78, 0x364D03D3}}, {240, 320, {0x9587B3C7, 0x4D81C648}}, {280, 240, {0x25DEF850, 0xDFC94F41}},
    {320, 170, {0xC3AC957E, 0xC0243EE8}}, {320, 240, {0xBA5B3AFC, 0x1E0BC436}}, {320, 480, {0x1FEFDBB4, 0x7D6870C3}},
    {400, 240, {0x7E6A2BE2, 0x9D86F2F2}}, {480, 320, {0x586FC948, 0x0CD1DCA1}},
};

/* ---- text --------------------------------------------------------------------------------------- */

void self_test_number(self_test_put *put, uint32_t value, bool hex, uint32_t digits)
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
    self_test_number(put, value, false, 1);
}

static void put_size(self_test_put *put, const struct runner *runner)
{
    put_named(put, " ", runner->context.width);
    put_named(put, "x", runner->context.height);
}

static void put_line(self_test_put *put, const char *name, const char *text)
{
    put(name);
    put(text);
    put("\n");
}

static void put_head(self_test_put *put, const struct runner *runner, const struct self_test_machine *machine)
{
    put_line(put, "---- Pinhole report: copy from here ----", "");
    put_line(put, "Pinhole " PH_VERSION ", ", machine->build);
    put_line(put, "compiler ", COMPILER);
    put_line(put, "kit ", runner->config.board->title);
}

static void put_tail(self_test_put *put, const struct self_test_machine *machine, int result)
{
    put(result == 0 ? "self-test: passed" : result > 0 ? "self-test: FAILED" : "self-test: did not end, error ");
    if (result < 0) {
        self_test_number(put, (uint32_t)-result, false, 1);
    }
    put("\n");
    if (result < 0 && machine->why != NULL) {
        put_line(put, "error: ", machine->why(machine->context));
    }
    put_line(put, "what the glass shows (yes or no): line on all four edges ...  ring round ...", "");
    put_line(put, "    arrow up ...  bars red, green, blue, white, grey ...  dots 1 2 3 4 ...", "");
    put_line(put, "---- Pinhole report: to here ----", "");
}

/* ---- the panel's own lines ---------------------------------------------------------------------- */

static void put_display(self_test_put *put, const struct runner *runner)
{
    put("display ");
    put(runner->config.board->panel->name);
    put(",");
    put_size(put, runner);
    put_named(put, ", turned ", runner->config.rotation * 90U);
    put_named(put, ", bus ", (uint32_t)runner->driver.clock_hz);
    put(" Hz");
    put("\n");
}

/* RDDID, 04h of controllers with DCS commands, read at the speed of the initialisation. */
static void put_id(self_test_put *put, struct runner *runner)
{
    const struct hal *hal = &runner->hal;
    const struct board *board = runner->config.board;
    uint8_t bytes[ID_BYTES] = {0};
    if (!board->pins.data_in.wired || hal->ops->bus_read == NULL) {
        put_line(put, "display id: ", board->pins.data_in.wired ? "this port cannot read it" : "MISO is not wired");
        return;
    }
    int status = hal->ops->bus_clock(hal->context, board->panel->controller->init_hz);
    status = status < 0 ? status : hal->ops->bus_read(hal->context, 0x04, bytes, sizeof bytes);
    const int restored = panel_clock(&runner->driver, runner->driver.config.clock_hz);
    put(status < 0 || restored < 0 ? "display id: cannot be read, error " : "display id: 04h gives");
    if (status < 0 || restored < 0) {
        self_test_number(put, (uint32_t) - (status < 0 ? status : restored), false, 1);
    }
    for (uint32_t i = 0; i < sizeof bytes && status >= 0 && restored >= 0; i++) {
        put(" ");
        self_test_number(put, bytes[i], true, 2);
    }
    put("\n");
}

static void put_edges(self_test_put *put, const struct runner *runner)
{
    const struct hal *hal = &runner->hal;
    const bool wired = runner->config.board->pins.tearing.wired && hal->ops->te_wait != NULL;
    int status = wired ? hal->ops->te_wait(hal->context, EDGE_US) : HAL_ENOSYS;
    const uint32_t from = hal->ops->time_us(hal->context);
    uint32_t edges = 0;
    while (status == HAL_OK && edges < EDGES) {
        status = hal->ops->te_wait(hal->context, EDGE_US);
        edges += status == HAL_OK;
    }
    const uint32_t us = hal->ops->time_us(hal->context) - from;
    if (status == HAL_OK && us > 0) {
        put_named(put, "TE: ", edges * 10000000U / us / 10);
        put_named(put, ".", edges * 10000000U / us % 10);
        put_named(put, " edges/s, missed before ", runner->edges_missed);
        put("\n");
    } else {
        put_line(put, "TE: ", !wired ? "not wired" : edges > 0 ? "edges come, but not always" : "no edge in 50 ms");
    }
}

/* ---- frames ------------------------------------------------------------------------------------- */

static int show(struct runner *runner, uint32_t frame)
{
    const int status = runner_scene(runner, frame);
    return status == PH_OK ? runner_send(runner) : status;
}

static int measure_rate(self_test_put *put, struct runner *runner, uint32_t sent)
{
    const struct hal *hal = &runner->hal;
    int status = show(runner, 0); /* the panel lights up */
    status = status == PH_OK ? runner_finish(runner) : status;
    const uint32_t from = hal->ops->time_us(hal->context);
    uint32_t frames = 0, us = 0;
    while (status == PH_OK && frames < RATE_FRAMES && us < RATE_US) {
        status = show(runner, ++frames);
        us = hal->ops->time_us(hal->context) - from;
    }
    status = status == PH_OK ? runner_finish(runner) : status;
    us = hal->ops->time_us(hal->context) - from;
    put(runner->config.other_core != NULL ? "turntable, 2 cores: " : "turntable, 1 core: ");
    self_test_number(put, frames, false, 1);
    put_named(put, " frames in ", us / 1000);
    put_named(put, " ms, ", us > 0 ? (uint32_t)(frames * 10000000ULL / us) / 10 : 0);
    put_named(put, ".", us > 0 ? (uint32_t)(frames * 10000000ULL / us) % 10 : 0);
    put(" frames/s");
    put("\n");
    put_named(put, "left out: ", runner->renderer.stats.triangles_dropped);
    put_named(put, " triangles ", runner->renderer.stats.vertices_dropped);
    put_named(put, " vertices; sent before the report: ", sent);
    put(" frames");
    put("\n");
    return status;
}

/* Sends what is in a band's memory for each band of a whole frame: the time of the bus alone, without drawing. */
static int measure_bus(self_test_put *put, struct runner *runner)
{
    const struct hal *hal = &runner->hal;
    const struct board *board = runner->config.board;
    const struct panel_sender *sender = &runner->config.sender;
    const uint32_t height = runner->driver.height,
                   lines = runner->renderer.config.band_height >> runner->renderer.samples_log2,
                   from = hal->ops->time_us(hal->context);
    if (!board->pins.dc.wired && board->i2c_address == 0) { /* a display of the kernel, which has no bus of ours */
        return HAL_OK;
    }
    if (sender->ops->forget != NULL) {
        sender->ops->forget(sender->context);
    }
    int status = sender->ops->begin(sender->context, &runner->driver);
    for (uint32_t y = 0; y < height && status == HAL_OK; y += lines) {
        const uint32_t rows = height - y < lines ? height - y : lines;
        status = sender->ops->rows(sender->context, &runner->driver, runner->bands[0], rows);
    }
    status = status == HAL_OK ? sender->ops->end(sender->context, &runner->driver) : status;
    put_named(put, "whole frame: ", hal->ops->time_us(hal->context) - from);
    put_named(put, " us on the bus, ",
              panel_frame_us(board->panel, board->format, runner->config.rotation, (uint32_t)runner->driver.clock_hz));
    put(" by its clock and bits");
    put("\n");
    return status;
}

/* Finds the known CRCs for pictures of this size. NULL: there are none. */
static const struct known *find_known(uint32_t width, uint32_t height)
{
    for (size_t i = 0; i < sizeof known_frames / sizeof known_frames[0]; i++) {
        if (known_frames[i].width == width && known_frames[i].height == height) {
            return &known_frames[i];
        }
    }
    return NULL;
}

/* Compares a picture with its known CRC. 1: it is another; 0: it is the same, or none is known; or an error. */
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
    self_test_number(put, crc, true, 8);
    put(known == NULL ? ", none is known for this size" : same ? ", as known" : ", but known is ");
    if (!same) {
        self_test_number(put, known->crc[demo], true, 8);
    }
    put("\n");
    return same ? 0 : 1;
}

int self_test_report(struct runner *runner, const struct self_test_machine *machine, self_test_put *put)
{
    int bad = 0, status = runner_take(runner, demo_find("turntable")); /* nothing is on the bus, no core works ahead */
    put_head(put, runner, machine);
    machine->facts(machine->context, put);
    put_display(put, runner);
    put_id(put, runner);
    status = status == PH_OK ? measure_rate(put, runner, machine->frames) : status;
    put_edges(put, runner); /* the panel is lit */
    status = status >= 0 ? measure_bus(put, runner) : status;
    for (uint32_t i = 0; i < DEMOS && status >= 0; i++) {
        status = compare(put, runner, i);
        bad += status > 0;
    }
    status = status >= 0 ? show(runner, 0) : status;
    status = status == 0 ? runner_finish(runner) : status;
    put_tail(put, machine, status < 0 ? status : bad);
    return status < 0 ? status : bad;
}
