# Turns CSV (no quotes) into an array of JSON: an object a row, with the names of the first line as keys. Numbers stay
# numbers (.98 becomes 0.98), an empty cell is null, anything else is text. Lines with # are left out.
BEGIN { FS = ","; printf "[" }
/^#/ { next }
!names { names = split($0, name, ","); next }
{
    printf "%s\n{", (rows++ ? "," : "")
    for (i = 1; i <= names; i++) {
        value = $i
        if (value ~ /^-?\./) { sub(/\./, "0.", value) }
        if (value == "") { value = "null" }
        else if (value !~ /^-?(0|[1-9][0-9]*)(\.[0-9]+)?([eE][-+]?[0-9]+)?$/) { gsub(/["\\]/, "\\\\&", value); value = "\"" value "\"" }
        printf "%s\"%s\": %s", (i > 1 ? ", " : ""), name[i], value
    }
    printf "}"
}
END { print "\n]" }
