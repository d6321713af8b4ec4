/* model_file_io: how assimp opens files: for reading, and only those that the model may name (model_folder.h). */
#ifndef MODEL_FILE_IO_H
#define MODEL_FILE_IO_H

#include "model_folder.h"

#include <assimp/cfileio.h>

/* The folder and what this returns must outlive the scene. */
struct aiFileIO model_file_io(struct model_folder *folder);

#endif
