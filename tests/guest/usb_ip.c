/*
 * The device's end of USB/IP, as Documentation/usb/usbip_protocol.rst of the kernel describes it: 48-byte headers, big
 * endian. Standard requests are answered here.
 */
#define _GNU_SOURCE
#include "usb.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#define VHCI       "/sys/devices/platform/vhci_hcd.0/attach"
#define VHCI_PORTS 15
#define URBS       64

enum { SUBMIT = 1, UNLINK = 2, SUBMITTED = 3, UNLINKED = 4 };
enum {
    GET_STATUS = 0,
    CLEAR_FEATURE = 1,
    GET_DESCRIPTOR = 6,
    GET_CONFIGURATION = 8,
    SET_CONFIGURATION = 9,
    GET_INTERFACE = 10
};

/* What is on the wire, in the host's order once read. */
struct header {
    uint32_t command, sequence, device, direction, endpoint;
    union {
        struct {
            uint32_t flags, length, start, packets, interval;
            uint8_t setup[8];
        } submit;
        struct {
            uint32_t status, length, start, packets, errors;
            uint8_t padding[8];
        } submitted;
        struct {
            uint32_t sequence;
        } unlink;
        uint8_t all[28];
    } u;
};

struct urb {
    struct header header;
    uint8_t *data; /* to the device; NULL: none */
    uint64_t since_ns;
};

struct bus {
    struct usb_device *device;
    struct usb_fault fault;
    const char *ready;
    int socket;
    uint8_t configuration;
    uint64_t out_bytes;
    struct urb urbs[URBS]; /* bulk transfers under way, oldest first */
    unsigned urb_count;
};

static volatile sig_atomic_t terminated;

static void note_signal(int number)
{
    terminated = number;
}

uint64_t usb_now_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000 + (uint64_t)now.tv_nsec;
}

/* ---- the socket --------------------------------------------------------------------------------- */

static bool receive(int socket, void *to, size_t n)
{
    uint8_t *bytes = to;
    while (n > 0 && !terminated) {
        const ssize_t got = recv(socket, bytes, n, 0);
        if (got == 0 || (got < 0 && errno != EINTR)) {
            return false;
        }
        bytes += got > 0 ? got : 0;
        n -= got > 0 ? (size_t)got : 0;
    }
    return n == 0;
}

static bool transmit(int socket, const void *from, size_t n)
{
    const uint8_t *bytes = from;
    while (n > 0) {
        const ssize_t sent = send(socket, bytes, n, MSG_NOSIGNAL);
        if (sent < 0 && errno != EINTR) {
            return false;
        }
        bytes += sent > 0 ? sent : 0;
        n -= sent > 0 ? (size_t)sent : 0;
    }
    return true;
}

/* The five words that all headers have, and five more. */
static void swap_words(struct header *h)
{
    uint32_t words[10];
    memcpy(words, h, sizeof words);
    for (int i = 0; i < 10; i++) {
        words[i] = ntohl(words[i]);
    }
    memcpy(h, words, sizeof words);
}

static bool answer(const struct bus *bus, const struct header *to, int status, const uint8_t *data, uint32_t length)
{
    struct header h = {.command = SUBMITTED, .sequence = to->sequence};
    h.u.submitted.status = status < 0 ? (uint32_t)status : 0;
    h.u.submitted.length = length;
    swap_words(&h);
    return transmit(bus->socket, &h, sizeof h) && (data == NULL || transmit(bus->socket, data, length));
}

/* ---- control requests --------------------------------------------------------------------------- */

static int string_descriptor(const struct usb_device *device, unsigned index, uint8_t *data)
{
    if (index == 0) {
        memcpy(data, "\x04\x03\x09\x04", 4); /* English (United States) */
        return 4;
    }
    if (index > 3 || device->strings[index] == NULL) {
        return -EPIPE;
    }
    const size_t n = strlen(device->strings[index]);
    data[0] = (uint8_t)(2 + 2 * n);
    data[1] = 3;
    for (size_t i = 0; i < n; i++) {
        data[2 + 2 * i] = (uint8_t)device->strings[index][i];
        data[3 + 2 * i] = 0;
    }
    return data[0];
}

static int descriptor(const struct usb_device *device, const uint8_t setup[8], uint8_t *data)
{
    switch (setup[3]) {
    case 1:
        memcpy(data, device->device, 18);
        return 18;
    case 2: {
        const int n = device->config[2] | device->config[3] << 8;
        memcpy(data, device->config, (size_t)n);
        return n;
    }
    case 3:
        return string_descriptor(device, setup[2], data);
    case 6: /* what it would be at the other speed: nothing else */
        if (device->speed != 3) {
            return -EPIPE;
        }
        memcpy(data, (const uint8_t[]){10, 6, 0, 2, 0, 0, 0, 64, 1, 0}, 10);
        return 10;
    default:
        return -EPIPE;
    }
}

static void make_ready(struct bus *bus)
{
    if (bus->ready != NULL) {
        const int file = open(bus->ready, O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
        close(file);
    }
}

static int standard(struct bus *bus, const uint8_t setup[8], uint8_t *data)
{
    switch (setup[1]) {
    case GET_STATUS:
        data[0] = data[1] = 0;
        return 2;
    case GET_DESCRIPTOR:
        return descriptor(bus->device, setup, data);
    case GET_CONFIGURATION:
        data[0] = bus->configuration;
        return 1;
    case SET_CONFIGURATION:
        bus->configuration = setup[2];
        make_ready(bus);
        return 0;
    case GET_INTERFACE:
        data[0] = 0;
        return 1;
    case CLEAR_FEATURE:
        if ((setup[0] & 31) == 2 && bus->device->unhalt != NULL) {
            bus->device->unhalt(bus->device->context, setup[4]);
        }
        return 0;
    default:
        return 0;
    }
}

static bool control(struct bus *bus, const struct header *h)
{
    uint8_t data[65536] = {0};
    const uint8_t *setup = h->u.submit.setup;
    const bool in = (setup[0] & 0x80) != 0;
    const uint32_t room = h->u.submit.length < sizeof data ? h->u.submit.length : sizeof data;
    if (!in && !receive(bus->socket, data, room)) {
        return false;
    }
    int n = (setup[0] & 0x60) == 0 ? standard(bus, setup, data)
                                   : bus->device->control(bus->device->context, setup, data, (int)room);
    if (n > (int)room) {
        n = (int)room;
    }
    return in && n >= 0 ? answer(bus, h, 0, data, (uint32_t)n) : answer(bus, h, n, NULL, n < 0 ? 0 : room);
}

/* ---- bulk transfers ----------------------------------------------------------------------------- */

/* What the fault makes of n bytes from the host: how many of them arrive; *status is what follows, if it strikes. */
static int strike(struct bus *bus, int n, int *status)
{
    static const int follows[] = {
        [USB_FAULT_UNPLUG] = USB_UNPLUG, [USB_FAULT_STALL] = -EPIPE, [USB_FAULT_HANG] = USB_WAIT};
    *status = 0;
    if (bus->fault.kind == USB_FAULT_NONE || bus->out_bytes + (uint64_t)n <= bus->fault.after) {
        return n;
    }
    const int left = bus->fault.after > bus->out_bytes ? (int)(bus->fault.after - bus->out_bytes) : 0;
    if (bus->fault.kind == USB_FAULT_SHORT) {
        return n > 1 ? n / 2 : n;
    }
    *status = follows[bus->fault.kind];
    return left;
}

/* A count, a negative errno, USB_WAIT or USB_UNPLUG. */
static int send_out(struct bus *bus, const struct urb *urb)
{
    int status = 0;
    const int n = strike(bus, (int)urb->header.u.submit.length, &status);
    int taken = 0;
    if (n > 0 || urb->header.u.submit.length == 0) {
        taken = bus->device->out(bus->device->context, urb->header.endpoint, urb->data, n);
    }
    bus->out_bytes += taken > 0 ? (uint64_t)taken : 0;
    return status != 0 ? status : taken; /* half a command is refused, but the fault came first */
}

static bool is_blocked(const struct bus *bus, unsigned i)
{
    for (unsigned j = 0; j < i; j++) {
        const struct header *a = &bus->urbs[i].header, *b = &bus->urbs[j].header;
        if (a->endpoint == b->endpoint && a->direction == b->direction) {
            return true;
        }
    }
    return false;
}

static void forget(struct bus *bus, unsigned i)
{
    free(bus->urbs[i].data);
    bus->urb_count--;
    memmove(&bus->urbs[i], &bus->urbs[i + 1], (bus->urb_count - i) * sizeof bus->urbs[0]);
}

/* 1: the transfer is over, 0: it is not, -1: so is the device. */
static int try_urb(struct bus *bus, const struct urb *urb)
{
    static uint8_t data[1 << 20];
    const struct header *h = &urb->header;
    const unsigned waited = (unsigned)((usb_now_ns() - urb->since_ns) / 1000000);
    const uint32_t room = h->u.submit.length < sizeof data ? h->u.submit.length : sizeof data;
    const int n = h->direction != 0 ? bus->device->in(bus->device->context, h->endpoint, data, (int)room, waited)
                                    : send_out(bus, urb);
    if (n == USB_WAIT) {
        return 0;
    }
    if (n == USB_UNPLUG) {
        return -1;
    }
    return answer(bus, h, n, h->direction != 0 && n >= 0 ? data : NULL, n < 0 ? 0 : (uint32_t)n) ? 1 : -1;
}

static bool try_urbs(struct bus *bus)
{
    for (unsigned i = 0; i < bus->urb_count;) {
        struct urb *urb = &bus->urbs[i];
        const bool hangs = urb->header.direction == 0 && urb->data == NULL; /* has been taken, is never answered */
        const int over = hangs || is_blocked(bus, i) ? 0 : try_urb(bus, urb);
        if (over < 0) {
            return false;
        }
        if (over > 0) {
            forget(bus, i);
            continue;
        }
        if (!hangs && urb->header.direction == 0 && !is_blocked(bus, i)) {
            free(urb->data);
            urb->data = NULL;
        }
        i++;
    }
    return true;
}

static bool queue(struct bus *bus, const struct header *h)
{
    struct urb urb = {.header = *h, .since_ns = usb_now_ns()};
    if (bus->urb_count == URBS) {
        fprintf(stderr, "usb: more than %d transfers at a time\n", URBS);
        return false;
    }
    if (h->direction == 0) {
        urb.data = malloc(h->u.submit.length + 1);
        if (urb.data == NULL || !receive(bus->socket, urb.data, h->u.submit.length)) {
            free(urb.data);
            return false;
        }
    }
    bus->urbs[bus->urb_count++] = urb;
    return true;
}

static bool cancel(struct bus *bus, const struct header *h)
{
    struct header out = {.command = UNLINKED, .sequence = h->sequence};
    for (unsigned i = 0; i < bus->urb_count; i++) {
        if (bus->urbs[i].header.sequence == h->u.unlink.sequence) {
            out.u.submitted.status = (uint32_t)-ECONNRESET;
            forget(bus, i);
            break;
        }
    }
    swap_words(&out);
    return transmit(bus->socket, &out, sizeof out);
}

static bool serve(struct bus *bus)
{
    struct header h;
    if (!receive(bus->socket, &h, sizeof h)) {
        return false;
    }
    swap_words(&h);
    if (h.command == UNLINK) {
        return cancel(bus, &h);
    }
    if (h.endpoint == 0) {
        return control(bus, &h);
    }
    return queue(bus, &h);
}

/* ---- a life ------------------------------------------------------------------------------------- */

static int attach(const struct usb_device *device, int socket)
{
    const int file = open(VHCI, O_WRONLY | O_CLOEXEC);
    if (file < 0) {
        fprintf(stderr, "usb: %s: %s (modprobe vhci-hcd)\n", VHCI, strerror(errno));
        return -1;
    }
    for (int port = 0; port < VHCI_PORTS; port++) {
        char text[64];
        const int n = snprintf(text, sizeof text, "%d %d %d %u", port, socket, port + 1, device->speed);
        if (write(file, text, (size_t)n) == n) {
            close(file);
            return 0;
        }
    }
    fprintf(stderr, "usb: no free port: %s\n", strerror(errno));
    close(file);
    return -1;
}

int usb_run(struct usb_device *device, struct usb_fault fault, const char *ready)
{
    struct bus bus = {.device = device, .fault = fault, .ready = ready};
    const struct sigaction action = {.sa_handler = note_signal};
    int sockets[2];
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGINT, &action, NULL);
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0 || attach(device, sockets[0]) != 0) {
        return -1;
    }
    close(sockets[0]); /* it is the kernel's now */
    bus.socket = sockets[1];
    bool plugged = true;
    while (plugged && !terminated && !device->leaves) {
        struct pollfd wait = {.fd = bus.socket, .events = POLLIN};
        const int events = poll(&wait, 1, bus.urb_count > 0 ? 1 : -1);
        plugged = (events <= 0 || serve(&bus)) && try_urbs(&bus);
    }
    close(bus.socket);
    while (bus.urb_count > 0) {
        forget(&bus, 0);
    }
    return 0;
}
