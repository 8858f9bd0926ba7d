#!/usr/bin/env bash
# Builds the site of all pages and the C++ reference, whose warnings are errors:  site_test.sh PROGRAM; skipped (77) where Sphinx is not installed.
set -eu
if ! /usr/bin/python3 -c 'import sphinx, myst_parser' 2>/dev/null; then
  echo "skipped: needs Debian's python3-sphinx and python3-myst-parser"
  exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
program=$(realpath "$1")
bash "$(dirname "$0")/../../studies/docs/build" "$program" "$folder"
for page in index README keys checks studies/docs/tutorial studies/program/commands api/index; do
  [ -s "$folder/$page.html" ] || { echo "no $page.html"; exit 1; }
done
grep -q flank_mismatch_um "$folder/keys.html" || { echo "keys.html has not the keys of the program"; exit 1; }
grep -q 'href="../../api/index.html"' "$folder/studies/docs/tutorial.html" || { echo "no page leads to the C++ reference"; exit 1; }
grep -q '../lib/steady/README.html' "$folder/api/namespacedovetail_1_1steady.html" || { echo "a namespace has not its page"; exit 1; }
# Nothing a reader's browser would fetch from the network.
if grep -rlE '(src|href)="(https?:)?//[^"]*\.(js|css|woff2?)"' "$folder" --include='*.html'; then
  echo "these pages need the network"
  exit 1
fi
