/* See port.h: the log on UART0, 115200 8N1, TX GP0, RX GP1. All boards leave these pins free. */
#include "port.h"
#include "chips/pl011.h"
#include <registers.h>
#include "rp2.h"

enum { UART_TX_PIN = 0, UART_RX_PIN = 1, FR_RXFE = 1 << 4, FR_TXFF = 1 << 5 };

void rp2_uart_init(void)
{
    const uint32_t divisor64 = (CLK_PERI_HZ * 4U + 115200 / 2) / 115200; /* CLK / (16 x 115200), 6 fraction bits */
    REG(UART0_IBRD) = divisor64 / 64;
    REG(UART0_FBRD) = divisor64 % 64;
    REG(UART0_LCR_H) = 3 << 5 | 1 << 4;  /* 8 bits, FIFOs */
    REG(UART0_CR) = 1 << 9 | 1 << 8 | 1; /* receive, transmit, on */
    REG(PADS_BANK0(UART_TX_PIN)) = PAD_SCHMITT | PAD_8_MA | PAD_INPUT;
    rp2_pin_function(UART_TX_PIN, FUNCTION_UART);
    rp2_pin_input(UART_RX_PIN);
    rp2_pin_function(UART_RX_PIN, FUNCTION_UART);
}

void port_log(const char *text) /* called as put */
{
    for (; *text != '\0'; text++) {
        while ((REG(UART0_FR) & FR_TXFF) != 0) {
        }
        REG(UART0_DR) = (uint8_t)*text;
    }
}

int port_log_read(void)
{
    return (REG(UART0_FR) & FR_RXFE) != 0 ? -1 : pl011_byte(REG(UART0_DR));
}
