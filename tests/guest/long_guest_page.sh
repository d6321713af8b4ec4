#!/usr/bin/env bash
# The page's Flash writes virtual boards (tests/guest): its own modules, with npm's `usb` in place of the browser's WebUSB, over
# the real libusb and kernel. Each fault is a line with its cure, and ends within seconds; boards that are pulled at 50 random
# moments are completed by a second run. SEED=n for the same moments.
# shellcheck disable=SC2317,SC2016,SC2015 # functions are called by check; $GUEST and $i are the guest's; `A && B || C` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
B=${B:-build}
made=$(make -s B="$B" page 2>&1) || { echo "$made" && [[ $made = *'no compiler for WebAssembly'* ]] && exit 77 || exit 1; }
. tests/guest/flash_in_guest.sh
dir=$B/usb-package packages=tests/guest/usb_package
. tests/support/npm.sh
modules=$dir/node_modules
guest_begin "the page's Flash writes a virtual board" libusb-1.0
guest_build && make_images "$dir" rp2040 40000 && make_rp2350_image "$dir" rp2350 40000 && cp "$dir/rp2350.bin" "$dir/riscv.bin" &&
    "$dir/uf2" 0xe48bff5a 0x10000000 "$dir/riscv.bin" "$dir/riscv.uf2" || exit 1
head -c 2097152 /dev/urandom >"$dir/old"
for image in rp2040 rp2350 riscv; do
    { cat "$dir/$image.bin" && head -c 192 /dev/zero && head -c 768 /dev/zero | tr '\0' '\377' && tail -c +40961 "$dir/old"; } >"$dir/$image"
done
seed=${SEED:-$RANDOM}

cat >"$dir/in_guest" <<EOT
images=$dir RANDOM=$seed PATH=\$PATH
page="node $PWD/tests/host-sim/page/flash.mjs $modules $B/wasm/page.wasm"
EOT
cat >>"$dir/in_guest" <<'EOT'
. tests/guest/flash_in_guest.sh
cd $GUEST
guest_program="$page rp2040"
guest_limit=60
for flash in good once fault; do cp $images/old $flash; done
run none $images/rp2040.uf2
run_on good good "" $images/rp2040.uf2
run_on once once --stall-once $images/rp2040.uf2
run_on wrong good "" $images/rp2040.bin $images/old
for fault in stall hang short unplug; do
    run_on $fault fault "--$fault-after 5000" $images/rp2040.uf2
done
plug --flash fault --hang-after 0
run held $images/rp2040.uf2 &
sleep 2
run busy $images/rp2040.uf2
wait $!
pull
# 42,016 bytes go to a board with 10 sectors of image: 33 commands of 32 bytes, 10 sectors.
cut() {
    local after=$(((RANDOM * 32768 + RANDOM) % 42016))
    [ $(($1 % 3)) != 0 ] || after=$((42016 - RANDOM % 352)) # while it is read back
    run_on first flash "--unplug-after $after $product" "$2"
}
for i in {1..17}; do
    product='' guest_program="$page rp2040" && cut_and_again $i $images/rp2040.uf2 $images/rp2040
    product='--product f' guest_program="$page rp2350" && cut_and_again $i $images/rp2350.uf2 $images/rp2350
    [ $i = 17 ] || cut_and_again $i $images/riscv.uf2 $images/riscv
done
EOT
guest_run --icount --timeout 4000 --memory 800 --out "$dir/guest" -- bash "$dir/in_guest" >"$dir/log" 2>&1 || sed 's/^/# guest: /' "$dir/log"
guest_out=$dir/guest
again='plug it in with BOOTSEL held and run this again'

told() { # name, status, pattern of its only line
    [ "$(cat "$guest_out/$1.status")" = "$2" ] && [ "$(wc -l <"$guest_out/$1.err")" -le 1 ] && grep -Eqx -- "$3" "$guest_out/$1.err" "$guest_out/$1.out" ||
        { cat "$guest_out/$1.status" "$guest_out/$1.err" "$guest_out/$1.out" && return 1; }
}
writes() { told "$1" 0 'RP2040: 40192 bytes written, read back and equal, started [2-9][0-9] steps' && cmp "$guest_out/$1" "$dir/rp2040"; }
cuts_are_mended() {
    awk '{ line = $0; sub(/^[^ ]* [^ ]* [^ ]* /, "", line) }
        $2 != 0 || $3 != "yes" { print "second run: " $0; bad = 1 }
        $1 == 0 { through++; next }
        $1 != 1 || line !~ /^page: RP2[0-9]*: unplugged/ { print "first run: " $0; bad = 1 }
        END { if (NR != 50 || through > 25) { print NR " runs, " through + 0 " came through"; bad = 1 } exit bad }' "$guest_out/cuts"
}

check "no board" told none 1 'page: no RP2040 in its boot loader \(2e8a:0003\) on USB; plug it in with BOOTSEL held, or send B to the UART of a running image'
check "an image is written, read back and started" writes good
check "... also where every command is refused once" writes once
check "what is no image changes nothing" told wrong 1 'page: is no UF2 file: a scene goes into a UF2 image'
check "a board that refuses" told stall 1 "page: RP2040: the board refuses .* \(.*\); pull it out, $again"
check "... that does not answer" told hang 1 "page: RP2040: no answer for 3 s while .*; pull it out, $again"
check "... that takes half" told short 1 "page: RP2040: USB error while .*; pull it out, $again"
check "... that is pulled" told unplug 1 "page: RP2040: unplugged while .*; $again"
check "... that another program has" told busy 1 'page: RP2040: in use by another program; end that one'
check "50 boards, each pulled after a random number of bytes (SEED=$seed): a line, and a second run completes" cuts_are_mended
tap_end
