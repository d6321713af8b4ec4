/* See kms_card.h. Built without libdrm: there is no card. */
#include "../kms_card.h"

#include "hal.h"

#include <stddef.h>
#include <stdio.h>

int kms_card_open(struct kms_card **out, const char *where, char error[KMS_ERROR_SIZE])
{
    (void)where;
    *out = NULL;
    snprintf(error, KMS_ERROR_SIZE,
             "this pinhole-panel was built without libdrm: install libdrm-dev and run make again");
    return HAL_ENOSYS;
}

void kms_card_size(const struct kms_card *card, uint32_t *width, uint32_t *height)
{
    (void)card;
    *width = *height = 0;
}

/* NOLINTNEXTLINE(readability-non-const-parameter): kms_card.h has the type. */
int kms_card_take(struct kms_card *card, char error[KMS_ERROR_SIZE])
{
    (void)card, (void)error;
    return HAL_ENOSYS;
}

struct kms_buffer kms_card_buffer(const struct kms_card *card, bool *keeps)
{
    (void)card;
    *keeps = false;
    return (struct kms_buffer){NULL, 0};
}

/* NOLINTNEXTLINE(readability-non-const-parameter): kms_card.h has the type. */
int kms_card_show(struct kms_card *card, const struct kms_clip *clips, uint32_t count, char error[KMS_ERROR_SIZE])
{
    (void)card, (void)clips, (void)count, (void)error;
    return HAL_ENOSYS;
}

void kms_card_close(struct kms_card *card)
{
    (void)card;
}

void kms_card_list(void (*tell)(const char *name, uint32_t width, uint32_t height))
{
    (void)tell;
}
