#!/usr/bin/env bash
# Makes the page fit for use without a network; Trunk runs it at the end of every build.
#
# All that a page loads goes into one folder, named after what the build contains. A page therefore gets its files from
# its own build or not at all, whatever browsers, proxies or the service worker keep of other builds. Where a page can
# be found by itself, its files keep their names: the page, its text version, the icons, the manifest, sw.js.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
template=$here/sw.js
cd "${TRUNK_STAGING_DIR:?the folder of the build, which Trunk names}"
cp "$template" sw.js # here already, so that the build's name depends on it

sum=(sha256sum)
if ! command -v sha256sum >/dev/null; then sum=(shasum -a 256); fi # macOS
build=build-$(find . -type f -exec "${sum[@]}" {} + | LC_ALL=C sort | "${sum[@]}" | cut -c 1-16)

mkdir "$build"
for entry in *; do
    case $entry in
        "$build" | index.html | text.html | icon.svg | icons | manifest.webmanifest | sw.js) ;;
        *) mv "$entry" "$build/" ;;
    esac
done
# The addresses of files that move begin with "./", those of files that stay do not.
for page in index.html text.html; do
    sed "s|=\"\./|=\"./$build/|g" "$page" > "$build/$page"
    mv "$build/$page" "$page"
done

# What sw.js keeps: every file's address, and its checksum in the form that browsers check (bytes in base64).
files=$(find . -type f ! -name sw.js | LC_ALL=C sort)
{
    printf '"use strict";\nconst BUILD = "%s";\nconst FILES = {\n' "$build"
    while read -r file; do
        bytes=$("${sum[@]}" "$file" | cut -c 1-64 | sed 's/../\\x&/g')
        # A published page's address is its folder's; some servers redirect from index.html.
        printf '    "%s": "sha256-%s",\n' "${file%index.html}" "$(printf '%b' "$bytes" | base64)"
    done <<< "$files"
    printf '};\n'
    cat "$template"
} > sw.js
