#!/usr/bin/env bash
# The manifests follow the rules that registries publish: Arduino's library specification (library.properties), the ESP Component
# Registry's (idf_component.yml), PlatformIO's (library.json). And `make release` refuses what is no release.
# shellcheck disable=SC2317,SC2015,SC2016 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
dir=$(mktemp -d) && trap 'rm -rf "$dir"' EXIT
version=$(sed -n 's/^.define PH_VERSION "\(.*\)"/\1/p' firmware/core/status.h)
url=https://pinhole.example.org
eval "$(grep '^fill()' firmware/package/dist.sh)"
for name in library.properties idf_component.yml library.json; do
    VERSION=$version URL=$url fill "firmware/package/$name.in" >"$dir/$name"
    VERSION=$version URL='' fill "firmware/package/$name.in" >"$dir/without-$name"
done

# Prints what is wrong with a library.properties: each field once, of those that the specification names.
properties_wrong() { # file
    awk -F= '
        BEGIN { n = split("name version author maintainer sentence paragraph category url architectures", must, " ")
            kinds = "|Display|Communication|Signal Input/Output|Sensors|Device Control|Timing|Data Storage|Data Processing|Other|" }
        /^#/ || /^$/ { next }
        { value = substr($0, length($1) + 2); if ($1 in field) print $1 " twice"; field[$1] = value }
        $1 !~ /^(name|version|author|maintainer|sentence|paragraph|category|url|architectures|depends|includes|dot_a_linkage|precompiled|ldflags)$/ { print "no field: " $1 }
        END {
            for (i = 1; i <= n; i++) if (field[must[i]] == "") print "no " must[i]
            if (field["name"] !~ /^[A-Za-z0-9][A-Za-z0-9 _.-]*$/ || length(field["name"]) > 63 || tolower(field["name"]) ~ /^arduino/) print "name"
            if (field["version"] !~ /^[0-9]+\.[0-9]+\.[0-9]+$/) print "version"
            if (index(kinds, "|" field["category"] "|") == 0) print "category"
            if (field["url"] !~ /^https?:\/\/[^ ]+$/) print "url"
            if (field["includes"] !~ /^[A-Za-z0-9_]+\.h(,[A-Za-z0-9_]+\.h)*$/) print "includes"
            if (index(field["paragraph"], field["sentence"]) == 1) print "paragraph repeats sentence"
        }' "$1"
}

# ... with an idf_component.yml: version and targets of an IDF are needed, description and tags are limited, URLs are URLs.
component_wrong() { # file
    awk '
        /^[a-z_]+:/ { key = $1; sub(/:$/, "", key); value = $0; sub(/^[a-z_]+: */, "", value); gsub(/"/, "", value); field[key] = value }
        key !~ /^(version|description|license|url|repository|documentation|issues|discussion|tags|targets|dependencies|files|examples|maintainers|repository_info)$/ { print "no field: " key }
        key == "tags" && /^  - / { tags++; if ($2 !~ /^[A-Za-z0-9_-]+$/ || length($2) < 3 || length($2) > 32) print "tag " $2 }
        key == "dependencies" && /^  idf: *"[<>=~^]*[0-9]+(\.[0-9]+)*"$/ { idf = 1 }
        END {
            if (field["version"] !~ /^[0-9]+\.[0-9]+\.[0-9]+$/) print "version"
            if (length(field["description"]) < 10) print "description"
            if (field["license"] != "MIT") print "license"
            if (field["url"] !~ /^https?:\/\/[^ ]+$/) print "url"
            if (tags < 1) print "no tags"
            if (!idf) print "no idf"
        }' "$1"
}

# ... with a library.json. Node reads it as JSON where it is.
json_wrong() { # file
    ! command -v node >/dev/null || node -e 'JSON.parse(require("fs").readFileSync(process.argv[1]))' "$1" || echo "no JSON"
    awk '
        match($0, /^  "[a-z]+": /) { key = $0; sub(/^  "/, "", key); sub(/".*/, "", key); value = $0; sub(/^  "[a-z]+": *"?/, "", value); sub(/"?,?$/, "", value); field[key] = value }
        END {
            if (field["name"] == "" || length(field["name"]) > 100 || field["name"] ~ /[:;\/,@<>]/) print "name"
            if (field["version"] !~ /^[0-9]+\.[0-9]+\.[0-9]+$/ || length(field["version"]) > 20) print "version"
            if (field["description"] == "" || length(field["description"]) > 255) print "description"
            n = split(field["keywords"], words, /, */)
            for (i = 1; i <= n; i++) if (words[i] !~ /^[a-z0-9 +-]+$/ || length(words[i]) > 50) print "keyword " words[i]
            if (n < 1) print "no keywords"
            if (field["homepage"] !~ /^https?:\/\/[^ ]+$/ || length(field["homepage"]) > 255) print "homepage"
            if (field["license"] != "MIT") print "license"
        }' "$1"
}

follows() { [ -z "$("$1" "$2" | tee /dev/stderr)" ]; } # checker, file
told() { # checker, file, sed script, what it must say
    sed "$3" "$2" >"$dir/broken" && "$1" "$dir/broken" | grep -qx "$4"
}
no_address_is_told() {
    properties_wrong "$dir/without-library.properties" | grep -qx url && component_wrong "$dir/without-idf_component.yml" | grep -qx url &&
        json_wrong "$dir/without-library.json" | grep -qx homepage
}

refuses() { # words, environment...
    env VERSION="$version" B="$dir/b" "${@:2}" firmware/package/release.sh none >"$dir/said" 2>&1 && return 1
    grep -qF "$1" "$dir/said" && [ ! -e "$dir/b/release" ] || { cat "$dir/said"; return 1; }
}

# In a copy that is a repository of its own: without parts there are the changes of this version, and their checksum.
a_release_has_changes_and_checksums() {
    mkdir -p "$dir/tree/firmware" && cp -r firmware/package firmware/README.md "$dir/tree/firmware" && cd "$dir/tree" || return 1
    git init -q . && git add -A && git -c user.name=x -c user.email=x@y commit -qm x || return 1
    VERSION=$version URL=$url B=$dir/r firmware/package/release.sh none >"$dir/said" || return 1
    (cd "$dir/r/release" && sha256sum -c --strict SHA256SUMS) && grep -q '^- `PROFILE=small`' "$dir/r/release/CHANGES.md" && head -n 1 "$dir/r/release/CHANGES.md" | grep -qx "# Pinhole $version" || return 1
    VERSION=9.9.9 URL=$url B=$dir/r firmware/package/release.sh none >"$dir/said" 2>&1 && return 1
    grep -q 'no changes of 9.9.9' "$dir/said" && touch new || return 1
    VERSION=$version URL=$url B=$dir/r firmware/package/release.sh none >"$dir/said" 2>&1 && return 1
    grep -q 'changes that git does not have' "$dir/said"
}

check "library.properties_follows_Arduinos_rules" follows properties_wrong "$dir/library.properties"
check "idf_component.yml_follows_the_component_registrys_rules" follows component_wrong "$dir/idf_component.yml"
check "library.json_follows_PlatformIOs_rules" follows json_wrong "$dir/library.json"
check "a_category_that_is_none_is_told" told properties_wrong "$dir/library.properties" 's/=Display/=Graphics/' category
check "a_missing_sentence_is_told" told properties_wrong "$dir/library.properties" '/^sentence/d' 'no sentence'
check "a_field_of_ones_own_is_told" told component_wrong "$dir/idf_component.yml" 's/^license/licence/' 'no field: licence'
check "a_tag_of_two_letters_is_told" told component_wrong "$dir/idf_component.yml" 's/- graphics/- 3d/' 'tag 3d'
check "a_missing_idf_is_told" told component_wrong "$dir/idf_component.yml" '/idf:/d' 'no idf'
check "an_odd_version_is_told" told json_wrong "$dir/library.json" 's/"version": "/&v/' version
check "manifests_without_an_address_are_told" no_address_is_told
check "a_release_without_an_address_is_refused" refuses "URL=''" URL=
check "a_release_has_changes_and_checksums" a_release_has_changes_and_checksums
tap_end
