/*
 * The image of the depth lab measures on the microcontroller itself. It asks on the log UART for near, far and a
 * format, prints the tables (lab_request.h), and asks again; `end` ends it. `pinhole-depth compare` compares a log of
 * it with the host, byte for byte. It needs no panel.
 */
#include "lab_request.h"
#include "port.h"

static void put(void *context, const char *text) /* called as put */
{
    (void)context;
    port_log(text);
}

/* Reads a line without its end; what is too long for it is cut off. */
static void read_line(char *line, uint32_t size)
{
    uint32_t n = 0;
    for (;;) {
        const int byte = port_log_read();
        if (byte == '\n' || byte == '\r') {
            break;
        }
        if (byte >= 0 && n < size - 1) {
            line[n++] = (char)byte;
        }
    }
    line[n] = '\0';
}

int main(void)
{
    static uint64_t memory[2048]; /* 16 KiB: a microcontroller can spare so much */
    char line[64];
    for (;;) {
        port_log("near [m], far [m], format (or all), like 0.1 1000 float16; or end\n");
        read_line(line, sizeof line);
        if (line[0] == 'e' && line[1] == 'n' && line[2] == 'd') {
            break;
        }
        const int status = lab_request(line, memory, sizeof memory, put, NULL);
        if (status == PH_ERR_INVAL && line[0] != '\0') {
            port_log("no such request\n");
        }
    }
    port_exit(0);
    return 0;
}
