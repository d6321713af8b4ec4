#!/usr/bin/env bash
# The MicroPython module, where MICROPYTHON names a checkout of its public source with arm-none-eabi-gcc and qemu at hand:
# the unix port and, with an M3's own kernels, the port for QEMU draw the same bytes, a model is that of the simulator,
# and what is wrong raises what it should. No Debian package has that source, so elsewhere this is skipped.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build} root=$PWD module=firmware/package/micropython
[ -d "${MICROPYTHON-}/ports/unix" ] || { skip "micropython" "MICROPYTHON=DIR names no source of MicroPython" && tap_end && exit 0; }
dir=$(mktemp -d) && trap 'rm -rf "$dir"' EXIT
python=$dir/unix/micropython

port() { # name, make variable...: a port with the module, built into $dir
    make -C "$MICROPYTHON/ports/$1" -j"$(nproc)" BUILD="$dir/$1" FROZEN_MANIFEST='' USER_C_MODULES="$root" "${@:2}" >"$dir/$1.log" 2>&1 || { tail -n 5 "$dir/$1.log" && return 1; }
}

unix_builds() {
    make -C "$MICROPYTHON/mpy-cross" -j"$(nproc)" >"$dir/cross.log" 2>&1 &&
        port unix VARIANT=standard MICROPY_PY_SSL=0 MICROPY_SSL_MBEDTLS=0 MICROPY_PY_BTREE=0 MICROPY_PY_FFI=0
}

hello_draws() { (cd "$dir" && "$python" "$root/$module/hello.py") | grep -qE '^[1-9][0-9]* triangles; 0 had no room$' && [ "$(wc -c <"$dir/hello.ppm")" = 172815 ]; }

# In 96x96, so that the memory of a small port holds it; the sum of the bytes in wire order.
small_scene() {
    sed '/^picture = /,$d; s/HEIGHT = 240/HEIGHT = 96/; s/rings=12/rings=8/' $module/hello.py
    cat <<'PYTHON'
import binascii
picture = bytearray(2 * WIDTH * HEIGHT)
renderer = pinhole.Renderer(WIDTH, HEIGHT, vertices=300, triangles=300, order=pinhole.WIRE)
scene(renderer)
renderer.show(picture)
print("sum %08x" % binascii.crc32(picture))
bands = bytearray()
scene(renderer)
renderer.show(lambda y, lines, pixels: bands.extend(pixels))
print("bands", bands == picture)
PYTHON
}

m3_draws_the_same() {
    small_scene >"$dir/small.py"
    port qemu BOARD=MPS2_AN385 PINHOLE_CPU=armv7m || return 1
    {
        printf '\003\003\001' && sleep 1
        while IFS= read -r line; do printf '%s\r\n' "$line" && sleep .01; done <"$dir/small.py"
        printf '\004' && sleep 10
    } | timeout 60 qemu-system-arm -machine mps2-an385 -display none -monitor none -semihosting -serial stdio -kernel "$dir/qemu/firmware.elf" >"$dir/said" 2>/dev/null
    "$python" "$dir/small.py" >"$dir/here" && grep -q 'bands True' "$dir/here" || return 1
    local sum
    sum=$(grep -o 'sum [0-9a-f]*' "$dir/here")
    grep -q "$sum" "$dir/said" && grep -q 'bands True' "$dir/said" || { cat "$dir/here" "$dir/said" && return 1; }
}

model_is_the_simulators() {
    "$B/pinhole-asset" tests/host-sim/asset/scene.gltf -o "$dir/scene.phs" && "$B/pinhole-sim" --model "$dir/scene.phs" --size 160x120 --start 7 --frames 1 --out "$dir/sim.ppm" || return 1
    cat >"$dir/model.py" <<PYTHON
import pinhole
model = pinhole.Model(open("$dir/scene.phs", "rb").read())
vertices, triangles = model.need()
renderer = pinhole.Renderer(160, 120, vertices=vertices, triangles=triangles, order=pinhole.RGB888)
model.draw(renderer, frame=7)
picture = bytearray(3 * 160 * 120)
renderer.show(picture)
open("$dir/model.ppm", "wb").write(b"P6\n160 120\n255\n" + picture)
PYTHON
    "$python" "$dir/model.py" && cmp <(tail -c 57600 "$dir/sim.ppm") <(tail -c 57600 "$dir/model.ppm")
}

# An expression, and the exception that it raises with what words.
wrong() {
    cat <<'PYTHON'
r.show(b) | RuntimeError | begin
r.begin((0, 0, 0), near=0) | ValueError | near
r.begin((0, 0, 5), lights=[(0, 0, 0)]) | ValueError | no direction
r.begin((0, 0, 5), lights=[(0, 1, 0)] * 5) | ValueError | at most 4
r.draw(7) | TypeError | Mesh
r.show(bytearray(9)) | ValueError | 8192 bytes
pinhole.Renderer(0, 64) | ValueError | 1 .. 1024
pinhole.Mesh([(0, 0, 0)], [(0, 0, 1)]) | ValueError | vertex 1, of 1
pinhole.Mesh([(0, 0), (1, 1)], [(0, 1, 0)]) | ValueError | length 3
pinhole.Mesh([], []) | ValueError | 65536 positions, not 0
pinhole.Mesh(p, []) | ValueError | triangles, not 0
pinhole.Mesh([(float("nan"), 0, 0)], [(0, 0, 0)]) | ValueError | NaN
pinhole.Mesh(p, [(0, 1, 2)], colour=-1) | ValueError | 0xffffff
pinhole.Mesh(p, [(0, 1, 2)], colours=[0, 0, 0x1000000]) | ValueError | 0xffffff
pinhole.Mesh(p, [(0, 1, 2)], colours=p, uvs=p, texture=pinhole.Texture(b, 2, 2)) | ValueError | not both
pinhole.Texture(b, 2, 2, order=2) | ValueError | WIRE or NATIVE
pinhole.Renderer(64, 64, order=3) | ValueError | RGB888
pinhole.Renderer(64, 64, order=pinhole.RGB888).text(b, 0, 0, "") | ValueError | WIRE or NATIVE
r.begin((0, 0, 5)); r.show(lambda *band: r.begin((0, 0, 5))) | RuntimeError | not inside
pinhole.Mesh(p, [(0, 1, 2)], uvs=[(0, 0)]) | ValueError | 1 uvs for 3
pinhole.Mesh(p, [(0, 1, 2)], texture=pinhole.Texture(bytes(8), 2, 2)) | ValueError | uvs
pinhole.Texture(bytes(8), 3, 1) | ValueError | 1, 2, 4
pinhole.Texture(bytes(7), 2, 2) | ValueError | 8 bytes
pinhole.Model(bytes(64)) | ValueError | scene
r.begin((0, 0, 5)); r.draw(pinhole.Mesh(p * 9, [(0, 1, 2)])) | MemoryError | vertices
PYTHON
}

mistakes_raise() {
    {
        printf 'import pinhole\nr = pinhole.Renderer(64, 64, vertices=20)\nb = bytearray(8192)\np = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n'
        printf 'def raises(f, kind, words):\n    try:\n        f()\n    except kind as e:\n        if words in str(e): return\n        print(words, "is not in", e)\n    else:\n        print(words, "was not raised")\n'
        wrong | awk -F ' [|] ' '{ n = split($1, part, "; "); for (i = 1; i < n; i++) { print part[i] } printf "raises(lambda: %s, %s, \"%s\")\n", part[n], $2, $3 }'
    } >"$dir/wrong.py"
    "$python" "$dir/wrong.py" >"$dir/said" 2>&1 && [ ! -s "$dir/said" ] || { cat "$dir/said" && return 1; }
}

# Nothing else holds the meshes, the arena or the pixels while memory is collected and written anew.
what_is_shown_stays() {
    cat >"$dir/stays.py" <<PYTHON
import gc
import pinhole
def again():
    gc.collect()
    full = []
    for size in (4096, 256, 32):
        junk = b"\xdb" * size
        try:
            while True:
                full.append(bytearray(junk))
        except MemoryError:
            pass
    full = None
    gc.collect()
def triangle(texel):
    return pinhole.Mesh([(-1, -1, 0), (1, -1, 0), (0, 1, 0)], [(0, 1, 2)], uvs=[(0, 0), (1, 0), (0, 1)], texture=pinhole.Texture(texel * 4096, 64, 64))
def shown(renderer):
    picture = bytearray(8192)
    renderer.show(picture)
    return picture
r = pinhole.Renderer(64, 64, vertices=20)
r.begin((0, 0, 3))
r.draw(triangle(b"\x12\x34"))
right = shown(r)
r.begin((0, 0, 3))
r.draw(triangle(b"\x12\x34"))
again()
assert shown(r) == right
r.begin((0, 0, 3))
r.draw(triangle(b"\x12\x34"))
try:
    r.begin((0, 0, 3), background="red")
except TypeError:
    pass
r.draw(triangle(b"\x56\x78"), position=(99, 0, 0))
again()
assert shown(r) == right
data = open("$dir/scene.phs", "rb").read()
model = pinhole.Model(data)
vertices, triangles = model.need()
one, other = [pinhole.Renderer(64, 64, vertices=vertices, triangles=triangles) for i in range(2)]
model.draw(one, frame=3)
right = shown(one)
model.draw(one, frame=3)
model.draw(other, frame=9)
again()
assert shown(one) == right
model.draw(one, frame=3)
model = None
again()
assert shown(one) == right
kept = []
r.begin((0, 0, 3), background=0xff0000)
r.show(lambda y, lines, pixels: kept.append(pixels))
right = bytes(kept[-1])
r = None
again()
assert bytes(kept[-1]) == right
PYTHON
    "$python" -X heapsize=400k "$dir/stays.py"
}

classes_are_drawn() {
    cat >"$dir/classes.py" <<'PYTHON'
import pinhole
class Triangle(pinhole.Mesh):
    def __init__(self):
        super().__init__([(-1, -1, 0), (1, -1, 0), (0, 1, 0)], [(0, 1, 2)])
r = pinhole.Renderer(64, 64, vertices=20)
r.begin((0, 0, 3))
r.draw(Triangle())
assert r.stats()[0] == 1, r.stats()
PYTHON
    "$python" "$dir/classes.py"
}

check "the unix port builds with it" unix_builds
check "hello.py draws" hello_draws
check "an M3 with its kernels draws the same bytes, in bands, too" m3_draws_the_same
check "a binary scene is the simulator's picture" model_is_the_simulators
check "26 mistakes raise what they should" mistakes_raise
check "what a frame shows stays until it is shown" what_is_shown_stays
check "a class made of Mesh is drawn" classes_are_drawn
tap_end
