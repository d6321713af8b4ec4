# Makes papers pages of Doxygen's, in the folder TO: their headings and the links between them get names that Doxygen knows.
# A link to a file that the site does not have becomes its text.

function slug(text) { text = tolower(text); gsub(/ /, "-", text); gsub(/[^a-z0-9_-]/, "", text); return text }
function folder(path) { return sub(/\/[^\/]*$/, "", path) ? path : "" }

# The name of a paper's page: firmware/README.md is firmware.
function page(path) { return path == "README.md" ? "top" : path ~ /\/README\.md$/ ? slug(folder(path)) : path == "firmware/package/docs/tutorial.md" ? "tutorial" : "" }

# A path relative to a folder, from the top.
function joined(base, path) {
    while (sub(/^\.\.\//, "", path)) { base = folder(base) }
    return base == "" ? path : base "/" path
}

function reference(target,    path, anchor) {
    if (target ~ /^[a-z]+:/) { return target }
    path = target; sub(/#.*/, "", path)
    anchor = target ~ /#/ ? target : ""; sub(/^[^#]*#/, "", anchor)
    path = path == "" ? here : joined(folder(here), path)
    if (path ~ /\.h$/ && index(HEADERS " ", path " ")) { sub(/.*\//, "", path); return "@ref " path }
    if (path ~ /^firmware\/package\/examples\/.*\.(c|h|cpp|ino)$/) { sub(/.*\//, "", path); return path }
    if (page(path) == "") { return "" }
    return "@ref " (anchor != "" ? page(path) "-" slug(anchor) : page(path) == "top" ? "index" : page(path))
}

# Text outside of code: what Doxygen would read as commands or as HTML is escaped.
function escaped(text) { gsub(/[@\\]/, "\\\\&", text); gsub(/</, "\\&lt;", text); gsub(/#/, "\\#", text); return text }

function linked(line,    out, text, target, picture, to) {
    while (match(line, /!?\[[^][]*\]\([^)]*\)/)) {
        out = out spans(substr(line, 1, RSTART - 1))
        text = substr(line, RSTART, RLENGTH); line = substr(line, RSTART + RLENGTH)
        picture = text ~ /^!/
        target = text; sub(/^.*\]\(/, "", target); sub(/\)$/, "", target)
        sub(/^!?\[/, "", text); sub(/\]\([^)]*\)$/, "", text)
        if (picture) { sub(/.*\//, "", target); out = out "<img src=\"" target "\" alt=\"" text "\">"; continue }
        to = reference(target)
        out = out (to == "" ? spans(text) : to ~ /^@ref|:/ ? "[" spans(text) "](" to ")" : "<a href=\"" to "\">" spans(text) "</a>")
    }
    return out spans(line)
}

function spans(line,    parts, n, i, out) {
    n = split(line, parts, "`")
    for (i = 1; i <= n; i++) { out = out (i > 1 ? "`" : "") (i % 2 ? escaped(parts[i]) : parts[i]) }
    return out
}

FNR == 1 { here = FILENAME; to_file = TO "/" page(here) ".md"; fence = 0 }
/^ *```/ { fence = !fence; if (fence) { sub(/```[a-z]*/, "```") } }
/^ *```/ || fence || /^    / { print >to_file; next }
/^#+ / {
    title = $0; sub(/^#+ /, "", title)
    level = $0; sub(/ .*/, "", level)
    print level " " spans(title) " {#" (level != "#" ? page(here) "-" slug(title) : page(here) == "top" ? "mainpage" : page(here)) "}" >to_file
    next
}
{ print linked($0) >to_file }
