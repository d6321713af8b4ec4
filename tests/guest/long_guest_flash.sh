#!/usr/bin/env bash
# pinhole-flash and a virtual RP2040 in its boot loader (tests/guest): the real program, libusb and kernel. The flash is
# compared byte by byte; each refusal is one line, spelt out here; what was cut off is completed by a second run.
# shellcheck disable=SC2317,SC2016 # functions are called by check; $GUEST is the guest's
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/guest/flash_in_guest.sh
guest_begin "pinhole-flash writes a virtual RP2040" libusb-1.0
chmod 755 "$dir" # somebody without rights reads the images, too
guest_build && make_images "$dir" a 50000 b 70001 large 700000 && make_rp2350_image "$dir" pico2 50000 || exit 1
head -c 2097152 /dev/urandom >"$dir/old"
printf '\177ELF\001\001\001' >"$dir/a.elf"
"$dir/uf2" 0x57755a57 0x08000000 "$dir/a.bin" "$dir/stm32.uf2"
"$dir/uf2" 0xe48bff56 0x20000000 "$dir/a.bin" "$dir/ram.uf2"
head -c 51200 "$dir/a.uf2" >"$dir/short.uf2"
make -s -j2 B="$B" "$B/pinhole-asset" && "$B/pinhole-asset" tests/host-sim/asset/surfaces.gltf --texture-size 16 -o "$dir/a.phs" && head -c 1000 "$dir/a.phs" >"$dir/half.phs" || exit 1
command -v arm-none-eabi-gcc >/dev/null && for app in demos depth; do # Pinhole's images, as a board has them
    make_image firmware BOARD=pico-display APP=$app >/dev/null && cp "$dir/old" "$dir/has-$app" &&
        dd if="$B/firmware/pico-display-$app.bin" of="$dir/has-$app" conv=notrunc status=none || exit 1
done

cat >"$dir/in_guest" <<EOT
images=$dir
EOT
cat >>"$dir/in_guest" <<'EOT'
. tests/guest/flash_in_guest.sh
cd $GUEST
for flash in uf2 pico2 pico2-bin bin kept small stalls cut int killed forced; do cp $images/old $flash; done
cp $images/has-* .
run none $images/a.uf2
run list-none --list
run_on uf2 uf2 "" $images/a.uf2
plug --flash bin
run bin $images/b.bin --no-reboot --no-verify
run list --list
run again $images/b.bin --serial E0C9125B0D9B
wait $usb_device
run left --list
plug --flash kept && one=$usb_device
run refuse-half.phs $images/half.phs --at-scene
run force $images/a.uf2 --force
for image in a.elf stm32.uf2 ram.uf2 short.uf2 nothing.uf2; do run refuse-$image $images/$image; done
run serial $images/a.uf2 --serial NONE
plug --flash kept
run two $images/a.uf2
run list-two --list
kill $one && wait $one
pull
for flash in has-demos has-depth kept erased; do
    run_on scene-$flash $flash "" $images/a.phs --at-scene
done
run_on forced forced "" $images/a.phs --at-scene --force
run_on small small "--flash-bytes 524288" $images/large.bin
run_on rp2350 kept "--product f" $images/a.uf2
run_on rp2040 kept "" $images/pico2.uf2
plug --flash kept && one=$usb_device
run_on pico2 pico2 "--product f" $images/pico2.uf2
plug --flash pico2 --product f
run list-pico2 --list
kill $one && wait $one
pull
run_on cut-pico2 pico2-bin "--product f --unplug-after 20000" $images/pico2.bin
run_on pico2-bin pico2-bin "--product f --stall-once" $images/pico2.bin
plug --flash kept && chmod 600 /dev/bus/usb/*/*
guest_wrap="setpriv --reuid 65534 --clear-groups" run nouser $images/a.uf2
guest_wrap="setpriv --reuid 65534 --clear-groups" run list-nouser --list
pull
plug --flash kept --hang-after 0
run hang $images/a.uf2 &
sleep 1
run busy $images/a.uf2
wait $!
pull
run_on stalls stalls --stall-once $images/a.uf2
run_on stall cut "--stall-after 5000" $images/a.uf2
run_on short cut "--short-after 5000" $images/a.uf2
for n in 0 50 20000 53000; do
    run_on cut-$n cut "--unplug-after $n" $images/b.uf2
done
run_on cut cut "" $images/b.uf2
run_signalled INT int INT $images/large.uf2
run_on int int "" $images/large.uf2
run_signalled KILL killed KILL $images/large.uf2
run_on killed killed "" $images/large.uf2
plug --flash uf2
script -qec "stty rows 24 cols 80; $B/pinhole-flash $images/a.uf2" /dev/null >terminal
pull
EOT
guest_run --icount --timeout 2500 --out "$dir/guest" -- bash "$dir/in_guest" >"$dir/log" 2>&1
guest_out=$dir/guest

again='plug it in with BOOTSEL held and run this again'
nothing='no RP2040 or RP2350 in its boot loader (2e8a:0003 or 2e8a:000f) on USB; plug it in with BOOTSEL held, or send B to the UART of a running image'
nobody='no RP2040 in its boot loader (2e8a:0003) on USB; plug it in with BOOTSEL held, or send B to the UART of a running image'
two="2 RP2040s match: @, @; choose one with --serial BUS:ADDRESS (their serial numbers are alike)"

flash_is() { # flash's name, image, zeros|erased
    holds "$guest_out/$1" "$dir/$2" "$3" "$dir/old"
}

refused() { # image, line
    ended "refuse-$1" 1 "$dir/$1: $2"
}

two_are_listed() {
    sed -i 's/[0-9]*:[0-9]* (E0C9125B0D9B)/@/g' "$guest_out/two.err"
    ended two 1 "$two" && [ "$(grep -c '^[0-9]*:[0-9]* E0C9125B0D9B RP2040$' "$guest_out/list-two.out")" = 2 ] &&
        [ "$(sort -u "$guest_out/list-two.out" | wc -l)" = 2 ] && ended list-two 0 ""
}

scene_is_behind() { # the flash before, after: from 0x10080000 on; its last sector is erased behind it, and the rest is as it was
    local bytes end
    bytes=$(stat -c %s "$dir/a.phs") end=$(((0x80000 + $(stat -c %s "$dir/a.phs") + 4095) / 4096 * 4096))
    cmp <(head -c $((0x80000)) "$1") <(head -c $((0x80000)) "$2") && cmp "$dir/a.phs" <(tail -c +$((0x80001)) "$2" | head -c "$bytes") &&
        cmp <(tail -c +$((end + 1)) "$1") <(tail -c +$((end + 1)) "$2")
}

# All the boards that were cut off, and one second run.
cut_is_completed() {
    local n
    for n in 0 50 20000 53000; do
        ended "cut-$n" 1 "$(sed 's/^pinhole-flash: RP2040 [0-9:]*: /RP2040 @: /' "$guest_out/cut-$n.err")" || return 1
        grep -Eq ': unplugged while (preparing|erasing|writing) 0x100[0-9a-f]{5}; '"$again\$" "$guest_out/cut-$n.err" || { cat "$guest_out/cut-$n.err" && return 1; }
    done
    ended cut 0 "" && flash_is cut b.bin zeros
}

stopped() { # name, status, flash
    [ "$(cat "$guest_out/$1.status")" = "$2" ] || { cat "$guest_out/$1.status" "$guest_out/$1.err" && return 1; }
    said "$1-list" '@ E0C9125B0D9B RP2040' && ended "$3" 0 "" && flash_is "$3" large.bin zeros
}

interrupt_is_one_line() {
    [ "$(wc -l <"$guest_out/INT.err")" = 1 ] &&
        grep -Eq ': stopped before (erasing|writing|reading back) 0x[0-9a-f]{8}; the board stays in its boot loader: run this again$' "$guest_out/INT.err"
}

a_terminal_shows_a_bar() {
    tr '\r' '\n' <"$guest_out/terminal" >"$dir/terminal"
    grep -Eq '^writing +\[#+ +\] +[0-9]+ %$' "$dir/terminal" && grep -Eq '^reading back +\[#+ +\] +[0-9]+ %$' "$dir/terminal" &&
        tail -n 2 "$dir/terminal" | grep -q '50176 bytes written, read back and equal, started'
}

check "a UF2 is written, read back and started" eval 'ended uf2 0 "" && said uf2 "RP2040 @: 50176 bytes written, read back and equal, started"'
check "... and the flash holds it, byte by byte, and what it held elsewhere" flash_is uf2 a.bin zeros
check "a BIN is written; --no-verify and --no-reboot do neither" eval 'ended bin 0 "" && said bin "RP2040 @: 70001 bytes written"'
check "... and the board is still there" eval 'ended list 0 "" && said list "@ E0C9125B0D9B RP2040"'
check "... for --serial, which writes it again" eval 'ended again 0 "" && said again "RP2040 @: 70001 bytes written, read back and equal, started"'
check "... byte by byte" flash_is bin b.bin erased
check "... and has left then" ended left 1 "$nothing"
check "no board" eval 'ended none 1 "$nobody" && ended list-none 1 "$nothing"'
check "an RP2350 is another board" ended rp2350 1 "${nobody/ on USB/ on USB (an RP2350 is, which needs another image)}"
check "... and so is an RP2040" ended rp2040 1 "no RP2350 in its boot loader (2e8a:000f) on USB (an RP2040 is, which needs another image); ${nobody#*; }"
check "an RP2350 beside an RP2040 gets its image, and reboots" eval 'ended pico2 0 "" && said pico2 "RP2350 @: 50176 bytes written, read back and equal, started" && flash_is pico2 pico2.bin zeros'
check "... and is listed" eval '[ "$(sed "s/[^ ]* //" "$guest_out/list-pico2.out" | sort | tr "\n" ,)" = "E0C9125B0D9B RP2040,E0C9125B0D9B RP2350," ]'
check "one that is pulled is a line, and a second run completes" eval 'grep -q ": unplugged while writing 0x1000[0-9a-f]*; " "$guest_out/cut-pico2.err" && ended pico2-bin 0 "" && flash_is pico2-bin pico2.bin erased'
check "several boards, which have the same serial number" two_are_listed
check "a serial number that no board has" eval 'sed -i "s/[0-9]*:[0-9]* (E0/@ (E0/" "$guest_out/serial.err" && ended serial 1 "no RP2040 in its boot loader is '\''NONE'\''; on USB: @ (E0C9125B0D9B)"'
check "no permission names the rule" ended nouser 1 'RP2040 @: no permission; copy boards/udev/60-pinhole.rules to /etc/udev/rules.d, run udevadm control --reload, and plug it in again'
check "... for --list, too" eval 'said list-nouser "@ (cannot be opened) RP2040" && grep -q 60-pinhole.rules "$guest_out/list-nouser.err"'
check "another program has the board" ended busy 1 'RP2040 @: in use by another program; end that one'
check "an ELF" refused a.elf 'an ELF file, which is for debuggers; give the .uf2 or .bin beside it'
check "another chip's UF2" refused stm32.uf2 'for STM32F4 (family 0x57755a57), not a program for an RP2040 or RP2350'
check "a UF2 for RAM" refused ram.uf2 'block 0 is for address 0x20000000, outside of the flash (0x10000000 to 0x10ffffff)'
check "a truncated UF2" refused short.uf2 'truncated: block 0 says that there are 196 blocks, the file has 100'
check "a scene that is not whole" refused half.phs 'is not whole, or too large'
check "--force without a scene is wrong usage" ended force 2 '--force goes with --at-scene; see --help'
check "a file that is not there" refused nothing.uf2 'cannot be opened: No such file or directory'
check "... and nothing of this has touched the flash" cmp "$dir/old" "$guest_out/kept"
nothing_shows() { # name of the run, what is there
    ended "$1" 1 "RP2040 @: nothing would show the scene: $2; write an image first (make flash BOARD=x), or add --force; nothing was changed"
}

if [ -e "$dir/has-demos" ]; then
    check "a scene is written behind an image of all demos, and the board starts" eval 'ended scene-has-demos 0 "" && said scene-has-demos "RP2040 @: $(stat -c %s "$dir/a.phs") bytes written, read back and equal, started" && scene_is_behind "$dir/has-demos" "$guest_out/has-demos"'
    check "... and not behind an image that takes none" eval 'nothing_shows scene-has-depth "the board has '\''Pinhole depth'\'', which takes no scene at 0x10080000" && cmp "$dir/has-depth" "$guest_out/has-depth"'
else
    skip "a scene is written behind an image of all demos" "no arm-none-eabi-gcc"
fi
check "a scene for a board that has another program" eval 'nothing_shows scene-kept "the board has a program without a name" && cmp "$dir/old" "$guest_out/kept"'
check "... or an erased flash" eval 'nothing_shows scene-erased "the flash is erased" && [ -z "$(tr -d "\377" <"$guest_out/erased" | head -c 1)" ]'
check "... is written with --force" eval 'ended forced 0 "" && scene_is_behind "$dir/old" "$guest_out/forced"'
check "an image that is larger than the flash" ended small 1 'RP2040 @: the image ends at 0x100aafff, the board'\''s flash of 524288 bytes at 0x1007ffff; nothing was changed'
check "... which is as it was" cmp "$dir/old" "$guest_out/small"
check "a board that refuses each command once gets its image" eval 'ended stalls 0 "" && flash_is stalls a.bin zeros'
check "a board that refuses everything" ended stall 1 "RP2040 @: the board refuses writing 0x10002000 (no reason given); pull it out, $again"
check "a board that does not answer" ended hang 1 "RP2040 @: no answer for 3 s while preparing 0x10000000; pull it out, $again"
check "a board that takes half of each transfer" ended short 1 "RP2040 @: USB error while writing 0x10002000; pull it out, $again"
check "a board that is pulled at four moments is a line, and a second run completes" cut_is_completed
check "Ctrl-C is 130 and a line; the board is there, and a second run completes" eval 'stopped INT 130 int && interrupt_is_one_line'
check "killed: the board is there, and a second run completes" stopped KILL 137 killed
check "a terminal shows a bar, and it is gone in the end" a_terminal_shows_a_bar
[ "$tap_failed" = 0 ] || sed 's/^/# guest: /' "$dir/log"
tap_end
