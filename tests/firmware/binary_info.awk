# Usage: od -An -v -tu1 -w16 IMAGE.bin | awk [-v rp2350=1] -f tests/firmware/binary_info.awk
# Prints the binary information of an image as `picotool info` finds it: the header is looked for in the 256 bytes after
# boot2, of an RP2350 in the first 1024 bytes, and pointers are addresses in flash. A line an entry: `name Pinhole demos`, `pin 12 button up`.
{ for (i = 1; i <= NF; i++) { byte[n++] = $i } }
function word(at) { return byte[at] + 256 * (byte[at + 1] + 256 * (byte[at + 2] + 256 * byte[at + 3])) }
function pointer(at,    to) { to = word(at) - 268435456; if (to < (rp2350 ? 64 : 512) || to >= n) { print "a pointer leaves the image"; exit }; return to }
function text(at,    s) { for (s = ""; byte[at] != 0; at++) { s = s sprintf("%c", byte[at]) } return s }
function field(value, from, bits) { return int(value / 2 ^ from) % 2 ^ bits }
function names(mask, label,    pin) { for (pin = 0; pin < 30; pin++) { if (field(mask, pin, 1)) { print "pin", pin, label } } }
function functions(code,    i, pin, last) {
    for (i = 7; i < 32 && (i == 7 || field(code, i, 5) != last); i += 5) {
        last = field(code, i, 5)
        print "pin", last, "function", field(code, 3, 4)
    }
}
function entry(at,    type, id, name) {
    type = byte[at] + 256 * byte[at + 1]
    id = word(at + 4)
    name = sprintf("%.0f", id)
    if (byte[at + 2] != 82 || byte[at + 3] != 80) { print "not Raspberry Pi's" }
    else if (type == 5) { print (name in known ? known[name] : name), word(at + 8) }
    else if (type == 6) { print (name in known ? known[name] : name), text(pointer(at + 8)) }
    else if (type == 8) { functions(id) }
    else if (type == 9) { names(id, text(pointer(at + 8))) }
    else { print "type", type }
}
END {
    known["33758342"] = "name"; known["296336442"] = "version"; known["1760847326"] = "end"; known["1115025619"] = "attribute"
    known["3057450939"] = "board"; known["2139652833"] = "boot2"; known["2717168723"] = "feature"
    for (at = rp2350 ? 0 : 256; at < (rp2350 ? 1024 - 16 : 512); at += 4) {
        if (word(at) == 1904798706 && word(at + 16) == 3877282704) {
            if (word(pointer(at + 12)) != 0) { print "copies" }
            for (i = pointer(at + 4); i < pointer(at + 8); i += 4) { entry(pointer(i)) }
            exit
        }
    }
    print "no binary information"
    exit 1
}
