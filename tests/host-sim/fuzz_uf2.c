/*
 * Random files into the reader of images: no crash, no error of the sanitizers, and nothing taken that is not right.
 * Half of the files are right ones with their blocks in another order, of which a few fields or bytes are then changed;
 * what has been changed says whether the file may be taken and what it holds. The other half is noise, cut and put
 * together from parts of such files; what is taken there must be what its blocks say, one by one.
 *
 *   fuzz_uf2 [quick | long | FILES [SEED]]
 *
 * With libFuzzer, which has the same checks: clang -fsanitize=fuzzer,address,undefined -DLIBFUZZER
 * (tests/guest/long_guest_flash_cuts.sh).
 */
#include "flash_file.h"
#include "uf2_make.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- what was taken is what the blocks say ------------------------------------------------------ */

static void fail(const char *what)
{
    fprintf(stderr, "fuzz_uf2: %s\n", what);
    abort();
}

/* Is the first block one against erratum E10, which is not of the image? */
static bool has_e10(const uint8_t *file, size_t n)
{
    return n > UF2_BLOCK && uf2_get(file + UF2_FAMILY) == 0xE48BFF57 && (uf2_get(file + UF2_FLAGS) & 0x2000) != 0 &&
           uf2_get(file + UF2_ADDRESS) == 0x10FFFF00 && uf2_get(file + UF2_NUMBER) == 0 &&
           uf2_get(file + UF2_TOTAL) == 2;
}

static bool is_of(uint32_t family, const struct flash_image *image)
{
    return image->chip == FLASH_RP2040 ? family == 0xE48BFF56
                                       : family == 0xE48BFF57 || family == 0xE48BFF59 || family == 0xE48BFF5A;
}

/* Every byte of the image comes from a block for it, or is erased; every block's bytes are there. */
static void check_blocks(const struct flash_image *image, const uint8_t *file, size_t n)
{
    if (has_e10(file, n)) {
        file += UF2_BLOCK;
        n -= UF2_BLOCK;
    }
    const size_t blocks = n / UF2_BLOCK, size = (size_t)image->sectors * FLASH_SECTOR;
    uint8_t *expected = malloc(size);
    uint32_t taken = 0;
    if (expected == NULL) {
        fail("out of memory");
    }
    memset(expected, 0xFF, size);
    if (n % UF2_BLOCK != 0) {
        fail("a part of a block was taken");
    }
    for (size_t i = 0; i < blocks; i++) {
        const uint8_t *b = file + i * UF2_BLOCK;
        const uint64_t at = (uint64_t)uf2_get(b + UF2_ADDRESS) - FLASH_BASE;
        if ((uf2_get(b + UF2_FLAGS) & 1) != 0) {
            continue;
        }
        if (uf2_get(b + UF2_TOTAL) != blocks || uf2_get(b + UF2_NUMBER) >= blocks ||
            !is_of(uf2_get(b + UF2_FAMILY), image) || at + 256 > size || !image->used[at / FLASH_SECTOR]) {
            fail("a wrong block was taken");
        }
        memcpy(expected + at, b + UF2_DATA, 256);
        taken += 256;
    }
    if (memcmp(expected, image->bytes, size) != 0 || taken != image->size) {
        fail("the image is not what its blocks say");
    }
    free(expected);
}

static void check_bin(const struct flash_image *image, const uint8_t *file, size_t n)
{
    uint8_t boot2[256];
    memcpy(boot2, file, sizeof boot2);
    uf2_seal_boot2(boot2);
    const bool starts = memcmp(boot2, file, sizeof boot2) == 0 || image->chip == FLASH_RP2350;
    if (image->size != n || memcmp(image->bytes, file, n) != 0 || !starts) {
        fail("a BIN is not itself");
    }
}

/* Parses a file with the parser under test. Was it taken? */
static bool parse(const uint8_t *file, size_t n)
{
    struct flash_image image;
    char error[FLASH_ERROR_SIZE] = "";
    if (flash_file_parse(&image, file, n, error) != 0) {
        if (error[0] == '\0' || strchr(error, '\n') != NULL || image.bytes != NULL || image.used != NULL) {
            fail("refused without a line, or with an image");
        }
        return false;
    }
    const bool uf2 = n >= UF2_BLOCK && uf2_get(file) == 0x0A324655;
    (uf2 ? check_blocks : check_bin)(&image, file, n);
    flash_image_free(&image);
    return true;
}

#ifdef LIBFUZZER
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    parse(data, size);
    return 0;
}
#else

enum {
    PAGES_FEW = 6,
    PAGES_MOST = 48,
    BIN_MOST = PAGES_MOST * 256,
    FILE_MOST = 2 * BIN_MOST,
    QUICK = 10000,
    LONG = 1000000
};

static uint64_t state;

static uint32_t below(uint32_t n)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((state >> 32) * n >> 32);
}

/* ---- right files, and what is done to them ------------------------------------------------------ */

static uint32_t right_file(uint8_t *file)
{
    static uint8_t bin[BIN_MOST];
    const uint32_t pages = 1 + below(below(8) != 0 ? PAGES_FEW : PAGES_MOST);
    uf2_make_bin(bin, pages * 256, below(1000));
    uf2_make(file, bin, pages * 256);
    if (below(2) == 0) {
        uf2_for_rp2350(file, pages);
    }
    for (uint32_t i = 0; i < pages; i++) {
        uint8_t *a = file + (size_t)i * UF2_BLOCK, *b = file + (size_t)below(pages) * UF2_BLOCK, c[UF2_BLOCK];
        memcpy(c, a, UF2_BLOCK);
        memmove(a, b, UF2_BLOCK);
        memcpy(b, c, UF2_BLOCK);
    }
    return pages;
}

enum verdict { EITHER, RIGHT, WRONG };

/* One change; is the file still right? */
static enum verdict change(uint8_t *file, uint32_t pages)
{
    static const int fields[] = {UF2_MAGIC_0, UF2_MAGIC_1, UF2_ADDRESS, UF2_SIZE,
                                 UF2_NUMBER,  UF2_TOTAL,   UF2_FAMILY,  UF2_MAGIC_END};
    uint8_t *b = file + (size_t)below(pages) * UF2_BLOCK;
    const bool first = uf2_get(b + UF2_ADDRESS) == FLASH_BASE;
    switch (below(4)) {
    case 0: /* bytes after the payload */
        b[UF2_DATA + 256 + below(476 - 256)] ^= (uint8_t)(1 + below(255));
        return RIGHT;
    case 1: /* payload: right, but for boot2 with its checksum, or the definition */
        b[UF2_DATA + below(256)] ^= (uint8_t)(1 + below(255));
        return first ? (uf2_get(b + UF2_FAMILY) == 0xE48BFF56 ? WRONG : EITHER) : RIGHT;
    case 2: /* to a free page */
        uf2_put(b + UF2_ADDRESS, FLASH_BASE + 256 * (PAGES_MOST + below(below(8) != 0 ? 32 : 2048)));
        return first && pages > 1 ? WRONG : RIGHT; /* the first sector would have lost its boot2 */
    default: {                                     /* a bit of a field; that of an address may lead to a free page */
        const int field = fields[below(8)];
        const uint32_t bit = below(32);
        uf2_put(b + field, uf2_get(b + field) ^ 1u << bit);
        return field == UF2_ADDRESS && bit >= 8 && bit < 24 ? EITHER : WRONG;
    }
    }
}

/* ---- noise -------------------------------------------------------------------------------------- */

static uint32_t noise(uint8_t *file, uint32_t pages)
{
    uint32_t n = pages * UF2_BLOCK;
    for (uint32_t i = below(12); i > 0; i--) {
        const uint32_t at = below(n), from = below(n), most = n - (at > from ? at : from);
        switch (below(4)) {
        case 0:
            file[at] = (uint8_t)below(256);
            break;
        case 1:
            memmove(file + at, file + from, below(most + 1));
            break;
        case 2:
            memset(file + at, (int)below(256), below(most + 1));
            break;
        default:
            uf2_put(file + at / 4 * 4, 1u << below(32));
            break;
        }
    }
    return below(3) == 0 ? below(n + 1) : n;
}

struct counts {
    uint64_t files, taken, right, wrong;
};

/* In half of the files of an RP2350 the block against erratum E10 comes first; in noise it may be damaged. */
static uint32_t put_e10(uint8_t *block, enum verdict verdict)
{
    if (below(2) == 0) {
        return 0;
    }
    uf2_make_e10(block);
    if (verdict == EITHER && below(2) == 0) {
        block[below(UF2_DATA)] ^= (uint8_t)(1 + below(255));
    }
    return UF2_BLOCK;
}

static void one_file(struct counts *c)
{
    static uint8_t e10[UF2_BLOCK], file[FILE_MOST];
    const uint32_t pages = right_file(file);
    const bool is_rp2350 = uf2_get(file + UF2_FAMILY) == 0xE48BFF59;
    enum verdict verdict = RIGHT;
    uint32_t n = pages * UF2_BLOCK;
    if (below(2) == 0) {
        verdict = below(8) == 0 ? RIGHT : change(file, pages);
    } else {
        verdict = EITHER;
        n = noise(file, pages);
    }
    const uint32_t before = is_rp2350 ? put_e10(e10, verdict) : 0;
    uint8_t *exact = malloc(before + n > 0 ? before + n : 1); /* the sanitizer sees a byte too far */
    if (exact == NULL) {
        fail("out of memory");
    }
    memcpy(exact, e10, before);
    memcpy(exact + before, file, n);
    const bool taken = parse(exact, before + n);
    free(exact);
    if ((verdict == RIGHT && !taken) || (verdict == WRONG && taken)) {
        fail(taken ? "a wrong file was taken" : "a right file was refused");
    }
    c->files++;
    c->taken += taken;
    c->right += verdict == RIGHT;
    c->wrong += verdict == WRONG;
}

int main(int argc, char **argv)
{
    uint32_t files = QUICK;
    uint64_t seed = 20261121;
    if (argc > 3 || (argc > 1 && argv[1][0] == '-')) {
        fprintf(argc == 2 ? stdout : stderr, "usage: fuzz_uf2 [quick | long | FILES [SEED]]\n");
        return argc == 2 && strcmp(argv[1], "--help") == 0 ? 0 : 2;
    }
    if (argc > 1 && strcmp(argv[1], "quick") != 0) {
        files = strcmp(argv[1], "long") == 0 ? LONG : (uint32_t)strtoul(argv[1], NULL, 10);
    }
    if (argc > 2) {
        seed = strtoull(argv[2], NULL, 10);
    }
    struct counts c = {0};
    printf("%" PRIu32 " files, seed %" PRIu64 "\n", files, seed);
    fflush(stdout);
    while (c.files < files) {
        state = (seed + c.files) * 0xd1342543de82ef95u;
        one_file(&c);
    }
    printf("%" PRIu64 " files: %" PRIu64 " right ones, %" PRIu64 " wrong ones; %" PRIu64 " taken\n", c.files, c.right,
           c.wrong, c.taken);
    /* A run that saw only files of one kind has tested nothing. */
    return files < QUICK || (c.right > files / 5 && c.wrong > files / 20 && c.taken > c.right) ? 0 : 1;
}
#endif
