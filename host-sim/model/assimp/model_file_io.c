/* See model_file_io.h. */
#include "model_file_io.h"

#include <stdio.h>
#include <stdlib.h>

static FILE *stream_of(struct aiFile *file)
{
    return (FILE *)(void *)file->UserData;
}

static size_t read_items(struct aiFile *file, char *to, size_t size, size_t count)
{
    return fread(to, size, count, stream_of(file));
}

static size_t write_items(struct aiFile *file, const char *from, size_t size, size_t count)
{
    (void)file;
    (void)from;
    (void)size;
    (void)count;
    return 0;
}

static size_t tell(struct aiFile *file)
{
    const long at = ftell(stream_of(file));
    return at >= 0 ? (size_t)at : 0;
}

static enum aiReturn seek(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    const int from = origin == aiOrigin_SET ? SEEK_SET : origin == aiOrigin_CUR ? SEEK_CUR : SEEK_END;
    return fseek(stream_of(file), (long)offset, from) == 0 ? aiReturn_SUCCESS : aiReturn_FAILURE;
}

static size_t size_of(struct aiFile *file)
{
    const size_t at = tell(file);
    seek(file, 0, aiOrigin_END);
    const size_t size = tell(file);
    seek(file, at, aiOrigin_SET);
    return size;
}

static void flush(struct aiFile *file)
{
    (void)file;
}

static struct aiFile *open_file(struct aiFileIO *io, const char *name, const char *mode)
{
    char path[MODEL_PATH_BYTES];
    if (mode[0] != 'r' || !model_folder_find_path((struct model_folder *)(void *)io->UserData, name, path)) {
        return NULL;
    }
    FILE *stream = fopen(path, "rb");
    struct aiFile *file = stream != NULL ? malloc(sizeof *file) : NULL;
    if (file != NULL) {
        *file = (struct aiFile){.ReadProc = read_items,
                                .WriteProc = write_items,
                                .TellProc = tell,
                                .FileSizeProc = size_of,
                                .SeekProc = seek,
                                .FlushProc = flush,
                                .UserData = (aiUserData)(void *)stream};
    } else if (stream != NULL) {
        fclose(stream);
    }
    return file;
}

static void close_file(struct aiFileIO *io, struct aiFile *file)
{
    (void)io;
    fclose(stream_of(file));
    free(file);
}

struct aiFileIO model_file_io(struct model_folder *folder)
{
    return (struct aiFileIO){.OpenProc = open_file, .CloseProc = close_file, .UserData = (aiUserData)(void *)folder};
}
