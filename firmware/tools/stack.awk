# Reads gcc's call graphs (-fcallgraph-info=su) and the sources that they name. Prints a line for each recursion, each dynamic
# stack frame, each call through a pointer of which nobody says what it reaches, and each path of more than `most` bytes.
# Variables (-v):
#   list=1             the last line is "worst BYTES FUNCTION"
#   of=FILE:FUNCTION   that line is about the paths from this function (of another core, say)
#   library=BYTES      counted for each call of a function without a graph (libgcc, libc)
#
# A call through a pointer, p(..) or x->p(..), reaches all functions that are called as p. These are what a source writes
# into a member of that name (.p = function, x->p = function), and the functions that say so behind their parameters, because
# they are given away as arguments:
#     static void blur_share(void *argument) /* called as run */
# Where a pointer has no name, or the name tells too little, the line of the call says what it reaches, or the function that
# calls does behind its parameters: /* calls run, ahead */. What the chip calls is called as vector, and what lies in no image
# is rom. A function that is given away and says nothing is a line, too, and so is one
# of somebody's own program that is called as no pointer's name. (Of those here test_house.sh says so: an image for one core
# calls less.)

function after(key) { match($0, key ": \"[^\"]*\""); return substr($0, RSTART + length(key) + 3, RLENGTH - length(key) - 4) }

# The source's lines, once: line[file, n], as it is; code[file, n], without comments and strings.
function read(file,    n, text, comment, at) {
    if (file in lines) { return }
    lines[file] = 0
    while ((getline text < file) > 0) {
        line[file, ++n] = text
        gsub(/"([^"\\]|\\.)*"/, "", text)
        if (comment) {
            if (!(at = index(text, "*/"))) { code[file, n] = ""; continue }
            text = substr(text, at + 2)
            comment = 0
        }
        while (at = index(text, "/*")) {
            if (match(substr(text, at), /\*\//) && RSTART > 1) { text = substr(text, 1, at - 1) " " substr(text, at + RSTART + 1) }
            else { text = substr(text, 1, at - 1); comment = 1 }
        }
        sub(/\/\/.*/, "", text)
        code[file, n] = text
    }
    close(file)
    lines[file] = n
}

# The names in a note of a line: "/* called as run, put */", of which `key` is "called as".
function noted(text, key) {
    if (!match(text, "/\\* " key " [a-z_0-9, ]*\\*/")) { return "" }
    text = substr(text, RSTART + length(key) + 4, RLENGTH - length(key) - 6)
    gsub(/[ ,]+/, " ", text)
    return text
}

# The notes behind a function's parameters.
function notes(f, key,    file, n, text) {
    file = home[f]
    read(file)
    for (n = row[f]; n <= lines[file] && n < row[f] + 12 && line[file, n] !~ /^\{/; n++) { text = text noted(line[file, n], key) }
    return text
}

function member(name, f) { if (!((name, f) in is_called)) { is_called[name, f]; called[name] = called[name] f "\n"; given[f] } }

# The function of that name that a file means; "" if there is none.
function meant(file, name) { return (file ":" name) in frame ? file ":" name : (name in frame ? name : "") }

# What a source writes into members, and what it gives away: a function's name without a call.
function look(file,    n, text, name, value, more, f, before) {
    read(file)
    for (n = 1; n <= lines[file]; n++) {
        text = code[file, n]
        if (text ~ /^ *#/) { continue }
        before = ""
        while (match(text, /[a-zA-Z_][a-zA-Z0-9_]*/)) {
            name = substr(text, RSTART, RLENGTH)
            before = before substr(text, 1, RSTART - 1)
            text = substr(text, RSTART + RLENGTH)
            if (text ~ /^ *=[^=]/ && before ~ /(\.|->)$/) {
                value = text
                for (more = n + 1; value !~ /[,;}]/ && more <= n + 3; more++) { value = value " " code[file, more] }
                sub(/^ *= */, "", value)
                sub(/[,;}].*/, "", value)
                writes(file, name, value)
            }
            f = meant(file, name)
            if (f != "" && text !~ /^ *\(/ && before !~ /(\.|->|struct |enum |union |goto )$/ && text !~ /^ *(=[^=]|:)/ && !is_local(file, n, name)) { away[f] = file ":" n }
            before = before name
        }
    }
}

# Whether a name is a variable or a parameter there: it is declared so in the function around the line.
function is_local(file, n, name) {
    for (; n > 0 && code[file, n] !~ /^}/; n--) {
        if (code[file, n] ~ ("(^|[^a-zA-Z0-9_>.])[a-z_][a-z_0-9]*( |( \\*+)(const )?)" name "( *[,;)=\\[]|$)") && code[file, n] !~ ("return " name)) { return 1 }
    }
    return 0
}

# A member gets a function, one of several, or what another member or a variable has.
function writes(file, name, value,    f, other) {
    if (value ~ /^ *[a-zA-Z_][a-zA-Z0-9_]*((\.|->)[a-zA-Z0-9_]+)* *$/) {
        other = value
        gsub(/.*[.>]| /, "", other)
        if (meant(file, other) == "" && other != name) { same[name] = same[name] other "\n" }
    }
    while (match(value, /[a-zA-Z_][a-zA-Z0-9_]*/)) {
        other = substr(value, RSTART, RLENGTH)
        value = substr(value, RSTART + RLENGTH)
        if ((f = meant(file, other)) != "" && value !~ /^ *\(/) { member(name, f) }
    }
}

# Adds to a function's calls what is called as one of these names.
function reaches(f, names,    n, i, name) {
    n = split(names, name, " ")
    for (i = 1; i <= n; i++) { reach(f, name[i]) }
}
function reach(f, name,    n, other, i) {
    if ((f, name) in reached) { return }
    used[name]
    reached[f, name]
    calls[f] = calls[f] called[name]
    n = split(same[name], other, "\n")
    for (i = 1; i < n; i++) { reach(f, other[i]) }
}

# A call through a pointer in f, in the statement that gcc says: by all pointers that it calls from there on.
function point(f, where,    at, text, name, names, before) {
    split(where, at, ":")
    read(at[1])
    text = line[at[1], at[2]]
    names = noted(text, "calls")
    if (names == "") { names = notes(f, "calls") }
    if (names != "") { reaches(f, names); return }
    text = substr(text, at[3])
    while (match(text, /[a-zA-Z_][a-zA-Z0-9_]*(\[[^\]]*\])?\(/)) {
        name = substr(text, RSTART, RLENGTH - 1)
        before = substr(text, 1, RSTART - 1)
        text = substr(text, RSTART + RLENGTH)
        sub(/\[.*/, "", name)
        if (before ~ /(\.|->)$/ || called[name] same[name] != "" || (before == "" && names == "" && meant(at[1], name) == "")) { names = names " " name }
    }
    if (names == "") { faults["call through a pointer: " where ": it has no name: say there whom it reaches, /* calls NAME */"] }
    reaches(f, names)
}

function depth(f,    i, n, callee, d, deepest) {
    if (f in known) { return known[f] }
    if (f in open) { print "recursion: " f; return 0 }
    if (!(f in frame)) { return library }
    open[f]
    n = split(calls[f], callee, "\n")
    deepest = 0
    for (i = 1; i < n; i++) { d = depth(callee[i]); if (d > deepest) { deepest = d } }
    delete open[f]
    return known[f] = frame[f] + deepest
}
/^graph:/ { source[after("title")] }
/^node:/ {
    if (match($0, /[0-9]+ bytes \([a-z,]*\)/)) {
        split(substr($0, RSTART, RLENGTH), word, " ")
        f = after("title")
        frame[f] = word[1]
        if (word[3] ~ /dynamic/) { print "dynamic stack: " f }
        split(after("label"), part, /\\n/)
        split(part[2], at, ":")
        home[f] = at[1]
        row[f] = at[2]
        source[at[1]]
    }
}
/^edge:/ {
    callee_name = after("targetname")
    caller = after("sourcename")
    if (callee_name == "__indirect_call") { pointers[++indirect] = caller; places[indirect] = after("label") } else { calls[caller] = calls[caller] callee_name "\n" }
}
END {
    for (f in frame) {
        n = split(notes(f, "called as"), name, " ")
        for (i = 1; i <= n; i++) { member(name[i], f); said[name[i]] = f }
    }
    for (s in source) { look(s) }
    for (f in away) { if (!(f in given)) { faults[away[f] ": " f " is given away: say behind its parameters what it is called as, /* called as NAME */, by the name of the pointer"] } }
    for (i = 1; i <= indirect; i++) { point(pointers[i], places[i]) }
    for (i in said) { if (i != "vector" && !(i in used) && home[said[i]] !~ /^(firmware|hal)\//) { faults[home[said[i]] ":" row[said[i]] ": " said[i] " is called as " i ", but no pointer of that name is called: correct the name"] } }
    for (f in faults) { print f }
    for (f in frame) {
        d = depth(f)
        if (of != "" && f != of) { continue }
        if (d > worst) { worst = d; who = f }
        if (most && d > most) { print "stack: " f " takes " d " bytes, " most " allowed" }
    }
    if (list) { print "worst " worst " " who } else { print "# deepest: " who ", " worst " bytes of stack" > "/dev/stderr" }
}
