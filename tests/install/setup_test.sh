#!/usr/bin/env bash
# What set-up installs, with an apt-get and a dpkg-query that only write down what they are asked:  setup_test.sh
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/bin" "$scratch/bare"
for tool in bash dirname sed tr grep id mktemp tail rm; do ln -s "$(command -v $tool)" "$scratch/bare"; done
cp -P "$scratch/bare"/* "$scratch/bin"
printf '#!/bin/sh\necho not-installed\n' >"$scratch/bin/dpkg-query"
printf '#!/bin/sh\necho " $@ " >>"%s/asked"\n' "$scratch" >"$scratch/bin/apt-get"
printf '#!/bin/sh\nexec "$@"\n' >"$scratch/bin/sudo"
chmod +x "$scratch"/bin/{dpkg-query,apt-get,sudo}

fail() { echo "$1"; cat "$scratch/asked" 2>/dev/null; exit 1; }
set_up() { rm -f "$scratch/asked"; PATH=$scratch/$1 bash "$root/.setup/install" "${@:2}" >"$scratch/said" 2>&1; }
asks_for() { grep -qF -- " $1 " "$scratch/asked"; }

# The groups a script of the project names.
set_up bin studies && asks_for --no-install-recommends && asks_for g++ && asks_for libcgal-dev || fail "what building takes is not installed for studies"
for package in chromium clang-tidy-14 doxygen; do ! asks_for $package || fail "studies are set up with $package"; done
grep -qx 'bash .setup/install studies' "$root/studies/run" || fail "studies/run sets up more than studies take"
set_up bin && asks_for g++ && asks_for chromium && asks_for doxygen && asks_for clang-tidy-14 || fail "without a group not all is installed"
grep -qx 'bash .setup/install' "$root/tests/run" || fail "tests/run does not set up all"
set_up bin studies tests && asks_for chromium && ! asks_for doxygen || fail "two groups are not those two"

# What is there already is not asked for.
printf '#!/bin/sh\necho installed\n' >"$scratch/bin/dpkg-query"
set_up bin && [ ! -e "$scratch/asked" ] || fail "apt-get is asked for what is there"

! set_up bin browsers && grep -q 'no group browsers; there are: studies tests checks pages' "$scratch/said" || fail "a group that is not there is taken"
! set_up bare && [ "$(wc -l <"$scratch/said")" -eq 1 ] && grep -q 'has no apt-get' "$scratch/said" || fail "without apt-get it is not one sentence"
echo "set-up: each group is installed where it is asked for"
