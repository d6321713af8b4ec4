/* kms_fail: one line for people about an error. Private to hal/kms. */
#ifndef HAL_KMS_FAIL_H
#define HAL_KMS_FAIL_H

#include "kms_card.h"

/* Writes the line, with what Linux' errno `number` means (0: nothing more), and returns its name in hal.h. */
int kms_fail(char error[KMS_ERROR_SIZE], int number, const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
