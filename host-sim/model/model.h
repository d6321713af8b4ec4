/*
 * model: a model file (OBJ, STL, PLY, glTF, GLB, and with assimp whatever that reads) as meshes for the renderer, and
 * as a demo. A binary scene (.phs, scene_file.h) is drawn as it is: no option changes it.
 *
 * The model is triangulated, the transforms of its nodes are applied, and points and lines are left out. Missing
 * normals are made: smooth for OBJ and STL, with creases above 66 degrees; flat for PLY, glTF and other formats that
 * share vertices, as glTF asks. Meshes are split at 65535 vertices. The model is moved and scaled into the sphere of
 * radius 1 around the origin, which it touches. The diffuse colour of a material becomes its ramp. A texture, PNG,
 * JPEG or WebP, is resampled to a power of two of at most 1024; one that cannot be used (missing, broken) leaves the
 * colour. A note tells what was changed or ignored.
 *
 * STL has z up, and is turned: y is up here. options say otherwise.
 *
 * The first camera of a glTF file becomes the camera of the model, moved and scaled with it. Its near and far planes
 * come as close to the model as they can. A panel of another shape shows all of the camera's picture.
 * A camera in whose picture less than 5 % show the model is left out, and noted.
 *
 * The clips of a glTF file play one by one, and repeat; the first one begins: nodes, skins of up to 256 joints and
 * morph targets move, in fixed point, as on a kit (motion.h). The sphere is that around all that the clips show.
 * Vertices are right to 1/1000 of its radius at every time; a file with a number that the fixed point has no room for
 * is refused, and the number named.
 *
 * Of glTF these are read, too: base colour factor times texture, vertex colours, alpha masks and blending, emission
 * (a factor, and a texture at the coordinates of the base colour's), unlit, mirrored textures and
 * KHR_texture_transform. A required extension that is not read is an error. Of MTL: d and map_d. Meshes that blend
 * are drawn from the farthest to the nearest, in the order of the file if they are more than 64. Emission of what
 * has a texture, and vertex colours on an opaque texture, are meshes of their own, drawn over it.
 *
 * A model may name files of its own folder and below: buffers, pictures, materials. One that leads out of it (../,
 * an absolute path, a link) is an error unless options allow it: what a stranger's model names ends in an image.
 *
 * A reader for each format makes a scene (model_scene.h), of which the meshes are made: formats/ has OBJ, STL and PLY,
 * gltf/ glTF and GLB, without any library; assimp/ has other formats by libassimp, and noassimp/ says what to install.
 * A child process with limits of time and memory does it in shared memory: a file that crashes or hangs the reader
 * costs one line, not the program.
 */
#ifndef MODEL_H
#define MODEL_H

#include "animation.h"

#define MODEL_TRIANGLES_MAX 4000000u
#define MODEL_FILE_MAX      (1u << 30) /* bytes */
#define MODEL_VERTICES_MAX  65535u     /* of one mesh */

/* The largest errors of a file's numbers that became 16 bits. Lengths are in those of the model, whose radius is 1. */
struct model_rounding {
    double position, target, translation; /* of the bind pose; of morph targets; of keys */
    double rotation;                      /* of keys, in degrees */
    double scale, weight;                 /* of keys */
    double share;                         /* of a joint in a vertex */
    double time;                          /* of keys, in seconds */
};

struct model_motion {
    struct animation animation;
    double centre[3]; /* what the model's origin is in the file */
    struct model_rounding rounding;
};

struct model {
    struct ph_mesh *meshes;
    uint32_t mesh_count;
    uint32_t vertex_max;     /* vertices of the largest mesh */
    uint32_t triangle_count; /* of all meshes */
    double scale;            /* lengths of the model in those of the file; 0: a binary scene, which has the model's */
    bool has_camera;
    struct demo_eye camera;
    const char *note;                 /* one line on what could not be used, or NULL */
    struct model_motion *motion;      /* NULL: nothing moves */
    const struct demo_studio *studio; /* of options; NULL: as usual */
    const void *scene;                /* of a binary scene: its bytes, as scene_file.h says; else NULL */
};

/* How a file is read; all zero: as it says. */
struct model_options {
    const char *up;      /* "y" or "z": the axis that points up; NULL: z of STL, y of other files */
    const char *texture; /* a picture for all that has texture coordinates, or NULL */
    const char *filter;  /* of its textures: "nearest", "bilinear", "mipmap", or "file": as the samplers of a glTF file
                            say; NULL: nearest. A binary scene keeps its own. */
    const char *background; /* RRGGBB, a colour in hexadecimal; NULL: DEMO_MODEL_BACKGROUND */
    const char *light;      /* one of MODEL_LIGHTS: one lamp far away, where the viewer sees it; NULL: two lamps */
    uint32_t cross_fade_ms; /* how long the way from one clip to the next takes; 0: ANIMATION_CROSS_FADE */
    bool two_sided;         /* all faces are drawn from behind, too */
    bool allow_outside;     /* it may name files outside of its folder */
};

#define MODEL_LIGHTS "left|right|front|above|back"

/* Whether a text is six hexadecimal digits. */
bool model_is_colour(const char *text);

/* NOLINTBEGIN(bugprone-macro-parentheses): names, which stand in none */
/* The row for a member that is model_options.allow_outside. */
#define MODEL_OPTION_OUTSIDE(options, member)                                                                          \
    {                                                                                                                  \
        "allow-outside", NULL,                                                                                         \
            "the model may name files outside of its folder, such as ../a.png: what it names ends in pictures and\n"   \
            "        images, so allow it to a model that you trust",                                                   \
            NULL, .at = offsetof(options, member)                                                                      \
    }

/* The rows of a struct option_table that set model_options in struct `options`. */
#define MODEL_OPTION_ROWS(options, member)                                                                             \
    {"up",                                                                                                             \
     "y|z",                                                                                                            \
     "the axis of the model that points up; z of STL, y of other files by default",                                    \
     "y or z",                                                                                                         \
     .at = offsetof(options, member.up),                                                                               \
     .words = "y|z"},                                                                                                  \
        {"texture", "FILE", "a picture for all of the model that has texture coordinates", "a PNG, JPEG or WebP file", \
         .at = offsetof(options, member.texture)},                                                                     \
        {"filter",                                                                                                     \
         "NAME",                                                                                                       \
         "how textures are drawn: nearest (by default), bilinear, mipmap (bilinear, with smaller levels for what is\n" \
         "        far: a third more flash), or file: as the samplers of a glTF file say",                              \
         "nearest, bilinear, mipmap or file",                                                                          \
         .at = offsetof(options, member.filter),                                                                       \
         .words = "nearest|bilinear|mipmap|file"},                                                                     \
        {"background",                                                                                                 \
         "RRGGBB",                                                                                                     \
         "the colour behind the model, in hexadecimal; 141A26 by default",                                             \
         "six hexadecimal digits",                                                                                     \
         .at = offsetof(options, member.background),                                                                   \
         .check = model_is_colour},                                                                                    \
        {"light",                                                                                                      \
         MODEL_LIGHTS,                                                                                                 \
         "where one lamp stands, far away, as the viewer sees it; two lamps by default",                               \
         "left, right, front, above or back",                                                                          \
         .at = offsetof(options, member.light),                                                                        \
         .words = MODEL_LIGHTS},                                                                                       \
        {"cross-fade",                                                                                                 \
         "MS",                                                                                                         \
         "how long one clip takes to fade into the next, by the select button or in turn; 250 ms by default",          \
         "a whole number, 1 .. 10000",                                                                                 \
         .at = offsetof(options, member.cross_fade_ms),                                                                \
         .least = 1,                                                                                                   \
         .most = 10000},                                                                                               \
        {"two-sided", NULL, "draws all faces of the model from behind, too", NULL,                                     \
         .at = offsetof(options, member.two_sided)},                                                                   \
        MODEL_OPTION_OUTSIDE(options, member.allow_outside)
/* NOLINTEND(bugprone-macro-parentheses) */

/* Reads a file; options may be NULL. 0 or COMPLAINED. */
int model_open(struct model **model, const char *path, const struct model_options *options);

void model_close(struct model *model);

/* How a mesh moves; NULL: it stands still. */
const struct animation_mesh *model_moving(const struct model *model, uint32_t mesh);

/* Triangles of the budget that its blends take in a picture of so many columns; 0 without blends. */
uint32_t model_blend_triangles(const struct model *model, uint32_t width);

/* Frames of the clip that plays, or of a round of those that play in turn; 0: there is none. */
uint32_t model_clip_frames(const struct model *model);

/* Begins with the clip of that name from now on. Of several names with commas between them, no other clips are kept,
 * and they play in turn (animation_round()). NULL changes nothing. 0, or after complaining PH_ERR_INVAL, and then the
 * clips may stand in another order. */
int model_play(struct model *model, const char *name);

/* Returns a demo of the model: with a camera it has the views `camera` and `turntable`, else `turntable` alone. Its
 * context->state must be the model. */
struct demo model_demo(const struct model *model);

#endif
