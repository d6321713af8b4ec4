#!/usr/bin/env bash
# The virtual board's USB devices (tests/guest/usb_*.c): flashrom and libusb take them for an FT232H and an RP2040 in its
# boot loader, and their faults show.
# shellcheck disable=SC2317,SC2016 # functions are called by check; $GUEST and $i are the guest's
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/guest/virtual_board.sh
guest_begin "the virtual USB devices" libusb-1.0

check "the devices compile without a warning" guest_build

cat >"$dir/in_guest" <<'EOT'
. tests/guest/virtual_board.sh
cd $GUEST
modprobe ftdi_sio # as on a desktop: somebody has the device already
# A command of PICOBOOT in hexadecimal: id, size of arguments, bytes of data, arguments (32 bits each).
picoboot() {
    local text word
    text=0bd11f4301000000$(printf '%02x%02x0000' "$1" "$2")
    for word in "${@:3}"; do
        text+=$(printf '%02x%02x%02x%02x' $((word & 255)) $((word >> 8 & 255)) $((word >> 16 & 255)) $((word >> 24 & 255)))
    done
    printf '%-64s' "$text" | tr ' ' 0
}
ftdi() { usb_try 0403:6014 "$@"; }
boot() { usb_try 2e8a:0003 BOOT "$@"; }
mpsse="tell:0x40:0x0b:0x020b:1 out:2:80080b8a8600008209ff in:0x81:64"

head -c 131072 /dev/urandom >chip
usb_plug ft232h --serial CHIP --flash chip --events chip.events
ls /dev/ttyUSB* >ttys
if command -v flashrom >/dev/null; then
    flashrom -p ft2232_spi:type=232H -c W25X10 -r chip.read >flashrom 2>&1
    flashrom -p ft2232_spi:type=232H >flashrom.all 2>&1
fi
ftdi CHIP $mpsse out:2:ab87 in:0x81:64 out:2:1102002a00ef260387 in:0x81:64 tell:0x40:0x77:0:1 >odd
kill $usb_device && wait $usb_device
i=0
for fault in unplug stall hang short; do
    usb_plug ft232h --serial $fault --$fault-after 20
    faulty="$faulty $usb_device"
done
ftdi list | sort >serials
for fault in unplug stall hang short; do
    ftdi $fault $mpsse out:2:110300010203 fill:2:100 out:2:87 >$fault
done
ftdi list | sort >serials.after
kill $faulty 2>/dev/null; wait

usb_plug ft232h --serial SLOW --wire-time --events slow.events
ftdi SLOW tell:0x40:0x0b:0x020b:1 out:2:8a86db05 'out:2:11c700' fill:2:200 out:2:87 in:0x81:64 >slow
kill $usb_device && wait

usb_plug bootsel --serial BOOT --flash flash
boot out:3:$(picoboot 1 1 0 1) in:0x84:64 >exclusive
boot out:3:$(picoboot 3 8 0 0x10001000 4096) in:0x84:64 >erase
boot out:3:$(picoboot 5 8 256 0x10001000 256) fill:3:256 in:0x84:64 >write
boot out:3:$(picoboot 0x84 8 4 0x10001000 4) in:0x84:64 out:3: out:3:$(picoboot 0x84 8 4 0x10001100 4) in:0x84:64 out:3: >read
refused() { # file, command
    boot out:3:$2 in:0x84:64 >$1
    boot ask:0xc1:0x42:0:1:16 tell:0x41:0x41:0:1 clear:0x84 clear:0x03 ask:0xc1:0x42:0:1:16 >>$1
}
refused unaligned $(picoboot 3 8 0 0x10001001 4096)
refused outside $(picoboot 3 8 0 0x10200000 4096)
refused unknown $(picoboot 9 0 0)
refused length $(picoboot 5 8 255 0x10001000 256)
boot out:3:$(picoboot 0x84 8 4 0x10 4) in:0x84:64 out:3: >rom
boot out:3:$(picoboot 2 12 0 0 0 100) in:0x84:64 >reboot
wait $usb_device
usb_try 2e8a:0003 list >after_reboot
usb_plug bootsel --serial BOOT --flash flash --unplug-after 100
boot out:3:$(picoboot 3 8 0 0x10000000 4096) in:0x84:64 out:3:$(picoboot 5 8 256 0x10000000 256) fill:3:256 >pulled
EOT
guest_run --icount --timeout 2500 --out "$dir/guest" -- bash "$dir/in_guest" >"$dir/log" 2>&1
cd "$dir/guest" || exit 1

# The file has these lines.
says() { diff <(printf '%s\n' "${@:2}") "$1"; }

check "a serial port driver takes the FT232H" grep -q ttyUSB0 ttys
if command -v flashrom >/dev/null || [ -x /usr/sbin/flashrom ]; then
    check "flashrom finds the flash chip behind it" grep -q 'Found Winbond flash chip "W25X10"' flashrom
    check "... among all that it knows" grep -q 'Found Winbond flash chip "W25X10"' flashrom.all
    check "... and reads it unchanged" cmp chip chip.read
else
    skip "flashrom finds the flash chip behind it" "no flashrom"
fi
check "an unknown command echoes, and an unknown request stalls" says odd 'tell ' 'out 10' 'in 3260' 'out 2' 'in 3260faab' \
    'out 9' 'in 3260ff' 'tell LIBUSB_ERROR_PIPE'
check "pins and bytes are told" grep -q '^[0-9]* spi - 30000000 30000000 0 8 9fc 9fc [0-9]* 2a00ef$' chip.events
check "several devices are told apart by their serial numbers" says serials hang short stall unplug
check "unplugged: no device" says unplug 'tell ' 'out 10' 'in 3260' 'out 6' 'fill LIBUSB_ERROR_NO_DEVICE'
check "... and it is gone from the list" says serials.after hang short stall
check "a stall" says stall 'tell ' 'out 10' 'in 3260' 'out 6' 'fill LIBUSB_ERROR_PIPE'
check "a time-out" says hang 'tell ' 'out 10' 'in 3260' 'out 6' 'fill LIBUSB_ERROR_TIMEOUT'
check "a short transfer" says short 'tell ' 'out 10' 'in 3260' 'out 6' 'fill 50' 'out 1'
check "bits take their time when asked: 200 bytes at 20 kHz" \
    awk '$2 == "spi" { if ($5 != 20000) exit 1; ns += $10 - $1 } END { exit ns != 80000000 }' slow.events

check "PICOBOOT: exclusive access" says exclusive 'out 32' 'in '
check "... erase" says erase 'out 32' 'in '
check "... write" says write 'out 32' 'fill 256' 'in '
check "... read" says read 'out 32' 'in 00000000' 'out 0' 'out 32' 'in ffffffff' 'out 0'
check "... the boot ROM's magic" says rom 'out 32' 'in 4d750103' 'out 0'
check "an unaligned erase is refused until the interface is reset" says unaligned 'out 32' 'in LIBUSB_ERROR_PIPE' \
    'ask 01000000050000000300000000000000' 'tell ' 'ask 01000000000000000300000000000000'
check "... one outside of the flash" says outside 'out 32' 'in LIBUSB_ERROR_PIPE' \
    'ask 01000000040000000300000000000000' 'tell ' 'ask 01000000000000000300000000000000'
check "... an unknown command" grep -qx 'ask 01000000010000000900000000000000' unknown
check "... a length that contradicts itself" grep -qx 'ask 01000000030000000500000000000000' length
check "reboot: the board leaves" says reboot 'out 32' 'in '
check "... for good" test ! -s after_reboot
check "a board that is pulled in the middle of a write" says pulled 'out 32' 'in ' 'out 32' 'fill LIBUSB_ERROR_NO_DEVICE'
check "... has taken the bytes before" test "$(head -c 4196 flash | tail -c +4097 | od -An -tx1 -v | tr -d ' \n')" = \
    "$(head -c 200 /dev/zero | tr '\0' 0)"
check "... and its flash is otherwise as it was" \
    test "$(head -c 4096 flash | tr -d '\377' | wc -c) $(tail -c +4353 flash | tr -d '\377' | wc -c)" = '36 0'
[ "$tap_failed" = 0 ] || sed 's/^/# guest: /' "$dir/log"
tap_end
