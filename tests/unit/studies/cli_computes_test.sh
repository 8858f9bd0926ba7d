#!/usr/bin/env bash
# The commands that compute, on a coarse mesh:  cli_computes_test.sh PATH_OF_DOVETAIL
# A model file answers as the study it was reduced from, JSON has standard output to itself, a run can be resumed, and
# best.toml evaluates to the journal's best design.
set -u
dovetail=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

fail() { echo "FAILED: $*"; head -20 err; failures=$((failures + 1)); }
expect() {
  local status=$1
  shift
  "$dovetail" "$@" > out 2> err < /dev/null
  local got=$?
  [ "$got" = "$status" ] || fail "dovetail $* gave status $got, not $status"
}
is_json() {
  if command -v python3 > /dev/null; then
    python3 -m json.tool out > /dev/null || fail "standard output is not JSON alone"
  else
    [ "$(head -c 1 out)$(tail -c 2 out)" = "{}" ] || fail "standard output is not JSON alone"
  fi
}
same() { cmp -s "$1" "$2" || fail "$1 and $2 differ"; }

"$dovetail" new full.toml > /dev/null || exit 1
# Few elements, half the sectors for half the nodal diameters in the report, few designs.
sed -e 's/^flank_elements = .*/flank_elements = 6/' -e 's/^bulk_size_mm = .*/bulk_size_mm = 12/' \
  -e 's/^fillet_fraction = .*/fillet_fraction = 0.6/' -e 's/^aerofoil_elements = .*/aerofoil_elements = 4/' \
  -e 's/^sectors = .*/sectors = 24/' -e 's/^flank_grading = .*/flank_grading = 4/' \
  -e 's/^max_evaluations = .*/max_evaluations = 3/' -e 's/^verify = .*/verify = 1/' -e 's/^formats = .*/formats = ["dxf", "svg", "vtu"]/' full.toml > s.toml

expect 0 evaluate s.toml --json -; is_json; cp out again.json
for key in status feasible parameters responses constraints error_estimates model timings_s; do
  grep -q "\"$key\"" again.json || fail "evaluate has no $key"
done
{ cat s.toml; printf '[[constraint]]\nresponse = "asymptotic_wear_volume_m3"\nupper = 1e-12\n'; } > limited.toml
expect 0 evaluate limited.toml --unworn --json -; is_json; cp out unworn.json
if command -v python3 > /dev/null; then
  python3 - <<'PYTHON' || fail "evaluate --unworn does not give what the joint does before it wears, and that alone"
import json
assert json.load(open("unworn.json"))["undecided_constraints"] == ["asymptotic_wear_volume_m3:upper"]
limits = json.load(open("unworn.json"))["constraints"]
assert "contact_pressure_mean_pa:upper" in limits and limits == json.load(open("again.json"))["constraints"]
unworn, whole = json.load(open("unworn.json"))["responses"], json.load(open("again.json"))["responses"]
assert all(whole[name] == value for name, value in unworn.items())
worn = ("asymptotic", "resonance_drift", "worn")
assert {name for name in whole if not name.startswith(worn)} == set(unworn)
PYTHON
fi
# Through a resonance while the static part of the contact creeps by many times its vibration.
expect 0 response full.toml --from 470 --to 490 --points 4 --arclength --json -; is_json; cp out curve.json
if command -v python3 > /dev/null; then
  python3 -c 'import json; assert len(json.load(open("curve.json"))["frequency_hz"]) < 300' ||
    fail "a response curve takes more than twice the points its outputs need"
fi
# Without an answer a design is infeasible, whether or not the study has limits.
awk '/^\[/ { terms = /^\[\[/ } !terms' s.toml > plain.toml
for study in s plain; do
  expect 3 evaluate $study.toml --no-bars --set solver.max_jacobians=1
  grep -q "^feasible *no" out || fail "a design of $study.toml without an answer is feasible"
done
expect 2 evaluate s.toml --set geometry.neck_width_mm=60 --json -; is_json
grep -q infeasible out || fail "an impossible neck is not infeasible"

expect 0 reduce s.toml -o m.h5; [ -s m.h5 ] || fail "no m.h5"
expect 0 response s.toml --from 490 --to 470 --points 3 --json -; is_json; cp out study.json
expect 0 response m.h5 --from 490 --to 470 --points 3 --json -; is_json; same out study.json
expect 0 export s.toml --format matrix-market -o mm.toml; [ -s mm.stiffness.mtx ] || fail "no mm.stiffness.mtx"
expect 0 response mm.toml --from 490 --to 470 --points 3 --json -; is_json; same out study.json
expect 0 import mm.toml -o again.h5
expect 0 response again.h5 --from 490 --to 470 --points 3 --json -; is_json; same out study.json
expect 0 wear s.toml --method asymptote --json -; is_json; cp out study.json
expect 0 wear m.h5 --method asymptote --json -; is_json; same out study.json
expect 0 wear m.h5 --method history --frequency 480 --cycles 1000 --json -; is_json
grep -q '"frequency_hz": 480.0' out || fail "the frequency asked for is not the one answered"
expect 3 wear m.h5 --method history --steps 1 --json -; is_json
# A history cut short goes on where it was; the implicit one ends at the same volume.
expect 3 wear m.h5 --method history --steps 20 --json part.json
expect 0 wear m.h5 --method history --resume part.json --json rest.json --curves 2 --curve-points 4
expect 0 wear m.h5 --method history --json whole.json
expect 0 wear m.h5 --method history --integrator implicit --history-tolerance 1e-3 --json implicit.json
if command -v python3 > /dev/null; then
  python3 - << 'END' || fail "resumed, whole and implicit histories disagree"
import json
part, rest, whole, implicit = (json.load(open(f + ".json")) for f in ("part", "rest", "whole", "implicit"))
assert rest["cycles"][:len(part["cycles"])] == part["cycles"] and len(rest["cycles"]) == len(whole["cycles"]) and rest["history"]["resumed_from"] == "part.json"
assert rest["history"]["increment_m"] == part["history"]["increment_m"]
assert len(rest["depths_m"]) == len(rest["cycles"]) == len(rest["wear_rates_m_per_cycle"])
assert [len(c["amplitude_m"]) for c in rest["response_curves"]] == [4, 4]
assert implicit["history"]["integrator"] == "implicit" and implicit["history"]["tolerance"] == 1e-3
for other, tolerance in (rest, 1e-6), (implicit, 1e-3):  # residuals of steady states; local errors of the integrator
    assert abs(other["final_worn_volume_m3"] / whole["final_worn_volume_m3"] - 1) < tolerance
END
fi
expect 2 wear m.h5 --method history --resume s.toml --json -
expect 2 wear m.h5 --method history --integrator implicit --history-tolerance 0 --json -
expect 2 wear m.h5 --method asymptote --history-tolerance 0 --json -
# Under a threshold nodes come to rest in slip: the history takes implicit steps unless it is told otherwise.
energy="--set contact.wear_law=energy --set contact.energy_threshold_j_per_m2=1"
# shellcheck disable=SC2086
{
  expect 0 wear s.toml $energy --method history --json -; is_json
  grep -q '"integrator": "implicit"' out || fail "a history under a threshold takes increments of depth"
  expect 2 check s.toml $energy --set contact.wear_coefficient_per_pa=5e-13
}
expect 2 wear m.h5 --method asymptote --integrator implicit --json -
expect 0 wear m.h5 --method asymptote --json -
grep -q '"holds": true' out || fail "the certificate is not checked at finer settings"
expect 0 wear m.h5 --method asymptote --spread --json -; is_json
for key in wear_coefficient friction load combined members profile_change; do
  grep -q "\"$key\"" out || fail "the spread has no $key"
done
expect 0 wear m.h5 --method asymptote --follow band --band-from 470 --band-to 490 --band-points 3 --json -; is_json
for key in worst_frequency_hz envelope_depth_m; do grep -q "\"$key\"" out || fail "the band has no $key"; done
expect 0 wear s.toml --method asymptote --follow resonance --json -; is_json; cp out study.json
expect 0 wear s.toml --method asymptote --set loading.follow=resonance --json -; is_json; same out study.json
grep -q '"follow": "resonance"' out || fail "the answer does not say what drives the wear"
expect 2 reduce s.toml -o missing/m.h5

expect 0 run s.toml -o o; cp out first
for file in journal.jsonl verification.jsonl best.toml results.h5 report.html best.dxf best.svg best.vtu study.toml; do
  [ -s "o/$file" ] || fail "no o/$file"
done
expect 0 check o/best.toml
expect 0 run s.toml -o o --resume; same out first
grep -q 'this run is finished' err || fail "a finished run is not known to be"
rm o/report.html
expect 0 run s.toml -o o --resume
grep -q '3 of them stored before' out || fail "the resumed run computed again"
[ -s o/report.html ] || fail "the resumed run made no report"
# The directory of a run stands for its best design.
expect 0 reduce o -o best.h5; grep -q 'of this run the best design is taken, o/best.toml' err || fail "it is not said what is reduced"
[ -s best.h5 ] || fail "no best.h5"
expect 0 response o --from 470 --to 490 --points 2 --json -; is_json
expect 0 wear o --method asymptote --json -; is_json
expect 0 backbone o --over force --from 1 --to 1 --points 1 --json -; is_json
expect 0 evaluate o --no-bars --no-history --json -; is_json
expect 0 runs . --csv runs.csv; grep -q '^ *1  *./o ' out || fail "runs does not list o"
[ "$(wc -l < runs.csv)" = 2 ] || fail "runs.csv has not one run"
expect 2 merge o -o o
expect 0 merge o o -o merged
expect 0 run s.toml -o merged --resume --jobs 2
grep -q '3 of them stored before' out || fail "the merged run has not what was computed"
grep -q 'in [0-9] of 8 other conditions' out || fail "the run does not say how far its design holds"
cp o/best.toml best.toml
expect 0 evaluate best.toml --json best.json
if command -v python3 > /dev/null; then
  python3 - <<'PYTHON' || fail "best.toml does not evaluate to the journal's best design"
import json
records = [json.loads(line)["record"] for line in open("o/journal.jsonl")][1:]
least = min((r for r in records if r["feasible"]), key=lambda r: r["responses"]["asymptotic_wear_volume_m3"])
best = json.load(open("best.json"))["responses"]
# A candidate of a search is computed as far as its objective and limits need it.
assert least["responses"] and all(best[name] == value for name, value in least["responses"].items())
PYTHON
fi
expect 0 report o -o page.html; same page.html o/report.html
expect 0 export o --format vtu -o f.vtu; same f.vtu o/best.vtu
expect 0 export o --format dxf -o f.dxf
expect 0 export o --format matrix-market -o best_model.toml
expect 0 backbone s.toml --over force --from 1 --to 2 --points 2 --json -; is_json
expect 0 evaluate s.toml --harmonics auto --samples auto --accuracy 0.01 --json -; is_json

# Every point of a front is a study of its own that evaluates to what is said of it.
sed -e '/^weight = 1$/d' -e 's/^algorithm = .*/algorithm = "nsga2"/' -e 's/^population = .*/population = 8/' \
  -e 's/^max_evaluations = .*/max_evaluations = 16/' -e 's/^verify = .*/verify = 0/' -e 's/^finer_meshes = .*/finer_meshes = 0/' \
  -e 's/^departures = .*/departures = false/' -e 's/^front_points = .*/front_points = 3/' s.toml > front.toml
printf '[[objective]]\nresponse = "peak_amplitude_m"\n' >> front.toml
expect 0 check front.toml; grep -q "2 objectives for a front" out || fail "check does not say that it is a front"
expect 0 run front.toml -o front --jobs 2
expect 0 evaluate front/front/point_01.toml --no-bars --no-history --json -; is_json; cp out point.json
expect 0 export front/front/point_01.toml --format dxf -o point.dxf
grep -q "<h2>Front</h2>" front/report.html || fail "the report shows no front"
if command -v python3 > /dev/null; then
  python3 - <<'PYTHON' || fail "front.csv does not say what its points evaluate to"
import csv, json
rows, point = list(csv.DictReader(open("front/front.csv"))), json.load(open("point.json"))
wear, amplitude = ([float(row[name]) for row in rows] for name in ("asymptotic_wear_volume_m3", "peak_amplitude_m"))
assert wear == sorted(wear) and amplitude == sorted(amplitude, reverse=True) and len(rows) > 1, rows
assert rows[0]["study"] == "front/point_01.toml" and float(rows[0]["peak_amplitude_m_bar"]) > 0
for name in ("asymptotic_wear_volume_m3", "peak_amplitude_m"):
    assert float(rows[0][name]) == point["responses"][name], (rows[0], point)
PYTHON
fi

# A case of load is what the study would be with its keys.
{ cat s.toml; printf '\n[[case]]\nname = "a"\n[[case]]\nname = "b"\n"loading.tip_force_n" = 1.5\n'; } > cases.toml
expect 0 evaluate cases.toml --no-bars --no-history --json cases.json
expect 0 evaluate s.toml --no-bars --no-history --set loading.tip_force_n=1.5 --set 'solver.prestress="shared"' --json b.json
if command -v python3 > /dev/null; then
  python3 - <<'PYTHON' || fail "a case is not what the study would be with its keys"
import json
whole, alone = json.load(open("cases.json")), json.load(open("b.json"))
responses = {c: whole["cases"][c]["responses"] for c in "ab"}
mission = {c: {k: responses[c].pop(k) for k in list(responses[c]) if k.startswith("mission_")} for c in "ab"}
assert responses["b"] == alone["responses"], (responses["b"], alone["responses"])
# All cases together wear off at least as much as each of them.
volume = whole["responses"]["mission_wear_volume_m3"]
assert all(mission[c]["mission_wear_volume_m3"] == volume for c in "ab"), mission
assert volume >= 0.99 * max(responses[c]["asymptotic_wear_volume_m3"] for c in "ab"), (volume, responses)
assert whole["responses"]["mission_drift"] == mission["a"]["mission_drift"] != mission["b"]["mission_drift"], mission
objective, = whole["objective"]
worst = max(responses[c]["asymptotic_wear_volume_m3"] for c in "ab")
assert objective["over"] == "worst" and abs(objective["value"] - worst) <= 1e-12 * worst, (objective, worst)
assert objective["error_estimate"] is None, objective
assert whole["mission"]["loads"] == 2 and not any(k.startswith("mission") for k in whole["model"]), whole["mission"]
PYTHON
fi

# An accuracy is asked of the responses that the study names, as far as they are known at all, and what it comes to is
# told with what settings do not buy.
grep -v -e '^harmonics' -e '^samples' s.toml > free.toml
expect 0 evaluate free.toml --set solver.accuracy=0.5 --json -; is_json; cp out accurate.json
expect 0 evaluate free.toml --set solver.accuracy=0.5 --unworn --json -; is_json; cp out unworn.json
if command -v python3 > /dev/null; then
  python3 - <<'PYTHON' || fail "evaluate does not tell what the accuracy asked for came to"
import json
worn, unworn = (json.load(open(name))["accuracy"] for name in ("accurate.json", "unworn.json"))
assert worn["status"] == unworn["status"] == "converged"
assert worn["response"] == worn["whole_bar"]["response"] == "asymptotic_wear_volume_m3"
assert worn["whole_bar"]["relative_bar"] >= worn["relative_bar"] > 0
assert unworn["response"] == "contact_pressure_mean_pa" and "whole_bar" not in unworn
PYTHON
fi
"$dovetail" reduce free.toml -o free.h5 --set solver.accuracy=0.5 2>&1 > /dev/null | grep -q "solver.accuracy chooses nothing here" ||
  fail "reduce does not say that it takes the settings of the file"

[ "$failures" = 0 ] && echo "all passed"
exit "$((failures > 0))"
