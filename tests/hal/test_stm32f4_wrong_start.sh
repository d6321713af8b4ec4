#!/usr/bin/env bash
# Wrong writes in the start and the DMA of the STM32F405's port, which QEMU's chip does not reach: it has neither crystal nor
# PLL nor DMA. test_stm32f4_dma runs each on a model of the registers, and must say which of them refuses it. Those that QEMU
# reaches are in wrong_writes/stm32f4.txt.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
port=hal/stm32f4/stm32f4.c
pkg-config --exists cmocka || { echo "no cmocka: apt-get install libcmocka-dev" && exit 77; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

said_with() { # the port's source
    rm -f "$dir/said"
    # shellcheck disable=SC2046 # flags are words
    "${CC:-cc}" -std=c11 -Ihal -Iboards -I"$B/boards_all" -Ihost-sim/emulate -DPORT_C="\"$1\"" -o "$dir/test" tests/hal/test_stm32f4_dma.c "$B/libpinhole-tools.a" "$B/libpinhole-hal.a" \
        $(pkg-config --cflags --libs cmocka) >"$dir/built" 2>&1 || { cat "$dir/built" && return 1; }
    "$dir/test" >"$dir/said" 2>&1
}

the_port_itself_passes() { make -s -j2 B="$B" "$B/libpinhole-tools.a" "$B/libpinhole-hal.a" && said_with "$PWD/$port"; }

is_refused() { # sed expression
    sed "$1" "$port" >"$dir/wrong.c" || return 1
    cmp -s "$port" "$dir/wrong.c" && echo "the expression changes nothing" && return 1
    said_with "$dir/wrong.c" && echo "it passes" && return 1
    [ -e "$dir/said" ] && grep -q '(RM0090, [0-9.]*)' "$dir/said" && return
    tail -n 5 "$dir/said"
    return 1
}

check "the_port_itself_passes" the_port_itself_passes
# What is wrong | sed expression
while IFS= read -r line; do
    check "refused: ${line%% | *}" is_refused "${line#* | }"
done <<'EOT'
a reserved field of PLLCFGR is cleared | s/PLLCFGR_KEPT | //
the PLL is on before its crystal is stable | s/if (!ready(1U << 17))/if (0)/
the PLL is the clock before it has locked | s/if (!ready(1U << 25))/if (0)/
PLLCFGR is written while the PLL is on | s/RCC_PLLCFGR = /RCC_CR |= 1U << 24; RCC_PLLCFGR = /
a multiplier for 216 MHz | s/336U << 6/432U << 6/
the PLL's source is the internal oscillator | s/7U << 24 | 1U << 22/7U << 24/
APB1 gets 84 MHz | s/4U << 13 | 5U << 10/4U << 13 | 4U << 10/
too few wait states | s/FLASH_ACR = 0x705;/FLASH_ACR = 0x703;/; s/(FLASH_ACR & 7) != 5/(FLASH_ACR \& 7) != 3/
the clock rises before the wait states are in force | s/while ((FLASH_ACR & 7) != 5)/if (0)/
the stream is set up while it runs | s/^    dma_stop();$//
a stream's fields change with EN | s/DMA_CR &= ~DMA_EN;/DMA_CR = 0;/
the flags of the last transfer are left | s/DMA_HIFCR = DMA_FLAGS;//
another channel's stream | s/DMA_CR = 1U << 10/DMA_CR = 1U << 25 | 1U << 10/
the SPI asks before the stream is on | s/DMA_CR |= DMA_EN;/SPI_CR2 = 2;/
the SPI is turned off while the last byte is on the wire | /^static void stm32f4_close/,/^}/s/stm32f4_bus_wait(context);//
EOT
tap_end
