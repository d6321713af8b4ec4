/*
 * self_test: what people report of a kit with its glass, as text to paste. On an open runner it measures the frames a
 * second of the turntable, draws the cube and the test card without sending them, and compares their CRCs with a table
 * of known ones (self_test.c; sizes of the panels in panels.h). It leaves the test card on the glass.
 *
 * A CRC is of the picture as the renderer drew it, before the panel's format, as RGB888 rows: what
 * `pinhole-sim --size WxH --demo NAME --frames 1 --crc` prints.
 */
#ifndef SELF_TEST_H
#define SELF_TEST_H

#include "runner.h"

/* Where the text of the report goes. The end of a line comes alone, as "\n". */
typedef void self_test_put(const char *text);

/* `machine` is what it runs on, in a few words. Returns how many CRCs are not the known ones, or an error of the runner
 * (PH_ERR_.., HAL_E..); then the text says that the test did not end. */
int self_test_report(struct runner *runner, const char *machine, self_test_put *put);

#endif
