/* See asset_options.h. One table has every option, its reader and its help. */
#include "asset_options.h"

#include "complain.h"
#include "model.h"
#include "option_table.h"
#include "option_text.h"

#include <stdio.h>
#include <string.h>

#define TEXTURE_LOG2_LIMIT 10
#define FLASH_LIMIT        (1u << 30)
#define OUT_TAKES          "a file that ends in .c or .phs (a binary scene), or -"

static bool set_out(void *to, const char *value)
{
    ((struct asset_options *)to)->out = value;
    return strcmp(value, "-") == 0 || option_text_ends(value, ".c") || option_text_ends(value, ".phs");
}

static bool set_board(void *to, const char *value)
{
    ((struct asset_options *)to)->goal.board = board_find(value);
    return board_find(value) != NULL;
}

static bool set_triangles(void *to, const char *value)
{
    return asset_triangles_named(value, &((struct asset_options *)to)->goal);
}

static bool set_texture(void *to, const char *value)
{
    struct asset_options *o = to;
    uint32_t side = 0;
    if (!option_text_u32(value, 1, 1u << TEXTURE_LOG2_LIMIT, &side) || (side & (side - 1)) != 0) {
        return false;
    }
    for (o->goal.texture_log2 = 0; 1u << o->goal.texture_log2 < side;) {
        o->goal.texture_log2++;
    }
    return true;
}

static const struct option_row rows[] = {
    {"out", "FILE.c|FILE.phs", "where the C file goes, - is stdout, or the binary scene; also -o FILE", OUT_TAKES,
     .set = set_out},
    {"max-triangles", "N|all|fit",
     "simplifies to N triangles at most; fit: to what the board has room for. all by default",
     "a whole number, 1 .. 4000000, all or fit", .set = set_triangles},
    {"texture-size", "N", "longest side of a texture; larger ones are shrunk. 256 by default",
     "a power of two, 1 .. 1024", .set = set_texture},
    MODEL_OPTION_ROWS(struct asset_options, model_options),
    {"clip", "NAME[,NAME]",
     "keeps this clip of a glTF file alone, or these, of which each plays once and fades into the next while it ends;\n"
     "        without it all are kept, and the first plays, until the select button takes the next",
     "a name, or several", .at = offsetof(struct asset_options, clip)},
    {"board", "NAME", "the scene must fit this board's memory; the report is about it alone",
     "a name that pinhole-sim --list shows", .set = set_board, .names = nearest_board},
    {"flash", "BYTES", "bytes of flash that the data must fit", "a whole number, 1 .. 1073741824",
     .at = offsetof(struct asset_options, goal.flash_bytes), .least = 1, .most = FLASH_LIMIT},
    {"turntable", NULL, "shows the model on the turntable even if the file has a camera", NULL,
     .at = offsetof(struct asset_options, goal.turntable)},
    {"report", NULL,
     "prints how much flash the scene needs, and how much memory on each board: bands of the picture, and the scene's\n"
     "        vertices and the most triangles that a frame lists, looked at from all sides, from afar and near by",
     NULL, .at = offsetof(struct asset_options, report)},
    {"force", NULL,
     "writes a model that simplification has changed too much, too: one of which more than a tenth of the pixels are\n"
     "        off by more than 40 of 255, seen from eight sides",
     NULL, .at = offsetof(struct asset_options, force)},
    {"check-bounds", NULL,
     "looks whether the meshes of MODEL, a .c or .phs file that this program wrote, keep within their bounds", NULL,
     .at = offsetof(struct asset_options, check)},
    {"help", NULL, "prints this, as does -h", NULL, .at = offsetof(struct asset_options, help)},
};

static const struct option_table table = {rows, sizeof rows / sizeof rows[0]};

void asset_options_help(void)
{
    puts("pinhole-asset MODEL [options]: makes a model file (OBJ, STL, PLY, glTF, GLB) into a C file of const data,\n"
         "or a binary scene, that a display kit draws from its flash. `make firmware BOARD=x SCENE=MODEL` makes an "
         "image of it.\n");
    option_table_help(&table);
    puts("\nExit status: 0 done; 1 failed; 2 wrong usage.");
}

static int check(const struct asset_options *o)
{
    if (o->help) {
        return 0;
    }
    if (o->goal.model == NULL) {
        return complain_usage("no model named (see --help)");
    }
    if (o->check) {
        return option_text_ends(o->goal.model, ".c") || option_text_ends(o->goal.model, ".phs")
                   ? 0
                   : complain_usage("--check-bounds: '%s' is no .c or .phs file", o->goal.model);
    }
    if (o->goal.fit && o->goal.board == NULL) {
        return complain_usage("--max-triangles fit: fit what? name a --board");
    }
    if (o->out == NULL && !o->report) {
        return complain_usage("nothing to do: give -o FILE.c, --report or --check-bounds (see --help)");
    }
    if (o->report && o->out != NULL && strcmp(o->out, "-") == 0) {
        return complain_usage("--report and -o - both want stdout; give -o a file");
    }
    return 0;
}

int asset_options_read(struct asset_options *o, int argc, char *const argv[])
{
    *o = (struct asset_options){
        .goal = {.triangles = UINT32_MAX, .texture_log2 = ASSET_TEXTURE_LOG2, .flash_bytes = UINT32_MAX}};
    for (int i = 1; i < argc;) {
        if (strcmp(argv[i], "-o") == 0) {
            if (i + 1 == argc) {
                return complain_usage("-o needs a value: FILE.c or FILE.phs");
            }
            if (!set_out(o, argv[i + 1])) {
                return complain_usage("-o '%s': must be " OUT_TAKES, argv[i + 1]);
            }
            i += 2;
        } else if (argv[i][0] == '-') {
            i = option_table_read(&table, o, argc, argv, i);
            if (i < 0) {
                return i;
            }
        } else if (o->goal.model != NULL) {
            return complain_usage("'%s': one model at a time, and %s is named already", argv[i], o->goal.model);
        } else {
            o->goal.model = argv[i++];
        }
    }
    return check(o);
}
