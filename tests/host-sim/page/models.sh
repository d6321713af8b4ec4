#!/usr/bin/env bash
# Usage: tests/host-sim/page/models.sh FOLDER [BOARD...]
# Writes the models that use_model.mjs gives to the page, and what pinhole-asset and pinhole-sim make of them.
set -eu
cd "$(dirname "$0")/../../.."
B=${B:-build}
to=$1

# A GLB of a glTF file: its buffer and its pictures become views of the binary chunk.
node -e '
const fs = require("fs"), [from, to] = process.argv.slice(1), json = JSON.parse(fs.readFileSync(from));
const bytes = (uri) => Buffer.from(uri.replace(/.*base64,/, ""), "base64"), parts = [];
const pad = (buffer, fill) => Buffer.concat([buffer, Buffer.alloc(-buffer.length & 3, fill)]);
const add = (buffer) => { const at = parts.reduce((n, part) => n + part.length, 0); parts.push(pad(buffer, 0)); return at; };
add(bytes(json.buffers[0].uri));
for (const image of json.images) {
    const picture = bytes(image.uri);
    json.bufferViews.push({ buffer: 0, byteOffset: add(picture), byteLength: picture.length });
    Object.assign(image, { uri: undefined, mimeType: "image/png", bufferView: json.bufferViews.length - 1 });
}
const chunk = (kind, data) => { const head = Buffer.alloc(8); head.writeUInt32LE(data.length); head.write(kind, 4, "latin1"); return Buffer.concat([head, data]); };
json.buffers = [{ byteLength: parts.reduce((n, part) => n + part.length, 0) }];
const body = Buffer.concat([chunk("JSON", pad(Buffer.from(JSON.stringify(json)), " ")), chunk("BIN\0", Buffer.concat(parts))]);
const head = Buffer.from("glTF\x02\0\0\0\0\0\0\0", "latin1");
head.writeUInt32LE(12 + body.length, 8);
fs.writeFileSync(to, Buffer.concat([head, body]));
' tests/host-sim/asset/surfaces.gltf "$to/made.glb"

# A ring of 24 x 24 quads, with a picture around it.
awk 'BEGIN {
    print "mtllib ring.mtl\nusemtl ring"
    for (i = 0; i < 24; i++) for (k = 0; k < 24; k++) {
        a = i * 0.2617993878; b = k * 0.2617993878
        printf "v %.6f %.6f %.6f\nvt %.6f %.6f\n", (3 + cos(b)) * cos(a), sin(b), (3 + cos(b)) * sin(a), i / 24, k / 24
    }
    for (i = 0; i < 24; i++) for (k = 0; k < 24; k++) {
        p = i * 24 + k + 1; q = i * 24 + (k + 1) % 24 + 1; r = (i + 1) % 24 * 24 + (k + 1) % 24 + 1; s = (i + 1) % 24 * 24 + k + 1
        printf "f %d/%d %d/%d %d/%d %d/%d\n", p, p, q, q, r, r, s, s
    }
}' >"$to/ring.obj"
printf 'newmtl ring\nmap_Kd ring.png\n' >"$to/ring.mtl"
"$B/pinhole-sim" --demo testcard --size 128x64 --out "$to/ring.png"

# What the page does without being told: as many triangles as pico-display-2 has room for.
"$B/pinhole-asset" "$to/made.glb" --board pico-display-2 --max-triangles fit --force -o "$to/fit.phs" 2>/dev/null
"$B/pinhole-sim" --model "$to/fit.phs" --board pico-display-2 --crc | sed 's/.* //' >"$to/scene.crc"
# The same in another light.
"$B/pinhole-asset" "$to/made.glb" --board pico-display-2 --max-triangles fit --force --background 336699 --light left -o "$to/light.phs" 2>/dev/null
# Step 501 of the 1000 of its slider.
triangles=$(node -p 'Math.round(16 * (1152 / 16) ** 0.501)')
for kind in phs c; do
    "$B/pinhole-asset" "$to/ring.obj" --max-triangles "$triangles" --force -o "$to/ring.$kind" 2>/dev/null
done
"$B/pinhole-asset" "$to/ring.obj" --max-triangles "$triangles" --force --report | sed -n 's/^triangles  \([0-9]*\) of.*/\1/p' >"$to/ring.triangles"

# For the long test: a folder, a model that takes long, an empty file that is made large, and made.glb on these boards.
shift
[ $# -gt 0 ] || exit 0
mkdir -p "$to/ring" && cp "$to"/ring.obj "$to"/ring.mtl "$to"/ring.png "$to/ring/"
for ((i = 0; i < 200; i++)); do cat "$to/ring.obj"; done >"$to/large.obj"
: >"$to/huge.stl"
"$B/pinhole-asset" "$to/ring.obj" --max-triangles all -o "$to/whole.phs" 2>/dev/null
"$B/pinhole-sim" --model "$to/whole.phs" --size 320x240 --crc | sed 's/.* //' >"$to/whole.crc"
for board; do
    "$B/pinhole-asset" "$to/made.glb" --board "$board" --max-triangles fit --force -o "$to/board.phs" 2>/dev/null
    echo "$board $("$B/pinhole-sim" --model "$to/board.phs" --board "$board" --crc | sed 's/.* //')"
done >"$to/boards"
