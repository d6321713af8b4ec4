#!/usr/bin/env bash
# The readers of UF2, BIN, glTF, OBJ, STL and PLY files under libFuzzer, with the sanitizers and the checks of tests/host-sim/fuzz_*.c:
# 2 minutes each without a finding. FUZZ_S=n for another time; a finding stays in $B/log/libfuzzer.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
export B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
mkdir -p "$dir"/{uf2,gltf,model} "$B/log/libfuzzer"
time_s=${FUZZ_S:-120}

echo 'int LLVMFuzzerTestOneInput(const char *d, long n); int LLVMFuzzerTestOneInput(const char *d, long n) { return n > 0 && *d > 200; }' >"$dir/probe.c"
clang -fsanitize=fuzzer -o "$dir/probe" "$dir/probe.c" 2>/dev/null || { skip "libFuzzer finds nothing" "no clang with libFuzzer" && tap_end; }
pkg-config --exists libpng libjpeg libwebp || { skip "libFuzzer finds nothing" "no libpng, libjpeg or libwebp" && tap_end; }

compile() { # program, flags and files...
    clang -std=c11 -O1 -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -DLIBFUZZER -Ifirmware/core/kernels/portable -Ifirmware/core -Ifirmware/app -Ihal -Iboards \
        -Ihost-sim/common -Ihost-sim/picture -o "$dir/$1.fuzz" "${@:2}"
}

model=(-Ihost-sim/model -Ihost-sim/model/formats -Ihost-sim/model/gltf)
# shellcheck disable=SC2054,SC2207 # commas of braces; words of one library
sources=(host-sim/model/{gltf,formats}/*.c host-sim/model/model_{meshes,places,surface,shared,camera,folder,scene,rig,rig_clips,texture,weld,normals,polygon,text}.c
    host-sim/picture/picture_in.c host-sim/picture/{png,jpeg,webp}/*_in.c "$B"/libpinhole-{host,app,hal}.a "$B/libpinhole.a" -Wl,--as-needed -lpng -ljpeg -lwebp $([ ! -e /usr/include/meshoptimizer.h ] || echo -lmeshoptimizer) -lm)
build() { # what is not named here comes from the libraries, without sanitizers
    make -s -j2 B="$B" "$B/pinhole-sim" &&
        compile uf2 -Ihost-sim/flash -Itests/support tests/host-sim/fuzz_uf2.c tests/support/uf2_make.c host-sim/flash/flash_file.c host-sim/flash/flash_image.c host-sim/flash/flash_uf2.c firmware/app/crc32.c &&
        compile gltf "${model[@]}" tests/host-sim/fuzz_gltf.c "${sources[@]}" && compile model "${model[@]}" tests/host-sim/fuzz_model.c "${sources[@]}"
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
# A first byte 0, 1, 2 chooses OBJ, STL, PLY.
printf '\0v 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1\nv 0 1 0\nv .2 .1 0\nvt 0 1\nvn 0 0 1\no a\ng b\nusemtl c\nf 1 2 3 4 5\nf -1//1 -2//1 -3\nf 1/1/1 \\\n2/1 3/1\n' >"$dir/model/obj"
printf '\1solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n' >"$dir/model/stl"
{ printf '\1' && head -c 80 /dev/zero && printf '\2\0\0\0' && head -c 100 /dev/urandom; } >"$dir/model/binary-stl"
printf '\2ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty float nx\nproperty float s\nelement face 1\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0 1 1 1\n1 0 0 1 1 1\n1 1 0 1 1 1\n0 1 0 1 1 1\n4 0 1 2 3 8 0 0 1 0 1 1 0 1\n5 0 1 2 3 -1\n' >"$dir/model/ply"
printf '\2ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty char x\nproperty short y\nproperty double z\nelement face 1\nproperty list ushort uchar vertex_index\nend_header\n0yy000000001yy111111112zz22222222\0\3\0\1\2' >"$dir/model/binary-ply"

# Readers of models free little, so their process is started anew when it has grown (-fork); one call for too much
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
check "libFuzzer finds nothing in the readers of OBJ, STL and PLY in $time_s s" finds_nothing model
tap_end
