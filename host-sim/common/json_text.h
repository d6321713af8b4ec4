/* json_text: text in JSON (RFC 8259). */
#ifndef JSON_TEXT_H
#define JSON_TEXT_H

#include <stdio.h>

/* Prints text as a JSON string, quotes included. UTF-8 stays as it is. */
void json_text(FILE *file, const char *text);

#endif
