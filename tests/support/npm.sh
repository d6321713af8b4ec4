# shellcheck shell=bash
# `. tests/support/npm.sh`: installs what the package.json in the folder $packages names into the folder $dir, or ends the
# test as skipped.
: "${dir:?}" "${packages:?}"
command -v node >/dev/null || { echo "no node: apt-get install nodejs" && exit 77; }
mkdir -p "$dir" || exit 1
if ! cmp -s "$packages/package.json" "$dir/package.json" || [ ! -d "$dir/node_modules" ]; then
    command -v npm >/dev/null || { echo "no npm: apt-get install npm" && exit 77; }
    rm -rf "$dir/package.json" "$dir/node_modules" "$dir/new"
    mkdir -p "$dir/new" && cp "$packages/package.json" "$dir/new/" || exit 1
    if ! timeout 120 npm install --prefix "$dir/new" --no-package-lock --ignore-scripts --no-audit --no-fund --fetch-retries=1 \
        >"$dir/npm.log" 2>&1; then
        echo "npm did not get what $packages/package.json names: $(grep -m1 'npm.*ERR\|npm error' "$dir/npm.log")" && exit 77
    fi
    mv "$dir/new/node_modules" "$dir/new/package.json" "$dir/" || exit 1
fi
