# Doxygen's input filter for headers: it makes their comments doc comments, so that headers need no marks of Doxygen's.
#   the first comment                 is about the file, and stays as it stands
#   a comment before declarations     is about those that follow it without an empty line between
#   a comment behind a declaration    is about that one
# Members without a comment are told of by that of their struct or enum. Calls of X-macros are left out.

function doc(text) { sub(/\/\*+/, "/**", text); return text }

# How many braces a line opens more than it closes.
function braces(text) { gsub(/\/\*.*/, "", text); return gsub(/{/, "", text) - gsub(/}/, "", text) }

# The first comment of the file: a picture of characters may be in it.
function about_file(text) {
    gsub(/^\/\*[ \n]*(\* )?|[ \n]*\*\/$/, "", text)
    gsub(/\n ?\* ?/, "\n", text)
    return "/** @file\n@verbatim\n" text "\n@endverbatim */"
}

# Constants of an enum in one line, one a line, each with its comment.
function constants(text,    head, tail, parts, n, i, out) {
    head = tail = text
    sub(/{.*/, "{", head); sub(/^[^}]*/, "", tail)
    sub(/^[^{]*{/, "", text); sub(/}.*/, "", text)
    n = split(text, parts, ",")
    for (i = 1; i <= n; i++) { out = out "\n" parts[i] (i < n ? "," : "") " /**< See enum " name ". */" }
    return head out "\n" tail
}

# A line of a type: each member of `int a, b;` gets the comment behind the line, the one above it, or that of the type.
function members(code, behind,    type, parts, n, i, above) {
    above = told
    told = ""
    if (code !~ /[;,]$|^ +[A-Z_0-9]+( = [^,]*)?$/) { return above code " " behind }
    if (behind == "" && above == "") { behind = "/**< See " name ". */" }
    if (code !~ /^ +(const |struct |enum )*[a-z0-9_]+ [^()]*, [^()]*;$/) { return above code " " behind }
    type = code
    sub(/^ +/, "", type)
    match(type, /^(const |struct |enum )*[a-z0-9_]+ /)
    type = substr(type, 1, RLENGTH)
    sub(/^ +(const |struct |enum )*[a-z0-9_]+ /, "", code); sub(/;$/, "", code)
    n = split(code, parts, /, */)
    code = ""
    for (i = 1; i <= n; i++) { code = code above type parts[i] "; " behind "\n" }
    return code
}

{ sub(/\r$/, "") }

unfinished { # a comment, or one behind code, that goes on in this line
    $0 = unfinished "\n" $0
    unfinished = ""
}

/\/\*/ && !/\*\// { unfinished = $0; next }

/^[ \t]*\/\*/ && /\*\/[ \t]*$/ {
    if (!seen++) { print about_file($0); next }
    if (/clang-format/) { next }
    if (/\/\* ----/) { above = ""; next }
    if (depth == 0) { above = doc($0) "\n" } else if (kind == "type") { told = doc($0) "\n" } else { print }
    next
}

/^[ \t]*$/ { told = ""; if (depth == 0) { above = "" }; print; next }
/^#(if|el|en|in|un)/ || /^extern "C"/ || (/^}$/ && depth == 0) { print; next }
/^[A-Z_]+\([A-Z_a-z]*\)$/ { next }

{
    line = $0
    first = depth == 0 && !goes_on
    if (first) {
        macro = /^#/
        kind = line ~ /^(typedef )?(struct|union|enum)[^()=]*{/ ? "type" : "body"
        if (kind == "type") { name = line; sub(/ {(.|\n)*/, "", name); sub(/^(enum|struct) /, "", name) }
    }
    code = comment = line
    if (match(line, /\/\*/) && line !~ /\\$/) {
        code = substr(line, 1, RSTART - 1); sub(/ +$/, "", code)
        comment = substr(line, RSTART); sub(/\/\*+ ?/, "/**< ", comment)
    } else { comment = "" }
    if (kind == "type" && depth > 0 && code !~ /^}/) { print members(code, comment) }
    else {
        if (first) { printf "%s", above }
        told = ""
        if (kind == "body" && depth > 0) { print line }
        else { print (code ~ /^enum .*}/ ? constants(code) : code) (comment == "" ? "" : " " comment) }
    }
    depth += braces(code)
    goes_on = depth == 0 && (code ~ /\\$/ || (!macro && code !~ /[;}]$/))
}
