#!/usr/bin/env bash
# Usage: tests/proof/gappa.sh NAME|lines [TREE]
# Proves an error bound with Gappa. NAME: a function prove_NAME below. The numbers of a formula are read out of the line of
# C that computes it; that line must look as it stands here. So a proof cannot drift from the code: when the code moves on,
# the proof fails until it follows. lines: looks at the lines of all proofs, and needs no Gappa.
# A term in 1bN is 2^N. Lines with -> are hints how to write a difference; Gappa checks that both sides are equal.
set -u
name=${1-} core=${2:-.}/firmware/core
n=()

# The numbers in place of each # of a line of the source, in n[0], n[1], ..
constants() { # file, line
    local pattern found cut=$'\001' # a delimiter that no source has
    pattern=$(sed 's/[][\.*^$]/\\&/g; s/#/\\([0-9]*\\)/g' <<<"$2")
    found=$(sed -n "s$cut^.*$pattern.*$cut+ $(grep -o '#' <<<"$2" | awk '{ printf "\\%d ", NR }')${cut}p" "$core/$1" | head -n 1)
    [ -n "$found" ] || { echo "$1 has no such line any more: $2" && exit 1; }
    read -r -a n <<<"${found#+ }"
}

# Runs Gappa. It says nothing when all is proved; a hint that is no equality is a failure.
gappa_agrees() {
    local said
    said=$(gappa -Wno-null-denominator 2>&1 | grep -v 'no need for the rewriting\|maximum number of iterations')
    [ -z "$said" ] || { echo "$said" | head -n 12 && exit 1; }
}

# fx_rcp_newton is floor(2^62 / d). In each of the 256 intervals of d that share an entry of the table: no product leaves
# 32 bits, and `half` is less than 1 off twice 2^62 / d - 2^7 r1. If half is odd, q is the floor then; if even, the
# floor is q or q - 1, and the remainder, below d / 2 < 2^31 either way, has the right sign in 32 bits.
prove_rcp() {
    local table entry i=0 u r1 half
    constants fx.h 'const uint32_t r0 = fx_rcp_table[(d >> 23) & 255];'
    constants fx.h 'const int32_t e0 = (int32_t)(0u - r0 * (d >> 4));'
    constants fx.h 'const int32_t u = (e0 >> #) + (((e0 >> #) * (e0 >> #)) >> #) + #;' && u=("${n[@]}")
    constants fx.h 'const uint32_t r1 = (r0 << #) + (uint32_t)(((int32_t)r0 * u) >> #);' && r1=("${n[@]}")
    constants fx.h 'const int32_t e1 = (int32_t)(0u - r1 * (d >> 1) - ((r1 & (0u - (d & 1))) >> 1));'
    constants fx.h 'const int32_t half = ((int32_t)(r1 >> #) * ((e1 >> #) + #)) >> #;' && half=("${n[@]}")
    constants fx.h 'const uint32_t q = (r1 << 7) + (uint32_t)(half >> 1);'
    constants fx.h 'return q - (((0u - q * d) >> 31) & ~(uint32_t)half);'
    table=$(sed -n '/fx_rcp_table\[256\] = {/,/};/p' "$core/fx/fx_root.c" | sed 1d | tr -dc '0-9\n,' | tr ',' ' ')
    [ "$(wc -w <<<"$table")" = 256 ] || { echo "no table of 256 entries" && exit 1; }
    for entry in $table; do
        gappa_agrees <<END
@floor = fixed<0, dn>;
R0 = $entry;
e0 = 1b39 - R0 * floor(d * 1b-4);
s0 = floor(e0 * 1b-${u[1]});
square = s0 * s0;
u = floor(e0 * 1b-${u[0]}) + floor(square * 1b-${u[3]}) + ${u[4]};
v = R0 * u;
r1 = R0 * 1b${r1[0]} + floor(v * 1b-${r1[1]});
e1 = 1b54 - floor(r1 * d / 2);
p = floor(r1 * 1b-${half[0]});
q = floor(e1 * 1b-${half[1]}) + ${half[2]};
half = floor(p * q * 1b-${half[3]});
X = 1b55 / d; # r1 but for its error
E = 1 - R0 * d * 1b-43;
T = e0 * 1b-39;
remainder = 1b54 - r1 * d / 2;
twice = remainder * 512 / d; # 2 (2^62 / d - 2^7 r1)
{ d in [$(((256 + i) << 23)), $((((257 + i) << 23) - 1))] ->
  e0 in [-1b31, 2147483647] /\\ square in [0, 2147483647] /\\ v in [-1b31, 2147483647] /\\ r1 in [0, 4294967295]
  /\\ e1 in [-1b31, 2147483647] /\\ p * q in [-1b31, 2147483647] /\\ half - twice in [-0.9999, 0.9999] }
u - 1b27 * (E + E * E) -> (floor(e0 * 1b-12) - e0 * 1b-12) + (floor(square * 1b-19) - square * 1b-19) + (s0 - e0 * 1b-16) * (s0 + e0 * 1b-16) * 1b-19 + 6 + 1b27 * ((T - E) * (1 + T + E));
T - E -> R0 * (d * 1b-4 - floor(d * 1b-4)) * 1b-39;
r1 - X -> (floor(v * 1b-15) - v * 1b-15) + R0 * (u - 1b27 * (E + E * E)) * 1b-15 - X * E * E * E;
remainder -> d / 2 * (X - r1);
e1 -> remainder - (floor(r1 * d / 2) - r1 * d / 2);
half - twice -> (half - p * q * 1b-21) + (p - X * 1b-9) * q * 1b-21 + (X * 1b-9) * (q - remainder * 1b-16) * 1b-21;
p - X * 1b-9 -> (p - r1 * 1b-9) + (r1 - X) * 1b-9;
q - remainder * 1b-16 -> (floor(e1 * 1b-16) - e1 * 1b-16) + 48 - (floor(r1 * d / 2) - r1 * d / 2) * 1b-16;
END
        i=$((i + 1))
    done
}

# fx_div_sat: with n < 2^15 d and the floor of the reciprocal, e < 1 below its exact value, the estimate is less than 3 too
# small: the loop turns twice at most. N is n 2^shift, D is d 2^shift.
prove_div() {
    constants fx/fx.c 'if (n >> # >= d) { /* 2^31 or more */' && local clamp=${n[0]}
    constants fx/fx.c 'uint32_t q = (uint32_t)(fx_mul_wide_u(n, r) >> (# - shift));' && local down=${n[0]}
    gappa_agrees <<END
@floor = fixed<0, dn>;
N = t * D;
r = 1b62 / D - e;
q = floor(N * r * 1b-$down);
exact = N * 1b16 / D;
{ D in [1b31, 1b32] /\\ t in [0, 1b$clamp] /\\ e in [0, 1] -> q - exact in [-3, 0] }
q - exact -> (q - N * r * 1b-$down) - N * e * 1b-46;
END
}

# lerp_q30 stays between a and b to half an LSB, so as an integer it is between them: nothing is lost in 32 bits.
prove_lerp() {
    constants render/clip.c 'return (int32_t)(a + ((((int64_t)b - a) * t_q30 + (1 << #)) >> #));'
    gappa_agrees <<END
@floor = fixed<0, dn>;
T = t * 1b-30;
at = a + floor(((b - a) * t + 1b${n[0]}) * 1b-${n[1]});
between = a * (1 - T) + b * T;
{ a in [-1b31, 2147483647] /\\ b in [-1b31, 2147483647] /\\ t in [0, 1b30] ->
  at - between in [-0.5, 0.5] /\\ 2147483647 - between >= 0 /\\ between + 1b31 >= 0 }
at - between -> (floor(((b - a) * t + 1b29) * 1b-30) - ((b - a) * t + 1b29) * 1b-30) + 0.5;
2147483647 - between -> (2147483647 - a) * (1 - T) + (2147483647 - b) * T;
between + 1b31 -> (a + 1b31) * (1 - T) + (b + 1b31) * T;
END
}

# divide_q25: x / w in 2^-25 is at most 14 off for |x| <= 8 w. A corner of the guard band has |x| <= 8 w / 2^up with
# up = log2 - 8, so it is within 2^28 / 2^up / 2^(17 - log2) = 2^19 / 256 = 2048 px of the centre. W: w 2^shift; t: x / w.
prove_reach() {
    constants render/transform.c 'const int32_t aligned = shift >= # ? (int32_t)((uint32_t)x << (shift - #)) : x >> (# - shift);'
    local align=${n[0]}
    constants render/transform.c 'return (int32_t)(fx_mul_wide(aligned, reciprocal) >> #);' && local down=${n[0]}
    constants render/transform.c 'const int down = 17 - lens->focal_log2;'
    constants render/transform.c 'x_q25 = divide_q25(x, (int32_t)(reciprocal >> 1), shift);'
    constants render/lens.h 'lens->guard_up = (uint8_t)(log2 > 8 ? log2 - 8 : 0);'
    gappa_agrees <<END
@floor = fixed<0, dn>;
half = 1b61 / W - e;
q25 = floor(floor(t * W * 1b-$align) * half * 1b-$down);
{ W in [1b31, 1b32] /\\ t in [-8, 8] /\\ e in [0, 1.5] -> q25 - t * 1b25 in [-3, 14] /\\ q25 in [-268435459, 268435470] }
q25 - t * 1b25 -> (q25 - floor(t * W * 1b-4) * half * 1b-32) + (floor(t * W * 1b-4) - t * W * 1b-4) * half * 1b-32 - t * W * 1b-4 * e * 1b-32;
q25 -> t * 1b25 + (q25 - t * 1b25);
END
}

# ph_depth_quotient_of: q against the exact N/w in the same units, N = n (1 - 2^-head); near is n 2^near_shift, W is
# w 2^shift. From -2 to 1/2, twice that if q is doubled: at most 2^-28 of the depth at the near plane.
prove_quotient() {
    constants render/lens.h 'lens->depth_scale = norm - (norm >> ph_depth_head(lens));'
    constants render/depth.h 'return lens->float_down > # ? # - lens->float_down : #;'
    local least=${n[0]} sum=${n[1]} room=${n[2]} down head documented
    constants render/depth.h 'const uint32_t q = fx_mulhi_u32(lens->depth_scale, reciprocal);'
    for down in 2 3 4 5; do
        head=$((down > least ? sum - down : room))
        documented=$((down == 5 ? 7 : down == 4 ? 8 : 9))
        gappa_agrees <<END
@floor = fixed<0, dn>;
scale = near - floor(near * 1b-$head);
r = 1b62 / W - e;
q = floor(scale * r * 1b-32);
exact = near * (1 - 1b-$documented) * 1b30 / W;
{ near in [1b31, 1b32] /\\ W in [1b31, 1b32] /\\ e in [0, 1] -> q - exact in [-2, 0.5] }
q - exact -> (q - scale * r * 1b-32) - scale * e * 1b-32 + (near * 1b-$documented - floor(near * 1b-$head)) * 1b30 / W;
END
    done
}

# d of a corner against the exact d in units of 2^-32, for an exponent of the vertex and of the far plane; e, g: the errors
# of their quotients.
d_is_right() { # exponent of the vertex, of the far plane, least e, least g, units
    gappa_agrees <<END
@floor = fixed<0, dn>;
at = floor((Q + e) * 1b$((2 - $1)));
far = floor((F + g) * 1b$((2 - $2)));
{ e in [$3, 1] /\\ g in [$4, 1] -> (at - far) - (Q * 1b$((2 - $1)) - F * 1b$((2 - $2))) in [-$5, $5] }
(at - far) - (Q * 1b$((2 - $1)) - F * 1b$((2 - $2))) -> (at - (Q + e) * 1b$((2 - $1))) - (far - (F + g) * 1b$((2 - $2))) + e * 1b$((2 - $1)) - g * 1b$((2 - $2));
END
}

# ph_depth_before, then the bias. A quotient's error is that of prove_quotient, doubled from exponent 1 on; it makes at
# most 13 units: 1/19 of a code of 24 bits, 1/5041 of a code of 16. In the fixed formats N/w may be up to 8, with an
# exponent down to -2, and any quotient may be doubled.
prove_depth() {
    local s f
    constants render/depth.h 'const int up = 2 + block - quotient.s;'
    constants render/depth.h 'const uint32_t at = up >= 0 ? quotient.q << up : quotient.q >> -up;'
    constants render/depth.h 'const int up = 2 + block - lens->far_s;'
    constants render/depth.h 'return up >= 0 ? lens->far_q << up : up > -32 ? lens->far_q >> -up : 0;'
    constants render/depth.h 'return at - far;'
    constants render/depth.c 'const uint32_t n = (uint32_t)p->near_z, f = (uint32_t)p->far_z, least = f / # + 1;'
    [ "${n[0]}" = 8 ] || { echo "N up to ${n[0]} n" && exit 1; }
    for s in 0 1 2 3 4 31; do
        for f in 0 1 2 3 4 31; do
            [ $s -gt $f ] || d_is_right $s $f $((s > 0 ? -4 : -2)) $((f > 0 ? -4 : -2)) 13
        done
    done
    for s in -2 -1 0; do
        for f in -2 -1 0 1 2 3 4 31; do
            [ $s -gt $f ] || d_is_right $s $f -4 -4 $(((20 << -s) + 1))
        done
    done
}

# wide_gradient: a gradient against the exact one, at most 9 off in units of its last bit, below 2^31. M is the numerator
# over 2^excess, A the area shifted to 2^31 .. 2^32, D what shifts the product down.
prove_gradient() {
    constants render/planes.c 'const int excess = ph_max(ph_max(bits_of(nx), bits_of(ny)) - #, 0);'
    [ "${n[0]}" = 31 ] || { echo "numerators of ${n[0]} bits" && exit 1; }
    constants render/planes.c 'const int64_t px = fx_mul_wide((int32_t)(nx >> excess), s->reciprocal);'
    constants render/planes.c 'const int unit = # - s->shift - excess, down = ph_max(ph_max(unit, ph_max(bits_of(px), bits_of(py)) - 31), 1);'
    [ "${n[0]}" = 53 ] || { echo "a unit of ${n[0]}" && exit 1; }
    constants render/planes.c 'const int64_t half = (int64_t)1 << (down - 1); /* down is 22 or more without excess, else 29 or more */'
    constants render/planes.c '{fx_sat64((px + half) >> down), fx_sat64((py + half) >> down)};'
    constants render/planes.h 'return (int32_t)(fx_rcp_norm(w, shift) >> 1);'
    local excess
    for excess in 0 1; do
        gappa_agrees <<END
@floor = fixed<0, dn>;
r = 1b61 / (A - c) - e; # c: what a large area lost; e: the two roundings of the reciprocal
px = (M - m) * r;       # m: what the numerator lost
g = floor(px * D + 0.5);
X = 1b61 / A;
exact = M * X * D; # D: 2^-down
{ A in [2147483650, 1b32] /\\ c in [0, 1] /\\ e in [0, 1.5] /\\ m in [0, $excess] /\\ D in [1b-62, 1b-$((excess > 0 ? 29 : 22))]
  /\\ |px * D| <= 1b31 -> g - exact in [-9, 7] }
g - exact -> (g - (px * D + 0.5)) + 0.5 + (px * D) * ((r - X) / r) - m * X * D;
r - X -> X * c / (A - c) - e;
END
    done
}

# fx_rsqrt_norm: 2^45 / sqrt(m) to 2^-25 of itself, in each of the 192 intervals of m that share an entry of the table.
# S: sqrt(m); T, U, V: y S / 2^45 before and after the steps of Newton's; off: what a step rounds.
prove_rsqrt() {
    local table entry i=64
    constants fx/fx_root.c 'uint32_t y = (uint32_t)rsqrt_table[(m >> 24) - 64] << 22;'
    constants fx/fx_root.c 'for (int i = 0; i < 2; i++) {'
    constants fx/fx_root.c 'const uint32_t square = (uint32_t)(fx_mul_wide_u(y, y) >> 29); /* 2^61 / m */'
    constants fx/fx_root.c 'const int32_t e = (int32_t)(((uint32_t)1 << 29) - fx_mulhi_u32(m, square));'
    constants fx/fx_root.c 'y += (uint32_t)(fx_mul_wide((int32_t)y, e) >> 30);'
    table=$(sed -n '/rsqrt_table\[192\] = {/,/};/p' "$core/fx/fx_root.c" | sed 1d | tr -dc '0-9\n,' | tr ',' ' ')
    [ "$(wc -w <<<"$table")" = 192 ] || { echo "no table of 192 entries" && exit 1; }
    for entry in $table; do
        gappa_agrees <<END
@floor = fixed<0, dn>;
y = $entry * 1b22;
T = y * S * 1b-45;
square = floor(y * y * 1b-29);
part = floor(S * S * square * 1b-32);
e = 1b29 - part;
add = floor(y * e * 1b-30);
y1 = y + add;
U = y1 * S * 1b-45;
square1 = floor(y1 * y1 * 1b-29);
part1 = floor(S * S * square1 * 1b-32);
e1 = 1b29 - part1;
add1 = floor(y1 * e1 * 1b-30);
V = (y1 + add1) * S * 1b-45;
off = (add - y * e * 1b-30) - y * 1b-30 * ((part - S * S * square * 1b-32) + S * S * 1b-32 * (square - y * y * 1b-29));
off1 = (add1 - y1 * e1 * 1b-30) - y1 * 1b-30 * ((part1 - S * S * square1 * 1b-32) + S * S * 1b-32 * (square1 - y1 * y1 * 1b-29));
{ S in [$(awk -v m=$i 'BEGIN { printf "%.3f", sqrt(m * 2 ^ 24) - 0.001 }'), $(awk -v m=$((i + 1)) 'BEGIN { printf "%.3f", sqrt(m * 2 ^ 24) + 0.001 }')]
  -> U - 1 in [-0.01, 0.01] /\\ V - 1 in [-1b-25, 1b-25] }
U - 1 -> off * S * 1b-45 - (T - 1) * (T - 1) * (T + 2) / 2;
U -> 1 + (U - 1);
y1 -> U / S * 1b45;
V - 1 -> off1 * S * 1b-45 - (U - 1) * (U - 1) * (U + 2) / 2;
END
        i=$((i + 1))
    done
}

# fx_sqrt_u64. w - r^2 is below 2^41, and then r is less than 1.01 below the root and 0.01 above it: so the floor is r or
# a number beside it, and the remainder tells which. s: the root of the upper word; lo: the lower word; e: the error of
# fx_rsqrt_norm. (An estimate that is cut off at 2^29 - 1 is nearer to the root than it was.) In the second step R is the
# root of w, D what r lacks of it, h the error of y as 2^61 / R.
prove_sqrt_u64() {
    constants fx/fx_root.c 'const uint32_t estimate = fx_mulhi_u32((uint32_t)(w >> 32), y); /* 2^-3 sqrt(w), 2^28 .. 2^29 */'
    constants fx/fx_root.c 'uint32_t r = (estimate >> 29 != 0 ? ((uint32_t)1 << 29) - 1 : estimate) << 3;'
    constants fx/fx_root.c 'const int64_t error = (int64_t)(w - fx_mul_wide_u(r, r));'
    constants fx/fx_root.c 'r += (uint32_t)(fx_mul_wide((int32_t)(error >> #), (int32_t)y) >> #);' && local cut=${n[0]} down=${n[1]}
    constants fx/fx_root.c 'r += rest < 0 ? (uint32_t)-1 : rest > 2 * (int64_t)r;'
    gappa_agrees <<END
@floor = fixed<0, dn>;
estimate = floor(1b13 * s * (1 + e));
r = 8 * estimate;
error = s * s * 1b32 + lo - r * r;
{ s in [1b15, 1b16] /\\ lo in [0, 4294967295] /\\ |e| <= 1b-25 -> |error| <= 1b41 /\\ s * 1b16 - r in [-128, 136] }
error -> lo - (r - s * 1b16) * (r + s * 1b16);
r - s * 1b16 -> 8 * (estimate - 1b13 * s * (1 + e)) + 1b16 * s * e;
s * 1b16 - r -> -(r - s * 1b16);
r + s * 1b16 -> (r - s * 1b16) + 1b17 * s;
END
    gappa_agrees <<END
@floor = fixed<0, dn>;
error = D * (2 * R - D);
y = 1b61 / R * (1 + h);
part = floor(error * 1b-$cut);
step = floor(part * y * 1b-$down);
{ D in [-128, 140] /\\ R in [1b31, 1b32] /\\ |h| <= 1b-24 -> step - D in [-1.01, 0.01] }
step - D -> (step - part * y * 1b-$down) + (part - error * 1b-$cut) * y * 1b-$down + D * h - D * D / (2 * R) * (1 + h);
END
}

if [ "$name" = lines ]; then
    # shellcheck disable=SC2317 # the proofs call it
    gappa_agrees() { :; }
    for name in $(declare -F | sed -n 's/.* prove_//p'); do "prove_$name"; done
    exit
fi
declare -F "prove_$name" >/dev/null || { sed -n 's/^# \(Usage.*\)/\1/p' "$0" >&2 && exit 2; }
"prove_$name"
