/* See depth_options.h. One table has every option, its reader and its help. */
#include "depth_options.h"

#include "complain.h"
#include "depth_ieee.h"
#include "model.h"
#include "option_table.h"
#include "option_text.h"

#include <string.h>

static bool set_fx(fx_t *out, const char *value)
{
    const char *rest;
    return option_text_fx(value, out, &rest) && *rest == '\0';
}

static bool set_near(void *to, const char *value)
{
    struct depth_lab *lab = to;
    lab->near_set = true;
    for (lab->near_count = 0; lab->near_count < DEPTH_NEAR_MAX; value++) {
        fx_t *const near_z = &lab->nears[lab->near_count++];
        if (!option_text_fx(value, near_z, &value) || *near_z <= 0) {
            return false;
        }
        lab->near_z = lab->nears[0];
        if (*value != ',') {
            return *value == '\0';
        }
    }
    return false;
}

static bool set_far(void *to, const char *value)
{
    struct depth_lab *lab = to;
    return (lab->far_set = set_fx(&lab->far_z, value)) && lab->far_z > 0;
}

/* Adds the rows called name[0 .. length - 1]. */
static bool add_format(struct depth_lab *lab, const char *name, size_t length)
{
    const bool all = length == 3 && memcmp(name, "all", 3) == 0;
    bool found = all;
    for (uint32_t i = 0; i < lab_format_count; i++) {
        const bool every = all && (lab_formats[i].exponent == 0 || lab_formats[i].kind != LAB_DRAWN);
        if (every || (strlen(lab_formats[i].name) == length && memcmp(lab_formats[i].name, name, length) == 0)) {
            lab->formats |= (uint32_t)1 << i;
            found = true;
        }
    }
    for (uint32_t i = 0; i < DEPTH_IEEE_FORMATS; i++) {
        const char *mine = depth_ieee_name(i);
        if (all || (strlen(mine) == length && memcmp(mine, name, length) == 0)) {
            lab->host_formats |= (uint32_t)1 << i;
            found = true;
        }
    }
    return found;
}

static bool set_format(void *to, const char *value)
{
    struct depth_lab *lab = to;
    lab->formats = lab->host_formats = 0;
    lab->format_set = true;
    for (;;) {
        const size_t length = strcspn(value, ",");
        if (!add_format(lab, value, length)) {
            return false;
        }
        if (value[length] == '\0') {
            return true;
        }
        value += length + 1;
    }
}

static bool set_fov(void *to, const char *value)
{
    struct depth_lab *lab = to;
    lab->fov_set = true;
    return set_fx(&lab->fov_deg, value) && lab->fov_deg >= FX_ONE && lab->fov_deg <= FX_INT(170);
}

static bool set_size(void *to, const char *value)
{
    struct depth_lab *lab = to;
    return option_text_size(value, 1024, &lab->width, &lab->height);
}

static bool set_spacing(void *to, const char *value)
{
    struct depth_lab *lab = to;
    static const char *const names[] = {[LAB_LINEAR_SPACED] = "linear", [LAB_LOG_SPACED] = "log"};
    const int spacing = option_text_choice(value, names, 2);
    lab->spacing = (uint8_t)(spacing & 1);
    return spacing >= 0;
}

static bool set_at(void *to, const char *value)
{
    struct depth_lab *lab = to;
    for (lab->at_count = 0; lab->at_count < DEPTH_AT_MAX; value++) {
        fx_t *z = &lab->at[lab->at_count++];
        if (!option_text_fx(value, z, &value) || *z <= 0) {
            return false;
        }
        if (*value != ',') {
            return *value == '\0';
        }
    }
    return false;
}

static bool set_separation(void *to, const char *value)
{
    struct depth_lab *lab = to;
    return set_fx(&lab->separation, value) && lab->separation > 0;
}

static bool set_separate(void *to, const char *value)
{
    struct depth_lab *lab = to;
    return set_fx(&lab->separate, value) && lab->separate > 0;
}

static bool set_tilt(void *to, const char *value)
{
    struct depth_lab *lab = to;
    lab->tilt_set = true;
    return set_fx(&lab->tilt_deg, value) && lab->tilt_deg >= FX_INT(-89) && lab->tilt_deg <= FX_INT(89);
}

static bool set_camera(void *to, const char *value)
{
    struct depth_lab *lab = to;
    return option_camera_read(value, &lab->camera);
}

static bool set_azimuth(void *to, const char *value)
{
    struct depth_lab *lab = to;
    return set_fx(&lab->azimuth_deg, value) && lab->azimuth_deg >= FX_INT(-360) && lab->azimuth_deg <= FX_INT(360);
}

static bool set_shading(void *to, const char *value)
{
    struct depth_lab *lab = to;
    const int shading = option_text_choice(value, depth_shading_names, DEPTH_SHADINGS);
    lab->shading = (uint8_t)(shading < 0 ? 0 : shading);
    return shading >= 0;
}

static bool set_bits(void *to, const char *value)
{
    struct depth_lab *lab = to;
    return option_text_u32(value, 1, 24, &lab->bits) && (lab->bits == 16 || lab->bits == 24);
}

#define STEP_TEXT "a number of at least one step of Q16.16, 1/65536 = 0.000016, and at most 32767.99"

static const struct option_row rows[] = {
    {"near", "N[,N...]", "distance of the near plane; 0.5 by default; plot draws a curve for each of up to four",
     STEP_TEXT, .set = set_near},
    {"far", "F", "distance of the far plane; 100 by default", "a number, more than near, at most 32767.99",
     .set = set_far},
    {"depth", "NAME[,NAME...]|all",
     "formats, listed below; all by default, but for floats with -eN bits of exponent behind the name",
     "names that --help lists, or all", .set = set_format, .alias = OPTION_DEPTH_ALIAS},
    {"fov", "DEG",
     "vertical field of view; 60 by default. It does not matter for planes that face the camera, as pairs, resolve,\n"
     "        monotone and advise measure them",
     "degrees, 1 .. 170", .set = set_fov},
    {"size", "WxH", "size of the picture; 240x240 by default; it matters as little for them",
     "like 320x240, each 1 .. 1024", .set = set_size},
    {"csv", "FILE|-", "writes CSV to FILE, or stdout, instead of a table for people", "a file, or -",
     .at = offsetof(struct depth_lab, csv)},
    {"json", "FILE|-", "writes an array of JSON with an object a row; its keys are the columns of --csv",
     "a file, or -", .at = offsetof(struct depth_lab, json)},
    {"count", "N", "number of adjacent pairs; 10000 by default", "a whole number, 1 .. 1000000",
     .at = offsetof(struct depth_lab, count), .least = 1, .most = LAB_COUNT_MAX},
    {"spacing", "linear|log", "how the distances are spread from near to far; linear by default", "linear or log",
     .set = set_spacing},
    {"at", "Z[,Z...]", "distances; by default a few in each decade from near to far",
     "at most 512 numbers, each from near to far", .set = set_at},
    {"separation", "S", "distance between the two planes; by default half of what the coarsest format needs", STEP_TEXT,
     .set = set_separation},
    {"tilt", "DEG", "angle between the planes and the screen; 60 by default for advise", "degrees, -89 .. 89",
     .set = set_tilt},
    {"azimuth", "DEG", "direction in which the planes lean: 0, the default, away at the top, 90 at the right",
     "degrees, -360 .. 360", .set = set_azimuth},
    {"shading", "NAME", "how the planes are drawn; unlit by default", "unlit, flat, gouraud, texture or texture-lit",
     .set = set_shading},
    {"separate", "S", "separation that must be ordered right", STEP_TEXT, .set = set_separate},
    {"bits", "B", "bits of the depth buffer; both by default", "16 or 24", .set = set_bits},
    {"demo", "NAME",
     "a built-in scene in place of planes; with its own lens unless --camera, --fov, --near or --far is given",
     "a name that pinhole-sim --list shows", .at = offsetof(struct depth_lab, demo)},
    {"view", "NAME", "one of the demo's views; the first by default", "a name that pinhole-sim --list shows",
     .at = offsetof(struct depth_lab, view)},
    {"model", "FILE", "a model file on the turntable in place of planes", "an OBJ, STL, PLY, glTF or GLB file",
     .at = offsetof(struct depth_lab, model)},
    MODEL_OPTION_OUTSIDE(struct depth_lab, allow_outside),
    {"camera", OPTION_CAMERA_FORMS, OPTION_CAMERA_TELLS ". Without it the demo has its own view", OPTION_CAMERA_VALUES,
     .set = set_camera},
    {"start", "N", "number of the first frame of the scene; 0 by default", "a whole number, 0 .. 1000000000",
     .at = offsetof(struct depth_lab, start), .least = 0, .most = 1000000000},
    {"frames", "N", "frames of the scene; 1 by default", "a whole number, 1 .. 1000000",
     .at = offsetof(struct depth_lab, frames), .least = 1, .most = 1000000},
    {"out", "FILE|DIR", "where to write", "a file or directory", .at = offsetof(struct depth_lab, out)},
};

static const struct option_table options = {rows, sizeof rows / sizeof rows[0]};

static const struct depth_command *find_command(const struct depth_command *table, uint32_t count, const char *name)
{
    for (uint32_t i = 0; i < count; i++) {
        if (strcmp(table[i].name, name) == 0) {
            return &table[i];
        }
    }
    return NULL;
}

static bool takes(const struct depth_command *command, const char *name)
{
    const size_t length = strlen(name);
    for (const char *at = strstr(command->options, name); at != NULL; at = strstr(at + 1, name)) {
        if (at > command->options && at[-1] == ' ' && at[length] == ' ') {
            return true;
        }
    }
    return false;
}

void depth_options_help(const struct depth_command *table, uint32_t count)
{
    puts("pinhole-depth COMMAND [options]: measures what depth resolves, on the renderer's own code.\n");
    for (uint32_t i = 0; i < count; i++) {
        printf("  %-9s %s\n            options:", table[i].name, table[i].summary);
        for (size_t k = 0; k < options.count; k++) {
            if (takes(&table[i], rows[k].name)) {
                printf(" --%s", rows[k].name);
            }
        }
        puts("");
    }
    puts("");
    option_table_help(&options);
    printf("  --help\n        prints this, as does -h\n\nformats:");
    for (uint32_t i = 0; i < lab_format_count; i++) {
        if (i == 0 || strcmp(lab_formats[i].name, lab_formats[i - 1].name) != 0) {
            printf(" %s", lab_formats[i].name);
        }
    }
    printf("\nfloat32 formats (pairs only):");
    for (uint32_t i = 0; i < DEPTH_IEEE_FORMATS; i++) {
        printf(" %s", depth_ieee_name(i));
    }
    puts("\n\nExit status: 0 done; 1 failed; 2 wrong usage.");
}

static int check_together(const struct depth_lab *lab, const struct depth_command *command)
{
    char text[FX_TEXT_SIZE];
    for (uint32_t i = 1; i < lab->near_count; i++) {
        if (lab->nears[i] >= lab->far_z) {
            return complain_usage("--near must be less than --far");
        }
    }
    if (lab->near_count > 1 && command->run != depth_plot) {
        return complain_usage("--near: %s takes one near plane; plot takes several", command->name);
    }
    if (lab->near_z >= lab->far_z) {
        return complain_usage("--near must be less than --far");
    }
    for (uint32_t i = 0; i < lab->at_count; i++) {
        if (lab->at[i] < lab->near_z || lab->at[i] > lab->far_z) {
            fx_to_text(lab->at[i], text);
            return complain_usage("--at %s: must lie from --near to --far", text);
        }
    }
    if (lab->demo != NULL && lab->model != NULL) {
        return complain_usage("--demo and --model exclude each other");
    }
    const bool scene = lab->demo != NULL || lab->model != NULL;
    if (!scene && (lab->view != NULL || lab->camera.set || lab->start != 0 || lab->frames != 1)) {
        return complain_usage("--view, --camera, --start, --frames: belong to a scene; give --demo or --model");
    }
    if (lab->model == NULL && lab->allow_outside) {
        return complain_usage("--allow-outside: of which model? give --model FILE");
    }
    if (scene && (lab->at_count > 0 || lab->separate != 0 || lab->tilt_set)) {
        return complain_usage("--at, --separate, --tilt: belong to planes; a scene has its own distances and slopes");
    }
    const uint32_t every = ((uint32_t)1 << DEPTH_IEEE_FORMATS) - 1;
    if (lab->host_formats != 0 && (lab->host_formats != every || lab->formats == 0) && command->run != depth_pairs) {
        return complain_usage("--depth: %s measures no float32 format; pairs does", command->name);
    }
    struct ph_projection projection;
    if (depth_lab_projection(lab, &projection) != 0) {
        return complain_usage("--fov, --size: no camera can have both; make the picture less wide or high");
    }
    if (strstr(command->options, " kind ") != NULL && lab->kind == NULL) {
        return complain_usage("%s needs a %s; see --help", command->name,
                              command->run == depth_compare ? "FILE" : "KIND");
    }
    return 0;
}

static bool asks_for_help(int argc, char *const argv[])
{
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            return true;
        }
    }
    return false;
}

int depth_options_read(struct depth_lab *lab, const struct depth_command **command, const struct depth_command *table,
                       uint32_t count, int argc, char *const argv[])
{
    *lab = (struct depth_lab){.near_z = FX_HALF,
                              .far_z = FX_INT(100),
                              .fov_deg = FX_INT(60),
                              .width = 240,
                              .height = 240,
                              .count = 10000,
                              .frames = 1};
    *command = NULL;
    add_format(lab, "all", 3);
    if (asks_for_help(argc, argv)) {
        return 0;
    }
    if (argc < 2) {
        return complain_usage("which command? --help lists them");
    }
    *command = find_command(table, count, argv[1]);
    if (*command == NULL) {
        return complain_usage("%s: no such command; --help lists them", argv[1]);
    }
    int i = 2;
    if (i < argc && (argv[i][0] != '-' || argv[i][1] == '\0') && strstr((*command)->options, " kind ") != NULL) {
        lab->kind = argv[i++];
    }
    while (i < argc) {
        const struct option_row *row = option_table_find(&options, argv[i]);
        if (row != NULL && !takes(*command, row->name)) {
            return complain_usage("--%s: %s does not take it; --help lists what it takes", row->name, (*command)->name);
        }
        i = option_table_read(&options, lab, argc, argv, i);
        if (i < 0) {
            return i;
        }
    }
    return check_together(lab, *command);
}
