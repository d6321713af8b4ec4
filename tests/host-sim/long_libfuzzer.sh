#!/usr/bin/env bash
# The readers of UF2, BIN and glTF files under libFuzzer, with the sanitizers and the checks of tests/host-sim/fuzz_*.c:
# 2 minutes each without a finding. FUZZ_S=n for another time; a finding stays in $B/log/libfuzzer.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
export B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
mkdir -p "$dir"/{uf2,gltf} "$B/log/libfuzzer"
time_s=${FUZZ_S:-120}

echo 'int LLVMFuzzerTestOneInput(const char *d, long n); int LLVMFuzzerTestOneInput(const char *d, long n) { return n > 0 && *d > 200; }' >"$dir/probe.c"
clang -fsanitize=fuzzer -o "$dir/probe" "$dir/probe.c" 2>/dev/null || { skip "libFuzzer finds nothing" "no clang with libFuzzer" && tap_end; }
pkg-config --exists assimp libpng libjpeg || { skip "libFuzzer finds nothing" "no assimp, libpng or libjpeg" && tap_end; }

compile() { # program, flags and files...
    clang -std=c11 -O1 -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -DLIBFUZZER -Ifirmware/core/kernels/portable -Ifirmware/core -Ifirmware/app -Ihal -Iboards \
        -Ihost-sim/common -Ihost-sim/picture -o "$dir/$1.fuzz" "${@:2}"
}

build() { # what is not named here comes from the libraries, without sanitizers
    make -s -j2 B="$B" "$B/pinhole-sim" &&
        compile uf2 -Ihost-sim/flash -Itests/support tests/host-sim/fuzz_uf2.c tests/support/uf2_make.c host-sim/flash/flash_file.c host-sim/flash/flash_image.c host-sim/flash/flash_uf2.c firmware/app/crc32.c &&
        compile gltf -Ihost-sim/model -Ihost-sim/model/gltf tests/host-sim/fuzz_gltf.c host-sim/model/gltf/*.c \
            host-sim/model/model_{meshes,places,surface,shared,camera,folder,scene,rig,rig_clips,texture}.c host-sim/picture/picture_in.c host-sim/picture/{png,jpeg}/*_in.c \
            "$B"/libpinhole-{host,app,hal}.a "$B/libpinhole.a" -lpng -ljpeg -lm
}
build || exit 1

# Right files to start from: images and data of 1 to 5 blocks; models.
cc -O1 -o "$dir/seal" hal/rp2040/boot2_seal.c && cc -O1 -o "$dir/image_uf2" firmware/tools/image_uf2.c || exit 1
head -c 256 /dev/urandom | "$dir/seal" >"$dir/bin"
cp "$dir/bin" "$dir/uf2/bin"
for blocks in 1 5; do
    "$dir/image_uf2" 0xe48bff56 0x10000000 "$dir/bin" "$dir/uf2/image-$blocks"
    "$dir/image_uf2" 0xe48bff56 0x10100000 "$dir/bin" "$dir/uf2/data-$blocks"
    head -c 1000 /dev/urandom >>"$dir/bin"
done
cp tests/host-sim/asset/*.gltf "$dir/gltf"

# The reader of glTF frees nothing, so its process is started anew when it has grown (-fork); one call for too much
# memory is a finding all the same.
finds_nothing() { # name, options...
    (cd "$dir" && ASAN_OPTIONS=detect_leaks=0 "./$1.fuzz" -max_total_time="$time_s" -max_len=8192 -timeout=100 -fork=1 -ignore_ooms=1 -rss_limit_mb=3000 -malloc_limit_mb=2000 "$1") >"$dir/log" 2>&1
    local status=$?
    cp "$dir"/{crash,timeout,leak}-* "$B/log/libfuzzer" 2>/dev/null
    grep -E '^#[0-9]+: cov' "$dir/log" | tail -n 1 | sed 's/^/# /'
    if [ "$status" != 0 ] || ! grep -qE '^#[0-9]{4,}: cov.*crash: 0/0/0' "$dir/log"; then
        tail -n 40 "$dir/log" && return 1
    fi
}
check "libFuzzer finds nothing in the reader of UF2 and BIN in $time_s s" finds_nothing uf2
check "libFuzzer finds nothing in the reader of glTF in $time_s s" finds_nothing gltf
tap_end
