/* See words.h. */
#include "words.h"

#include <stdio.h>
#include <string.h>

int words_of(const char *line, char *words[WORDS_MAX])
{
    static char text[1000], name[] = "program";
    int count = 1;
    snprintf(text, sizeof text, "%s", line);
    words[0] = name;
    for (char *word = strtok(text, " "); word != NULL && count < WORDS_MAX; word = strtok(NULL, " ")) {
        words[count++] = word;
    }
    return count;
}
