/* See link.h. Sources: libusb 1.0 (asynchronous transfers); FTDI AN_135, AN_232B-04 (latency, status bytes). */
#define _POSIX_C_SOURCE 200809L
#include "ft232h/link.h"

#include "find.h"
#include "ft232h/mpsse.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>

enum {
    BUFFER_SIZE = 32768,
    BUFFERS = 2,
    PACKET = 512, /* of a high-speed bulk endpoint; its first STATUS_BYTES are no data */
    STATUS_BYTES = 2,
    REQUEST_RESET = 0x00,
    REQUEST_LATENCY = 0x09,
    REQUEST_BIT_MODE = 0x0B,
    BIT_MODE_RESET = 0x0000,
    BIT_MODE_MPSSE = 0x0200,
    LATENCY_MS = 1,
    PORT_A = 1,
};

struct buffer {
    struct libusb_transfer *transfer;
    uint8_t *bytes;
    int under_way;
    int done; /* int, as libusb_handle_events_timeout_completed wants it */
};

struct ft232h_usb {
    libusb_context *usb;
    libusb_device_handle *handle;
    bool claimed;
    uint8_t in, out; /* endpoints */
    struct buffer buffers[BUFFERS];
    unsigned filling; /* the buffer that is filled next */
    size_t filled;
    uint32_t hz;
    uint8_t answers[PACKET];
    size_t answers_at, answers_end;
    int status;  /* first error */
    char *error; /* where its line is written */
};

static uint64_t now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000U + (uint64_t)now.tv_nsec / 1000000U;
}

/* How long to wait for a transfer: twice the time of all bytes that may be under way, and FT232H_WAIT_MS. */
static unsigned patience_ms(const struct ft232h_usb *link)
{
    return FT232H_WAIT_MS + (unsigned)(2ULL * BUFFERS * BUFFER_SIZE * 8 * 1000 / link->hz);
}

static int fail(struct ft232h_usb *link, int error, const char *what)
{
    if (link->status < 0) {
        return link->status;
    }
    link->status = ft232h_usb_status(error);
    switch (error) {
    case LIBUSB_ERROR_NO_DEVICE:
        ft232h_fail(link->error, 0, "FT232H: unplugged while %s; plug it in and start again", what);
        break;
    case LIBUSB_ERROR_TIMEOUT:
        ft232h_fail(link->error, 0, "FT232H: no answer within %u ms while %s; plug it in again", patience_ms(link),
                    what);
        break;
    case LIBUSB_ERROR_PIPE:
        ft232h_fail(link->error, 0, "FT232H: endpoint stalled while %s; plug it in again", what);
        break;
    case LIBUSB_ERROR_BUSY:
        ft232h_fail(link->error, 0, "FT232H: in use by another program; end that one");
        break;
    default:
        ft232h_fail(link->error, 0, "FT232H: %s while %s; plug it in again", libusb_strerror(error), what);
        break;
    }
    return link->status;
}

/* ---- transfers out ------------------------------------------------------------------------------ */

static int error_of(const struct libusb_transfer *transfer)
{
    switch (transfer->status) {
    case LIBUSB_TRANSFER_COMPLETED:
        return transfer->actual_length == transfer->length ? 0 : LIBUSB_ERROR_IO;
    case LIBUSB_TRANSFER_TIMED_OUT:
        return LIBUSB_ERROR_TIMEOUT;
    case LIBUSB_TRANSFER_STALL:
        return LIBUSB_ERROR_PIPE;
    case LIBUSB_TRANSFER_NO_DEVICE:
        return LIBUSB_ERROR_NO_DEVICE;
    default:
        return LIBUSB_ERROR_IO;
    }
}

static void LIBUSB_CALL transfer_done(struct libusb_transfer *transfer)
{
    struct buffer *buffer = transfer->user_data;
    buffer->done = 1;
}

/* Handles events until the buffer's transfer is done, at most for ms; returns whether it is. */
static bool await(struct ft232h_usb *link, struct buffer *buffer, unsigned ms)
{
    const uint64_t end = now_ms() + ms;
    while (!buffer->done && now_ms() < end) {
        struct timeval tick = {.tv_sec = 0, .tv_usec = 100000};
        if (libusb_handle_events_timeout_completed(link->usb, &tick, &buffer->done) == LIBUSB_ERROR_NO_DEVICE) {
            break;
        }
    }
    return buffer->done;
}

/* Takes the buffer back, or notes an error. The transfer's own time-out comes first. */
static int reclaim(struct ft232h_usb *link, struct buffer *buffer)
{
    if (!buffer->under_way) {
        return link->status;
    }
    if (!await(link, buffer, patience_ms(link) + FT232H_WAIT_MS)) {
        return fail(link, LIBUSB_ERROR_TIMEOUT, "sending");
    }
    buffer->under_way = 0;
    const int error = error_of(buffer->transfer);
    return error < 0 ? fail(link, error, "sending") : link->status;
}

int ft232h_link_flush(struct ft232h_usb *link)
{
    struct buffer *buffer = &link->buffers[link->filling];
    if (link->status < 0 || link->filled == 0) {
        return link->status;
    }
    libusb_fill_bulk_transfer(buffer->transfer, link->handle, link->out, buffer->bytes, (int)link->filled,
                              transfer_done, buffer, patience_ms(link));
    buffer->done = 0;
    const int error = libusb_submit_transfer(buffer->transfer);
    if (error < 0) {
        return fail(link, error, "sending");
    }
    buffer->under_way = 1;
    link->filled = 0;
    link->filling = (link->filling + 1) % BUFFERS;
    return HAL_OK;
}

int ft232h_link_put(struct ft232h_usb *link, const uint8_t *bytes, size_t n)
{
    int status = link->status;
    while (n > 0 && status == HAL_OK) {
        struct buffer *buffer = &link->buffers[link->filling];
        status = reclaim(link, buffer);
        const size_t room = BUFFER_SIZE - link->filled;
        const size_t piece = n < room ? n : room;
        if (status == HAL_OK) {
            memcpy(buffer->bytes + link->filled, bytes, piece);
            link->filled += piece;
            bytes += piece;
            n -= piece;
            status = link->filled == BUFFER_SIZE ? ft232h_link_flush(link) : HAL_OK;
        }
    }
    return status;
}

void ft232h_link_pace(struct ft232h_usb *link, uint32_t hz)
{
    link->hz = hz;
}

/* ---- answers ------------------------------------------------------------------------------------ */

/* Notes the errors of transfers that have ended meanwhile, for no answer comes after them. */
static void reap(struct ft232h_usb *link)
{
    for (unsigned i = 0; i < BUFFERS; i++) {
        if (link->buffers[i].under_way && link->buffers[i].done) {
            reclaim(link, &link->buffers[i]);
        }
    }
}

int ft232h_link_get(struct ft232h_usb *link, uint8_t *bytes, size_t n)
{
    const unsigned patience = patience_ms(link);
    const uint64_t end = now_ms() + patience;
    while (link->status == HAL_OK && n > 0) {
        int got = 0;
        if (link->answers_at < link->answers_end) {
            *bytes++ = link->answers[link->answers_at++];
            n--;
            continue;
        }
        const int error = libusb_bulk_transfer(link->handle, link->in, link->answers, PACKET, &got, FT232H_WAIT_MS);
        if (error < 0 && error != LIBUSB_ERROR_TIMEOUT) {
            return fail(link, error, "waiting for an answer");
        }
        reap(link);
        link->answers_at = STATUS_BYTES;
        link->answers_end = got > STATUS_BYTES ? (size_t)got : STATUS_BYTES;
        if (got <= STATUS_BYTES && now_ms() >= end) {
            return fail(link, LIBUSB_ERROR_TIMEOUT, "waiting for an answer");
        }
    }
    return link->status;
}

/* ---- open and close ----------------------------------------------------------------------------- */

static int request(struct ft232h_usb *link, uint8_t number, uint16_t value)
{
    const uint8_t type = (int)LIBUSB_REQUEST_TYPE_VENDOR | (int)LIBUSB_RECIPIENT_DEVICE | (int)LIBUSB_ENDPOINT_OUT;
    const int error = libusb_control_transfer(link->handle, type, number, value, PORT_A, NULL, 0, FT232H_WAIT_MS);
    return error < 0 ? fail(link, error, "setting it up") : HAL_OK;
}

static int find_endpoints(struct ft232h_usb *link)
{
    struct libusb_config_descriptor *config = NULL;
    const int error = libusb_get_active_config_descriptor(libusb_get_device(link->handle), &config);
    if (error < 0) {
        return fail(link, error, "reading its descriptors");
    }
    const struct libusb_interface_descriptor *port = config->interface[0].altsetting;
    for (int i = 0; i < port->bNumEndpoints; i++) {
        const uint8_t address = port->endpoint[i].bEndpointAddress;
        *((address & LIBUSB_ENDPOINT_IN) != 0 ? &link->in : &link->out) = address;
    }
    libusb_free_config_descriptor(config);
    return link->in != 0 && link->out != 0 ? HAL_OK : fail(link, LIBUSB_ERROR_IO, "looking for its endpoints");
}

static int take_buffers(struct ft232h_usb *link)
{
    for (unsigned i = 0; i < BUFFERS; i++) {
        link->buffers[i].transfer = libusb_alloc_transfer(0);
        link->buffers[i].bytes = malloc(BUFFER_SIZE);
        if (link->buffers[i].transfer == NULL || link->buffers[i].bytes == NULL) {
            return fail(link, LIBUSB_ERROR_NO_MEM, "taking buffers");
        }
    }
    return HAL_OK;
}

static int claim(struct ft232h_usb *link)
{
    libusb_set_auto_detach_kernel_driver(link->handle, 1); /* ftdi_sio; where it is missing that is no error */
    const int error = libusb_claim_interface(link->handle, 0);
    link->claimed = error == 0;
    return error < 0 ? fail(link, error, "claiming it") : HAL_OK;
}

/* Sends a command that does not exist. When its echo comes back the engine runs, and old answers are gone. */
static int start_engine(struct ft232h_usb *link)
{
    const uint8_t bad = MPSSE_BAD;
    uint8_t seen[2] = {0, 0};
    int status = request(link, REQUEST_RESET, 0);
    status = status < 0 ? status : request(link, REQUEST_LATENCY, LATENCY_MS);
    status = status < 0 ? status : request(link, REQUEST_BIT_MODE, BIT_MODE_RESET);
    status = status < 0 ? status : request(link, REQUEST_BIT_MODE, BIT_MODE_MPSSE);
    status = status < 0 ? status : ft232h_link_put(link, &bad, 1);
    status = status < 0 ? status : ft232h_link_flush(link);
    for (unsigned i = 0; status == HAL_OK && i < PACKET && (seen[0] != MPSSE_BAD_ECHO || seen[1] != MPSSE_BAD); i++) {
        seen[0] = seen[1];
        status = ft232h_link_get(link, &seen[1], 1);
    }
    return status < 0 || seen[0] == MPSSE_BAD_ECHO ? status : fail(link, LIBUSB_ERROR_IO, "starting its engine");
}

int ft232h_link_open(struct ft232h_usb **link_out, const char *serial, char *error)
{
    struct ft232h_usb *link = calloc(1, sizeof *link);
    *link_out = NULL;
    if (link == NULL) {
        return ft232h_fail(error, HAL_EIO, "FT232H: no memory");
    }
    link->error = error;
    link->hz = 1000000;
    const int failed = libusb_init(&link->usb);
    int status = failed < 0 ? fail(link, failed, "starting libusb") : HAL_OK;
    status = status < 0 ? status : ft232h_usb_find(link->usb, serial, &link->handle, error);
    status = status < 0 ? status : find_endpoints(link);
    status = status < 0 ? status : take_buffers(link);
    status = status < 0 ? status : claim(link);
    status = status < 0 ? status : start_engine(link);
    if (status < 0) {
        ft232h_link_close(link);
        return status;
    }
    *link_out = link;
    return HAL_OK;
}

static void free_buffer(struct ft232h_usb *link, struct buffer *buffer)
{
    if (buffer->under_way && !buffer->done) {
        libusb_cancel_transfer(buffer->transfer);
        if (!await(link, buffer, FT232H_WAIT_MS)) {
            return; /* libusb still uses it, so it must not be freed */
        }
    }
    libusb_free_transfer(buffer->transfer);
    free(buffer->bytes);
}

void ft232h_link_close(struct ft232h_usb *link)
{
    if (link == NULL) {
        return;
    }
    for (unsigned i = 0; i < BUFFERS; i++) {
        free_buffer(link, &link->buffers[i]);
    }
    if (link->claimed) {
        request(link, REQUEST_BIT_MODE, BIT_MODE_RESET);
        libusb_release_interface(link->handle, 0); /* gives it back to ftdi_sio */
    }
    if (link->handle != NULL) {
        libusb_close(link->handle);
    }
    if (link->usb != NULL) {
        libusb_exit(link->usb);
    }
    free(link);
}

const char *ft232h_libusb_version(char text[FT232H_VERSION_SIZE])
{
    const struct libusb_version *version = libusb_get_version();
    snprintf(text, FT232H_VERSION_SIZE, "%u.%u.%u", version->major, version->minor, version->micro);
    return text;
}
