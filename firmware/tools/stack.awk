# Reads gcc's call graphs (-fcallgraph-info=su). Prints a line for each recursion, each dynamic stack frame, each call
# through a pointer that no rule covers, and each path of more than `most` bytes. Variables (-v):
#   list=1             the last line is "worst BYTES FUNCTION"
#   of=FILE:FUNCTION   that line is about the paths from this function (of another core, say)
#   library=BYTES      counted for each call of a function without a graph (libgcc, libc)
#
# rule(a, b) says what a call through a pointer may reach: from functions that match a, all functions that match b.
# Both are regular expressions over FILE:FUNCTION. rule(a, b, c): from functions that match a and not c. `ops` are the
# operations of struct hal_ops in backends; hal/panel calls backends and is none, whatever its functions are named.

BEGIN {
    demos = "firmware/app/demos/[a-z]*\\.c:"
    ops = "hal/[a-z0-9]+/[a-z0-9_/]*\\.c:[a-z0-9]+_(open|bus_clock|bus_write|bus_write_rows|bus_queue|bus_written|bus_until|bus_flush|bus_wait|write_ns|bus_read|pin_set|te_wait|time_us|delay_us|buttons|close)$"
    rules = 0
    rule("firmware/app/demos/parts\\.c:", demos "[a-z]*_band$")
    rule("firmware/app/runner\\.c:", demos "[a-z]*_(init|frame)$")
    rule("firmware/app/runner\\.c:", ops)
    rule("firmware/app/runner\\.c:", "hal/[a-z0-9]+/[a-z0-9_/]*\\.c:port_core_(run|join)$")
    rule("firmware/app/runner\\.c:", "hal/panel/[a-z_]*\\.c:sender_(begin|rows|end|forget)$")
    rule("firmware/app/self_test\\.c:", ops)
    rule("firmware/app/self_test\\.c:", "(firmware/app/images/[a-z]*\\.c:log_text|hal/[a-z0-9]+/[a-z0-9_/]*\\.c:port_log)$")
    rule("firmware/app/self_test\\.c:(self_test_report|measure_bus)", "hal/panel/[a-z_]*\\.c:sender_(begin|rows|end|forget)$")
    rule("firmware/app/self_test\\.c:self_test_report", "firmware/app/images/[a-z]*\\.c:log_facts$")
    rule("hal/[a-z0-9]+/[a-z0-9_/]*\\.c:(port_facts|put_[a-z_]*)(\\..*)?$", "firmware/app/images/[a-z]*\\.c:log_fact$")
    rule("hal/panel/[a-z_]*\\.c:", ops)
    rule("firmware/app/depthlab/[a-z_]*\\.c:", "firmware/app/images/[a-z]*\\.c:[a-z_]*put[a-z_]*$")
    rule("firmware/app/images/[a-z]*\\.c:", ops)
    rule("^(/|\\.|[^/]*:)", ops) # a program of one's own: APP=FILE.c
    shared = "firmware/core/(render|effects)/[a-z]*\\.c:(transform_part|cull_share|light_share|fog_share|set_up_fresh|draw_share|blur_share)(\\..*)?$"
    rule("firmware/core/(render/(bands\\.c:|cores\\.c:|mesh\\.c:|skin\\.c:|transform\\.c:)|effects/blur\\.c:)", "hal/[a-z0-9]+/[a-z0-9_/]*\\.c:port_core_(run|join)$", shared)
    rule("firmware/core/(render|effects)/[a-z]*\\.c:", shared, shared)
    rule("hal/[a-z0-9]+/[a-z0-9_/]*\\.c:", shared)
    each = "firmware/core/render/mesh\\.c:each_share(\\..*)?$" # core 0 takes it only while the runner waits for a scene
    rule("firmware/app/runner\\.c:", each)
    rule("firmware/core/render/mesh\\.c:", each)
    rule("hal/[a-z0-9]+/[a-z0-9_/]*cores2\\.c:serve$", "firmware/app/runner\\.c:make_ahead$")
    rule("hal/[a-z0-9]+/[a-z0-9_/]*cores2\\.c:serve$", each)
    rule("hal/[a-z0-9]+/[a-z0-9_/]*cores2\\.c:serve$", "hal/rp2[0-9]*/flash\\.c:stay$")
    rule("firmware/core/render/bands\\.c:", "firmware/core/render/blended\\.c:ph_draw_blended$", shared)
    rule("firmware/core/render/b[a-z]*\\.c:", "firmware/core/render/fog\\.c:fog_share$")
    rule("firmware/core/render/show\\.c:", "[:_]flush$") # the callback of ph_show: name it so, or ..._flush
}
function rule(a, b, c) { from[rules] = a; to[rules] = b; but[rules] = c; rules++ }
function after(key) { match($0, key ": \"[^\"]*\""); return substr($0, RSTART + length(key) + 3, RLENGTH - length(key) - 4) }
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
/^node:/ {
    if (match($0, /[0-9]+ bytes \([a-z,]*\)/)) {
        split(substr($0, RSTART, RLENGTH), word, " ")
        f = after("title")
        frame[f] = word[1]
        if (word[3] ~ /dynamic/) { print "dynamic stack: " f }
        place[f] = f
        if (f !~ /:/ && split(after("label"), line, /\\n/) > 1) { # not static: its file stands in the label
            sub(/:[0-9]+:[0-9]+$/, "", line[2])
            place[f] = line[2] ":" f
        }
    }
}
/^edge:/ {
    callee_name = after("targetname")
    caller = after("sourcename")
    if (callee_name == "__indirect_call") { pointers[caller] } else { calls[caller] = calls[caller] callee_name "\n" }
}
END {
    for (f in pointers) {
        ruled = 0
        for (r = 0; r < rules; r++) {
            if (place[f] !~ from[r] || (but[r] != "" && place[f] ~ but[r])) { continue }
            ruled = 1
            for (g in frame) { if (place[g] ~ to[r] && !(to[r] == ops && place[g] ~ /^hal\/panel\//)) { calls[f] = calls[f] g "\n" } }
        }
        if (!ruled) { print "call through a pointer: " place[f] }
    }
    for (f in frame) {
        d = depth(f)
        if (of != "" && f != of) { continue }
        if (d > worst) { worst = d; who = f }
        if (most && d > most) { print "stack: " f " takes " d " bytes, " most " allowed" }
    }
    if (list) { print "worst " worst " " who } else { print "# deepest: " who ", " worst " bytes of stack" > "/dev/stderr" }
}
