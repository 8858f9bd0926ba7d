#!/usr/bin/env bash
# The program as its users call it:  cli_test.sh PATH_OF_DOVETAIL
# Checks exit statuses, that every problem is one sentence on standard error, that nothing is left behind on wrong
# input, and that JSON has standard output to itself.
set -u
dovetail=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

fail() { echo "FAILED: $*"; sed 's/^/    out: /' out; sed 's/^/    err: /' err; failures=$((failures + 1)); }

# expect STATUS ARGUMENTS...: runs the program, leaving its output in the files out and err.
expect() {
  local status=$1
  shift
  "$dovetail" "$@" > out 2> err < /dev/null
  local got=$?
  [ "$got" = "$status" ] || fail "dovetail $* gave status $got, not $status"
}
says() { grep -qF -- "$1" err || fail "standard error does not say: $1"; }
answers() { grep -qF -- "$1" out || fail "standard output does not say: $1"; }
lines() { [ "$(wc -l < err)" = "$1" ] || fail "standard error has $(wc -l < err) lines, not $1"; }
silent() { [ ! -s out ] || fail "standard output is not empty"; }
absent() { [ ! -e "$1" ] || fail "$1 was left behind"; }

# Help and version
expect 0 --version; answers "dovetail "
expect 0 --help; answers "dovetail new mine.toml"
for command in run evaluate reduce response backbone wear import export report check new; do
  expect 0 "$command" --help; answers "$command"
done

# Wrong arguments: one line, status 2
expect 2; lines 1
expect 2 --bogus; lines 1
expect 2 bogus; lines 1; says "unknown command bogus"
expect 2 evalute x.toml; lines 1; says "unknown command evalute; did you mean evaluate?"
expect 2 check; lines 1
expect 2 check --bogus x.toml; lines 1; says "--bogus"
expect 2 wear x.toml --method guess; lines 1
expect 2 response x.toml --from 1 --to 2 --points many; lines 1
expect 2 response x.toml --from nan --to 2 --points 2; lines 1; says "--from = nan: must be > 0"
expect 2 response x.toml --from 1 --to -2 --points 0; lines 2; says "--to = -2: must be > 0"; says "--points = 0"
expect 2 response x.toml --from 1e308 --to 2 --points 2; lines 1; says "--from = 1e+308: must be > 0 and <= 1e+09"
expect 2 wear x.toml --method asymptote --follow band; lines 2; says "--band-from: is needed with --follow band"
expect 2 wear x.toml --method asymptote --band-from 1; lines 1; says "only has a meaning with --follow band"
expect 2 wear x.toml --method asymptote --frequency 0; lines 1; says "--frequency = 0: must be > 0"

# A new study is valid and not overwritten
expect 0 new s.toml
expect 0 check s.toml; answers "s.toml: valid; 3 variables, 1 objective, 2 constraints"; lines 0
cp s.toml kept.toml
expect 2 new s.toml; says "s.toml: exists already"; lines 1
cmp -s s.toml kept.toml || fail "new changed an existing file"
expect 0 check s.toml; answers "the start design fits"; answers " unknowns, about "; answers "the run: up to 100"
for template in section sector robust front; do
  expect 0 new $template.toml --template $template
  expect 0 check $template.toml --strict; lines 0; answers "$template.toml: valid"
done
cmp -s <(tail -n +6 s.toml) <(tail -n +6 section.toml) || fail "a section is not what new writes by default"
expect 2 new other.toml --template wheel; lines 1; says "wheel"; absent other.toml
expect 0 check s.toml --set scene.type=sector; says "sizes of a section are too fine in space"
expect 0 check s.toml --set geometry.sectors=90; says "the start design does not fit: "
expect 2 new missing/s.toml; says "does not exist"; lines 1

# Files that are no studies
: > empty.toml
head -c 400 s.toml > truncated.toml
head -c 5000 "$dovetail" > binary.toml
printf 'a = [1,\n' > broken.toml
for file in empty truncated binary broken; do
  for command in "check $file.toml" "evaluate $file.toml --json o.json" "run $file.toml -o o" \
    "reduce $file.toml -o o.h5" "response $file.toml --from 1 --to 2 --points 2 --json o.json" \
    "wear $file.toml --method asymptote --json o.json" "export $file.toml --format dxf -o o.dxf"; do
    # shellcheck disable=SC2086
    expect 2 $command; silent; says "$file.toml"
    for left in o o.json o.h5 o.dxf; do absent $left; done
  done
done
expect 2 check nowhere.toml; says "nowhere.toml: cannot be read: "; lines 1
expect 2 check .; says "it is a directory"; lines 1
expect 2 evaluate . --json -; says "not that of a run"; lines 1; silent
expect 2 runs .; says "holds no run"; lines 1
expect 2 evaluate nowhere.toml --json -; silent

# Each wrong value is one sentence with its line; several at once
sed 's/^neck_width_mm = .*/neck_width_mm = -3/' s.toml > wrong.toml
line=$(grep -n '^neck_width_mm' wrong.toml | cut -d: -f1)
expect 2 check wrong.toml; lines 1; says "wrong.toml:$line: geometry.neck_width_mm = -3: must be > 0"
sed -e 's/^neck_width_mm = .*/neck_width_mm = nan/' -e 's/^friction = .*/friction = "high"/' \
  -e 's/^tip_force_n/tip_force/' s.toml > wrong.toml
expect 2 evaluate wrong.toml --json out.json; lines 4; silent; absent out.json
says "geometry.neck_width_mm = nan"; says 'contact.friction = "high"'; says "did you mean loading.tip_force_n?"

# --set
expect 0 check s.toml --set geometry.neck_width_mm=9 --set solver.solver=newton --set contact.friction=0.4
expect 2 check s.toml --set geometry.neck_width_mm=-3; lines 1; says "--set geometry.neck_width_mm=-3: must be > 0"
expect 2 check s.toml --set geometry.neck_wdth_mm=3; lines 1; says "did you mean geometry.neck_width_mm?"
expect 2 check s.toml --set geometry --set =3; lines 2; says "must be KEY=VALUE"
expect 2 evaluate s.toml --harmonics 0; lines 1; says "--harmonics 0: must be >= 1"
expect 2 response s.toml --from 1 --to 2 --points 2 --tolerance nan; lines 1; says "--tolerance nan"

# check takes --set as run does, and says what the run would be.
expect 0 check s.toml --set optimizer.max_evaluations=7; answers "the run: up to 7 evaluations"
expect 0 check s.toml --set title=other --set 'export.formats=["csv"]'
for set in geometry.neck_width_mm=-3 geometry.neck_wdth_mm=3 optimizer.algorithm=luck 'export.formats=["dwg"]' variable=3 \
  'geometry=3' 'optimizer.max_evaluations=2.5'; do
  expect 2 check s.toml --set "$set"; cp err of_check
  expect 2 run s.toml -o o --set "$set"; absent o
  cmp -s err of_check || fail "run and check refuse --set $set in other words"
done
# What follows from the variables cannot be set.
{ cat s.toml; printf '\n[[linked]]\nkey = "geometry.shank_width_mm"\nvalue = "geometry_neck_width_mm + 4"\n'; } > linked.toml
expect 0 check linked.toml
for command in check evaluate "run -o o" "reduce -o o.h5"; do
  # shellcheck disable=SC2086
  expect 2 $command linked.toml --set geometry.shank_width_mm=12; lines 1
  says "geometry.shank_width_mm"; says "follows from the design variables and cannot be set"; absent o; absent o.h5
done

# The settings of the contact computation are keys of a study, too
expect 0 check s.toml --set solver.pseudo_penalty_n_per_m=1e8 --set solver.solver=powell_fd
expect 2 check s.toml --set solver.pseudo_penalty_n_per_m=-1; lines 1; says "must be >= 0"
expect 2 evaluate s.toml --pseudo-penalty -1; lines 1; says "--pseudo-penalty -1: must be >= 0"
expect 2 evaluate s.toml --solver guess; lines 1; says "--solver"
expect 2 evaluate s.toml --harmonics 3.5; lines 1; says "--harmonics 3.5: must be a whole number or auto"
expect 2 evaluate s.toml --accuracy 1e-3; lines 1; says "only has a meaning with --harmonics auto"
expect 2 backbone s.toml --from 0 --to 1 --points 0; lines 2; says "--from = 0: must be > 0"; says "--points = 0"
expect 2 import s.toml -o m.h5; lines 1; says "is not a reduced model"; absent m.h5

# The end of a range is inside it, whatever the units round to
expect 0 export s.toml --format dxf -o crown.dxf --set geometry.flank_crown_um=500

# An impossible geometry is an answer: its rules, not an error of the mesh
for impossible in geometry.sectors=90 geometry.bore_radius_mm=260; do
  expect 2 evaluate s.toml --set "$impossible" --json -; answers '"status": "infeasible"'
  says "s.toml: the design is infeasible: "
  expect 2 response s.toml --set "$impossible" --from 1 --to 2 --points 2; says "the design is infeasible: "; silent
done

expect 2 export s.toml --set geometry.sectors=90 --format step -o i.step; says "the design is infeasible: "; absent i.step
expect 0 export s.toml --set geometry.sectors=90 --format dxf -o i.dxf; says "the design is infeasible: "
for format in vtu pvd inp matrix-market; do
  expect 2 export s.toml --set geometry.sectors=90 --format $format -o i.toml; absent i.toml
  says "s.toml: the design is infeasible: "; grep -q "infeasible: ..*mm" err || fail "export --format $format names no rule"
done
expect 2 export s.toml --set geometry.sectors=90 --format stl --worn -o i.stl; absent i.stl
says "s.toml: the design is infeasible: "; grep -q "infeasible: ..*mm" err || fail "export --worn names no rule"
expect 3 evaluate s.toml --no-bars --set scene.speed_rpm=1e9; says "scene.speed_rpm = 1e+09 no equilibrium exists"
expect 3 reduce s.toml -o fast.h5 --set scene.speed_rpm=1e9; says "no equilibrium exists"; absent fast.h5

# What may not be read or written is said to be so. Others than root may not reach the program or its libraries.
as_nobody() { setpriv --reuid=65534 --regid=65534 --clear-groups "$dovetail" "$@"; }
if [ "$(id -u)" = 0 ] && as_nobody --version > /dev/null 2>&1; then
  mkdir locked && cp s.toml locked/s.toml && chmod 700 locked && chmod 755 .
  denied() { as_nobody "$@" > out 2> err < /dev/null
    [ $? = 2 ] || fail "dovetail $* is not refused"; says "ermission denied"; }
  denied check locked/s.toml
  denied evaluate locked
  denied new locked/t.toml
  denied run s.toml -o locked/run
  denied export s.toml --format dxf -o locked/s.dxf
  denied export s.toml --format step -o s.step
  denied runs locked
fi

# Model files
printf '\x89HDF\r\n\x1a\n and no more' > torn.h5
for file in torn.h5 nowhere.h5; do
  expect 2 response $file --from 1 --to 2 --points 2 --json -; silent; says "$file"
  expect 2 wear $file --method history --json o.json; silent; says "$file"; absent o.json
done
expect 2 response torn.h5 --from 1 --to 2 --points 2 --harmonics 201; lines 1; says "--harmonics 201: must be >= 1 and <= 200"
expect 2 wear torn.h5 --method asymptote --samples 2000000000 --tolerance 1; lines 2; says "--samples 2000000000: must be"
expect 2 wear torn.h5 --method asymptote --set contact.friction=1; lines 1; says "--set contact.friction=1"

# run: directories are not overwritten
mkdir full && touch full/mine
expect 2 run s.toml -o full; lines 1; says "full: exists already; give --resume"
expect 2 run s.toml -o s.toml; lines 1; says "s.toml: is not a directory"
sed '/^\[\[variable/,$d' s.toml > fixed.toml
expect 2 run fixed.toml -o o; says "has no [[variable]]"; absent o
sed '/^\[\[variable/,/^$/d' s.toml > judged.toml
expect 0 check judged.toml; answers "0 variables, 1 objective, 2 constraints"
expect 2 run judged.toml -o o; lines 1; says "has no [[variable]]"; absent o

# export and report
expect 0 export s.toml --format dxf -o s.dxf; [ -s s.dxf ] || fail "no s.dxf"
expect 0 export s.toml --format inp --nodal-diameter 2,3 --modes 4 -o s.inp
[ "$(grep -c '^\*SELECT CYCLIC SYMMETRY MODES' s.inp)" = 2 ] || fail "s.inp has not two nodal diameters"
for list in 1,,2 1,x 2, 1.5; do
  expect 2 export s.toml --format inp --nodal-diameter $list -o t.inp; lines 1; says "--nodal-diameter = $list: must be whole numbers separated by commas"; absent t.inp
done
expect 2 export s.toml --format inp --nodal-diameter 3000000000 -o t.inp; lines 1; says "too large"; absent t.inp
expect 2 export s.toml --format inp --nodal-diameter 24 -o t.inp; lines 1; says "--nodal-diameter = 24: must be 0 to 23 of 47 sectors"; absent t.inp
expect 2 export s.toml --format dxf --contact -o t.dxf; lines 1; says "must be inp"; absent t.dxf
expect 2 export s.toml --format dwg -o s.dwg; lines 1; says "must be one of dxf"; absent s.dwg
expect 2 export full --format dxf -o f.dxf; lines 1; says "holds no best design"; absent f.dxf
expect 2 export s.toml --format dxf -o missing/s.dxf; lines 1

[ "$failures" = 0 ] && echo "all passed"
exit "$((failures > 0))"
