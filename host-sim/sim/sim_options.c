/* See sim_options.h. One table has every option, its reader and its help. */
#include "sim_options.h"

#include "complain.h"
#include "frame_out.h"
#include "model.h"
#include "option_table.h"
#include "option_text.h"
#include "render.h"

#include <stdio.h>
#include <string.h>

#define FRAME_LIMIT 1000000000u
#define SIZE_LIMIT  1024 /* struct ph_config */
#define FOV_DEG     FX_INT(60)
#define FISHEYE_DEG FX_INT(180)

static bool set_size(void *to, const char *value)
{
    struct sim_options *o = to;
    return option_text_size(value, SIZE_LIMIT, &o->width, &o->height);
}

static bool set_rotate(void *to, const char *value)
{
    struct sim_options *o = to;
    o->rotate_set = true;
    return option_text_turns(value, &o->rotate);
}

static bool set_camera(void *to, const char *value)
{
    struct sim_options *o = to;
    return option_camera_read(value, &o->camera);
}

static bool set_view_matrix(void *to, const char *value)
{
    struct sim_options *o = to;
    o->view_matrix_set = true;
    return sim_matrix_read(value, &o->view_matrix);
}

static bool set_lens_matrix(void *to, const char *value)
{
    struct sim_options *o = to;
    o->lens_matrix_set = true;
    return sim_matrix_read(value, &o->lens_matrix);
}

static bool set_focal(void *to, const char *value)
{
    struct sim_options *o = to;
    o->projection_set = true;
    if (!option_text_fx(value, &o->focal, &value)) {
        return false;
    }
    if (*value == ',' && !option_text_fx(value + 1, &o->image_height, &value)) {
        return false;
    }
    return *value == '\0' && o->focal != 0 && o->focal != FX_MIN && o->image_height > 0;
}

static bool set_point(void *to, const char *value)
{
    struct sim_options *o = to;
    fx_t v[3];
    o->point_set = option_text_fx_list(value, v, 3, &value) && *value == '\0';
    o->point = o->point_set ? (struct fx_vec3){v[0], v[1], v[2]} : o->point;
    return o->point_set;
}

static bool set_frustum(void *to, const char *value)
{
    struct sim_options *o = to;
    if (!option_text_fx(value, &o->frustum_z, &value) || o->frustum_z <= 0) {
        return false;
    }
    if (*value == ',' && (!option_text_fx(value + 1, &o->frustum_height, &value) || o->frustum_height <= 0)) {
        return false;
    }
    return *value == '\0';
}

static bool set_focus(void *to, const char *value)
{
    struct sim_options *o = to;
    if (!option_text_fx(value, &o->focus, &value) || o->focus <= 0) {
        return false;
    }
    if (*value == ',' && (!option_text_fx(value + 1, &o->focus_strength, &value) || o->focus_strength < 0)) {
        return false;
    }
    return *value == '\0' && o->focus_strength <= FX_INT(64);
}

static bool set_parent(void *to, const char *value)
{
    struct sim_options *o = to;
    o->parent_set = true;
    return option_text_u32(value, 0, UINT32_MAX, &o->parent);
}

static bool set_object(void *to, const char *value)
{
    static const char word[] = ",target=";
    struct sim_options *o = to;
    fx_t at[3], target[3];
    o->object_set = option_text_fx_list(value, at, 3, &value);
    if (!o->object_set) {
        return false;
    }
    o->object = ph_xform_translate(at[0], at[1], at[2]);
    if (strncmp(value, word, strlen(word)) == 0 && option_text_fx_list(value + strlen(word), target, 3, &value)) {
        o->object = ph_object_look_at(o->object.t, (struct fx_vec3){target[0], target[1], target[2]},
                                      (struct fx_vec3){0, FX_ONE, 0});
    }
    return *value == '\0';
}

static bool set_matrix(void *to, const char *value)
{
    struct sim_options *o = to;
    o->matrix = true;
    o->factors = value != NULL;
    return value == NULL || strcmp(value, "factors") == 0;
}

static bool set_flatten(void *to, const char *value)
{
    struct sim_options *o = to;
    o->flatten = value;
    return sim_matrix_flat(value, &o->flat);
}

static bool set_distance(struct sim_options *o, fx_t *out, const char *value)
{
    const char *rest;
    o->projection_set = true;
    return option_text_fx(value, out, &rest) && *rest == '\0';
}

static bool set_fov(void *to, const char *value)
{
    struct sim_options *o = to;
    return set_distance(o, &o->fov_deg, value) && o->fov_deg > 0 && o->fov_deg <= FX_INT(240);
}

static bool set_near(void *to, const char *value)
{
    struct sim_options *o = to;
    o->near_set = true;
    return set_distance(o, &o->near_z, value) && o->near_z != FX_MIN;
}

static bool set_far(void *to, const char *value)
{
    struct sim_options *o = to;
    o->far_set = true;
    return set_distance(o, &o->far_z, value) && o->far_z != FX_MIN;
}

static bool set_triangles(void *to, const char *value)
{
    struct sim_options *o = to;
    o->goal_set = true;
    return asset_triangles_named(value, &o->goal);
}

static bool set_projection(void *to, const char *value)
{
    struct sim_options *o = to;
    static const char *const names[] = {"perspective", "frustum", "ortho", "fisheye"};
    char kind[16] = "";
    const size_t n = strcspn(value, "=");
    o->projection_set = true;
    o->window_set = value[n] == '=';
    memcpy(kind, value, n < sizeof kind ? n : sizeof kind - 1);
    const int found = option_text_choice(kind, names, 4);
    if (found < 0 || (o->window_set && found != OPTION_FRUSTUM && found != OPTION_ORTHO)) {
        return false;
    }
    o->projection = (enum option_projection)found;
    return !o->window_set || (option_text_fx_list(value + n + 1, o->window, 4, &value) && *value == '\0');
}

static bool set_convention(void *to, const char *value)
{
    struct sim_options *o = to;
    static const char *const names[] = {[PH_GL] = "gl", [PH_D3D] = "d3d", [PH_LMU] = "lmu", [PH_REVERSED] = "reversed"};
    const int convention = option_text_choice(value, names, 4);
    o->convention = (uint8_t)(convention & 3);
    return convention >= 0;
}

static bool set_depth(void *to, const char *value)
{
    return option_text_depth(value, &((struct sim_options *)to)->depth);
}

static bool set_difference(void *to, const char *value)
{
    ((struct sim_options *)to)->difference = value;
    return option_text_ends(value, ".png") || option_text_ends(value, ".ppm");
}

static bool set_list(void *to, const char *value)
{
    struct sim_options *o = to;
    (void)value;
    o->action = OPTION_LIST;
    return true;
}

static bool set_help(void *to, const char *value)
{
    struct sim_options *o = to;
    (void)value;
    o->action = OPTION_HELP;
    return true;
}

static const struct option_row rows[] = {
    {"demo", "NAME", "a built-in scene; turntable without --demo and --model", "a name that --list shows",
     .at = offsetof(struct sim_options, demo)},
    {"view", "NAME", "one of the demo's views; the first by default", "a name that --list shows",
     .at = offsetof(struct sim_options, view)},
    {"model", "FILE", "a model file on the turntable", "an OBJ, STL, PLY, glTF or GLB file",
     .at = offsetof(struct sim_options, model)},
    MODEL_OPTION_ROWS(struct sim_options, model_options),
    {"clip", "NAME[,NAME]",
     "the animation of the model that plays first; its first by default. Of several, each plays once, and fades into "
     "the\n"
     "        next while it ends (--cross-fade); after the last the first comes again",
     "the name of an animation, or several", .at = offsetof(struct sim_options, clip)},
    {"clip-fps", "N",
     "frames in a second of the animation: frame number F shows it at F / N s; 30 by default, but a window that its\n"
     "        user closes shows it by the clock",
     "a whole number, 1 .. 1000", .at = offsetof(struct sim_options, clip_fps), .least = 1, .most = 1000},
    {"max-triangles", "N|all|fit",
     "simplifies the model to N triangles at most; fit: to what the memory of the --board has room for, as its image\n"
     "        is made. fit by default for a microcontroller kit, else all",
     "a whole number, 1 .. 4000000, all or fit", .set = set_triangles},
    {"board", "NAME", "a kit", "a name that --list shows", .at = offsetof(struct sim_options, board)},
    {"size", "WxH", "instead of a kit: a plain panel of this size", "like 320x240, each 1 .. 1024", .set = set_size},
    {"frames", "N", "frames to draw; 1 by default, with --window until it is closed", "a whole number, 1 .. 1000000000",
     .at = offsetof(struct sim_options, frames), .least = 1, .most = FRAME_LIMIT},
    {"start", "N", "number of the first frame; 0 by default", "a whole number, 0 .. 4294967295",
     .at = offsetof(struct sim_options, start), .least = 0, .most = UINT32_MAX},
    {"out", "DIR|FILE.png|FILE.gif|FILE.ppm|-",
     "DIR/frame-NNNN.ppm; FILE.png or .ppm (several frames: FILE-NNNN.png); all frames as a GIF; - streams PPM to\n"
     "        stdout",
     FRAME_OUT_TAKES, .at = offsetof(struct sim_options, out)},
    {"scale", "N", "makes every pixel of --out N x N pixels; --check takes references of both sizes",
     "a whole number, 1 .. 16", .at = offsetof(struct sim_options, scale), .least = 1, .most = FRAME_OUT_SCALE_MAX},
    {"check", "REF",
     "compares each frame with FILE.png or .ppm (several frames: FILE-NNNN.png), with a folder of such frames, or "
     "with\n"
     "        what --crc printed into a file; says what differs, draws it red into --difference, and exits 1",
     "a picture, a folder or a file of CRCs", .at = offsetof(struct sim_options, check)},
    {"tolerance", "N", "pixels may differ by so much in each channel; 0 by default", "a whole number, 0 .. 255",
     .at = offsetof(struct sim_options, tolerance), .least = 0, .most = 255},
    {"difference", "FILE.png", "where --check draws what differs; difference.png by default",
     "a file that ends in .png or .ppm", .set = set_difference},
    {"rotate", "0|90|180|270",
     "how far the picture is turned clockwise in the controller's memory; 0 is the controller's own top; the\n"
     "        board's own by default. The glass is shown with the picture upright, as you would hold it: 90 and 270\n"
     "        swap width and height; else only the bytes on the wire differ",
     "0, 90, 180 or 270 degrees", .set = set_rotate},
    {"camera", OPTION_CAMERA_FORMS,
     OPTION_CAMERA_TELLS ". Without this option the demo has its own\n"
                         "        view; it has its own lens if no option of the view or the lens is given",
     OPTION_CAMERA_VALUES, .set = set_camera},
    {"parent", "N",
     "makes the camera a child of mesh N of the frame, from 0 on in the order in which they are drawn: --camera or\n"
     "        --view-matrix is then in that mesh's coordinates, and the camera goes where it goes; a scale has no "
     "effect",
     "a whole number, 0 .. 4294967295", .set = set_parent},
    {"view-matrix", "M", "the view as a matrix, world to camera, as the --convention writes it and --matrix prints it",
     SIM_MATRIX_VALUES, .set = set_view_matrix},
    {"projection-matrix", "M", "the lens as a matrix, camera to clip coordinates, as the --convention writes it",
     SIM_MATRIX_VALUES, .set = set_lens_matrix},
    {"anyway", NULL,
     "draws a --view-matrix or --projection-matrix that is no camera, too, and says what is wrong with it; x and y "
     "are\n"
     "        the matrices' own, and what their depth puts outside of its range is not drawn",
     NULL, .at = offsetof(struct sim_options, anyway)},
    {"fov", "DEG", "vertical field of view; 60 by default, 180 with a fisheye",
     "degrees, more than 0 and less than 180; with a fisheye 10 .. 240", .set = set_fov},
    {"focal", "F[,H]",
     "a pinhole camera, with an image H high (2 by default) at the distance F; F below 0: the image behind the\n"
     "        hole, upside down, which needs --camera",
     "a number that is not 0 and, optionally, a comma and a number more than 0", .set = set_focal},
    {"near", "N",
     "distance of the near plane; 0.5 by default. --convention lmu writes both planes as coordinates, below 0",
     "a number, more than 0, or with --convention lmu its negative", .set = set_near},
    {"far", "N", "distance of the far plane; 100 by default",
     "a number, more than near, at most 32767.99, or with --convention lmu its negative", .set = set_far},
    {"projection", "perspective|ortho[=L,R,B,T]|frustum[=L,R,B,T]|fisheye",
     "L,R,B,T is the window at the near plane; a fisheye is equidistant; perspective by default",
     "perspective, ortho, ortho=L,R,B,T, frustum, frustum=L,R,B,T or fisheye", .set = set_projection},
    {"convention", "gl|d3d|lmu|reversed",
     "how the camera is written down; the picture is the same in all of them. gl by default: right-handed, along -z",
     "gl, d3d, lmu or reversed", .set = set_convention},
    {"depth", OPTION_DEPTH_CHOICES,
     "what the depth buffer holds; auto by default: fixed16 where far is at most 64 times near or the\n"
     "        projection is parallel, else float16. A float has N bits of exponent, by default those that the lens\n"
     "        needs (--stats names them). The 24-bit formats take twice the memory, linear-w a reciprocal per pixel",
     OPTION_DEPTH_VALUES, .set = set_depth, .alias = OPTION_DEPTH_ALIAS},
    {"show", "depth",
     "shows the depth buffer in place of the picture: grey is a code's share of the largest one, as --point prints "
     "it.\n"
     "        White is the near plane, black is where nothing is; --depth and the lens decide what lies between",
     "depth", .at = offsetof(struct sim_options, show), .words = "depth"},
    {"band", "LINES", "height of a band; the board's own by default", "a whole number of lines, 1 .. 1024",
     .at = offsetof(struct sim_options, band), .least = 1, .most = SIZE_LIMIT},
    {"aa", NULL, "antialiasing: 2 x 2 samples a pixel, in bands of a quarter of the height; at most 512x512 pixels",
     NULL, .at = offsetof(struct sim_options, antialias)},
    {"dither", NULL, "light without bands: Gouraud light is dithered, in depth of 16 bits but linear-w; not with --aa",
     NULL, .at = offsetof(struct sim_options, dither)},
    {"overlay", NULL, "writes the frame time of the bus and the triangles drawn over the picture", NULL,
     .at = offsetof(struct sim_options, overlay)},
    {"crc", NULL, "prints `frame N crc32 XXXXXXXX` of the visible pixels as RGB888 (on stderr with --out -)", NULL,
     .at = offsetof(struct sim_options, crc)},
    {"keys", "FILE",
     "presses buttons; a line is FRAME BUTTON[+BUTTON...] [COUNT], # comments; up down left right select;\n"
     "        left and right orbit (steer the snake), up comes nearer, down goes away, select takes the next clip of "
     "a\n"
     "        model, and then the next demo",
     "a file", .at = offsetof(struct sim_options, keys)},
    {"window", NULL,
     "shows the panel live, scaled up; arrows and Enter or space are its buttons, the mouse and\n"
     "        its wheel move the camera; P pauses, N takes the next frame, S saves the picture "
     "(pinhole-DEMO-FRAME.png),\n"
     "        F fills the screen, Esc ends",
     NULL, .at = offsetof(struct sim_options, show_window)},
    {"matrix", "[factors]",
     "prints the cameras of the first frame: `view`, `projection`, `viewport`, each with 4 rows of 4 exact decimals.\n"
     "        factors: and what they are products of, in lines as those of --point: view = R T, its inverse `camera`,\n"
     "        projection = scale shift persp, without persp in parallel; w1 and w2 are persp's third row",
     "factors, or nothing", .set = set_matrix},
    {"point", "X,Y,Z",
     "prints a vertex at every stage with the camera of the first frame: object, world, view, clip, ndc, pixel; each\n"
     "        number as an exact fraction, a decimal, Pinhole's code in steps of 1/65536, and its error in such "
     "steps;\n"
     "        and its code in each depth format. With a fisheye, after view: distance from the eye, angle off the "
     "view\n"
     "        direction, scale in pixels per radian, radius = angle times scale, pixel",
     "three numbers", .set = set_point},
    {"object", "X,Y,Z[,target=X,Y,Z]",
     "where the object of --point stands, and what its z axis points at, as an object's lookAt does; --matrix prints\n"
     "        `object`",
     "three numbers and, optionally, target= with three", .set = set_object},
    {"frustum", "Z[,H]",
     "prints what the camera of the first frame sees: fields of view and aspect, and width and height of the view\n"
     "        volume at the distance Z; the field of view that a height H fills there, and the distance at which it "
     "fills\n"
     "        the camera's own",
     "a distance, more than 0, and, optionally, a comma and a height, more than 0", .set = set_frustum},
    {"focus", "D[,STRENGTH]",
     "the depth of field of a scene that has one (focus): D is the distance in focus, STRENGTH the radius in pixels\n"
     "        of the blur of what is infinitely far away. What is at the distance Z has a blur of the diameter\n"
     "        2 STRENGTH |1 - D / Z|; --point and --frustum print it, and the aperture of the lens that blurs so",
     "a distance, more than 0, and, optionally, a comma and 0 .. 64 pixels", .set = set_focus},
    {"flatten", "kaist-4.7|kaist-4.11|eece=D|plane=X,Y,Z,D",
     "prints `flatten` with --matrix, and with --point what it makes of the point: a matrix that drops the depth, in\n"
     "        parallel (KAIST 4.7), by w = z (4.11) or w = z / D (EECE 478), or that projects from the eye onto the\n"
     "        plane n.p + D = 0, with the normal X,Y,Z at the distance D, on the side that it points away from",
     "kaist-4.7, kaist-4.11, eece=D or plane=X,Y,Z,D with a normal and a D that are not 0", .set = set_flatten},
    {"stats", NULL,
     "prints the cost of each frame on stderr: vertices transformed; triangles in: given; culled: facing away,\n"
     "        outside the view volume or between the pixels; clipped: cut at its border; drawn: listed (what was\n"
     "        clipped may give several); dropped: no room in the scene's budget; fragments: pixels tested for depth;\n"
     "        wire, bus: bytes and time of the frame on the SPI bus",
     NULL, .at = offsetof(struct sim_options, stats)},
    {"json", NULL, "prints --crc, --stats and --list as JSON; host-sim/README.md has the keys", NULL,
     .at = offsetof(struct sim_options, json)},
    {"list", NULL, "prints the demos with the frames of their loops, and the boards with their sizes", NULL,
     .set = set_list},
    {"help", NULL, "prints this, as does -h", NULL, .set = set_help},
};

static const struct option_table table = {rows, sizeof rows / sizeof rows[0]};

void sim_options_help(void)
{
    puts("pinhole-sim [options]: draws a scene through a display kit's driver into a model of its display\n"
         "controller, and shows what the glass shows.\n");
    option_table_help(&table);
    puts("\nExit status: 0 done; 1 failed, or the controller was misused; 2 wrong usage.");
}

/* LMU's planes are coordinates on the z axis, along whose negative half its camera looks. */
static int take_planes(struct sim_options *o)
{
    if (o->convention != PH_LMU || (o->near_z >= 0 && o->far_z >= 0)) {
        return 0;
    }
    if ((o->near_set && o->near_z >= 0) || (o->far_set && o->far_z >= 0)) {
        return complain_usage("--near, --far: one is a coordinate, below 0, and the other a distance; write both in "
                              "the same way");
    }
    o->near_z = fx_abs_sat(o->near_z);
    o->far_z = fx_abs_sat(o->far_z);
    return 0;
}

static int check_camera(const struct sim_options *o)
{
    if (o->projection != OPTION_FISHEYE && o->fov_deg >= FX_INT(180)) {
        return complain_usage("--fov: must be less than 180 degrees; more only with --projection fisheye");
    }
    if (o->projection == OPTION_FISHEYE && o->fov_deg != 0 && o->fov_deg < FX_INT(10)) {
        return complain_usage("--fov: must be 10 .. 240 degrees for a fisheye");
    }
    if (o->camera.set && o->view_matrix_set) {
        return complain_usage("--camera and --view-matrix exclude each other");
    }
    if (o->anyway && !o->view_matrix_set && !o->lens_matrix_set) {
        return complain_usage("--anyway: of which matrix? give --view-matrix or --projection-matrix");
    }
    if (o->lens_matrix_set && o->projection_set) {
        return complain_usage("--projection-matrix holds all of the lens: leave --fov, --focal, --near, --far and "
                              "--projection away");
    }
    if (o->focal != 0 && (o->fov_deg != 0 || o->projection != OPTION_PERSPECTIVE)) {
        return complain_usage("--focal is a perspective's, and excludes --fov");
    }
    if (o->focal < 0 && !o->camera.set && !o->view_matrix_set) {
        return complain_usage("--focal: below 0 it turns the view, so that it needs --camera or --view-matrix");
    }
    if (o->object_set && !o->matrix && !o->point_set) {
        return complain_usage("--object: of what? give --point or --matrix");
    }
    if (o->flatten != NULL && !o->matrix && !o->point_set) {
        return complain_usage("--flatten: is printed with --matrix or --point; give one, too");
    }
    if (o->parent_set && !o->camera.set && !o->view_matrix_set) {
        return complain_usage("--parent: of which camera? give --camera or --view-matrix");
    }
    if (o->projection == OPTION_FISHEYE && o->frustum_z != 0) {
        return complain_usage("--frustum: a fisheye has none; choose another --projection");
    }
    if (o->projection == OPTION_FISHEYE && o->matrix) {
        return complain_usage("--matrix: a fisheye has no matrix; choose another --projection");
    }
    return 0;
}

static int check_together(const struct sim_options *o)
{
    if (o->demo != NULL && o->model != NULL) {
        return complain_usage("--demo and --model exclude each other");
    }
    const struct model_options *const m = &o->model_options;
    const char *const of_model = o->clip != NULL      ? "clip"
                                 : o->clip_fps != 0   ? "clip-fps"
                                 : o->goal_set        ? "max-triangles"
                                 : m->filter != NULL  ? "filter"
                                 : m->up != NULL      ? "up"
                                 : m->cross_fade_ms   ? "cross-fade"
                                 : m->two_sided       ? "two-sided"
                                 : m->allow_outside   ? "allow-outside"
                                 : m->texture != NULL ? "texture"
                                                      : NULL;
    if (o->model == NULL && of_model != NULL) {
        return complain_usage("--%s: of which model? give --model FILE", of_model);
    }
    if (o->goal.fit && o->board == NULL) {
        return complain_usage("--max-triangles fit: fit what? name a --board");
    }
    if (o->board != NULL && o->width != 0) {
        return complain_usage("--board and --size exclude each other");
    }
    if (o->antialias && o->dither) {
        return complain_usage("--dither and --aa exclude each other");
    }
    if (o->show != NULL && (o->antialias || o->overlay)) {
        return complain_usage("--show depth excludes --aa and --overlay: it shows a code for each pixel");
    }
    if (o->action == OPTION_RUN && o->out == NULL && o->check == NULL && !o->crc && !o->stats && !o->matrix &&
        !o->point_set && o->frustum_z == 0 && !o->show_window) {
        return complain_usage("nothing to do: give --out, --check, --crc, --stats, --matrix, --point, --frustum or "
                              "--window (see --help)");
    }
    if (o->json && o->action == OPTION_RUN && !o->crc && !o->stats) {
        return complain_usage("--json: of what? it is a form of --list, --crc and --stats");
    }
    return check_camera(o);
}

int sim_options_read(struct sim_options *o, int argc, char *const argv[])
{
    *o = (struct sim_options){
        .image_height = 2 * FX_ONE,
        .focus_strength = -1,
        .object = ph_xform_identity,
        .near_z = FX_HALF,
        .far_z = FX_INT(100),
        .goal = {.triangles = UINT32_MAX, .texture_log2 = ASSET_TEXTURE_LOG2, .flash_bytes = UINT32_MAX}};
    for (int i = 1; i < argc;) {
        i = option_table_read(&table, o, argc, argv, i);
        if (i < 0) {
            return i;
        }
    }
    if (o->frames == 0) {
        o->frames = o->show_window ? UINT32_MAX : 1;
    }
    const int status = take_planes(o);
    return status != 0 ? status : check_together(o);
}

/* half = distance tan(fov / 2), rounded once; it saturates. */
static fx_t half_height(const struct sim_options *o, fx_t distance)
{
    int32_t sine, cosine;
    fx_sincos_q30(fx_turn32_from_deg(o->fov_deg != 0 ? o->fov_deg : FOV_DEG) / 2, &sine, &cosine);
    const int64_t half = ((int64_t)distance * sine + cosine / 2) / (cosine > 0 ? cosine : 1);
    return half > FX_MAX ? FX_MAX : (fx_t)half;
}

/* The lens in a square picture; its window, where one is given, is not the picture's matter. */
static int square_lens(const struct sim_options *o, struct ph_projection *p)
{
    const fx_t n = o->near_z, f = o->far_z, *const w = o->window;
    const bool ortho = o->projection == OPTION_ORTHO;
    if (o->focal != 0) {
        return ph_projection_pinhole(p, fx_abs_sat(o->focal), o->image_height, o->image_height, n, f);
    }
    if (o->projection == OPTION_FISHEYE) {
        return ph_projection_fisheye(p, o->fov_deg != 0 ? o->fov_deg : FISHEYE_DEG, n, f);
    }
    if (o->window_set) {
        return (ortho ? ph_projection_ortho : ph_projection_frustum)(p, w[0], w[1], w[2], w[3], n, f);
    }
    if (ortho) {
        const fx_t top = half_height(o, o->camera.set ? o->camera.distance : FX_INT(3));
        return ph_projection_ortho(p, -top, top, -top, top, n, f);
    }
    return ph_projection_perspective(p, o->fov_deg != 0 ? o->fov_deg : FOV_DEG, FX_ONE, n, f);
}

int sim_options_projection(const struct sim_options *o, uint16_t width, uint16_t height, struct ph_projection *p)
{
    if (o->lens_matrix_set) {
        return sim_matrix_projection(&o->lens_matrix, (enum ph_convention)o->convention, p);
    }
    const int status = square_lens(o, p);
    return status != 0 || o->window_set || o->projection == OPTION_FISHEYE ? status
                                                                           : ph_projection_fit(p, width, height);
}
