/*
 * lab_request: what a microcontroller that runs the depth lab is asked for in a line of text, and what it answers. The
 * host program runs the same request and compares the bytes (pinhole-depth compare).
 *
 * Request: near and far plane in metres and a format of lab_formats.h, or `all`: "0.1 1000 float16".
 * Answer:  "> 0.1 1000 float16", the tables of lab_pairs (LAB_REQUEST_COUNT pairs, linear) and of lab_resolve, "done".
 */
#ifndef LAB_REQUEST_H
#define LAB_REQUEST_H

#include "lab.h"

#define LAB_REQUEST_COUNT 500
#define LAB_REQUEST_MARK  "> "

/* Answers a request. 0, PH_ERR_INVAL: the line is no request; nothing was put. PH_ERR_NOMEM: memory is too small for
 * the tables. */
int lab_request(const char *line, void *memory, size_t memory_bytes, lab_put *put, void *context);

#endif
