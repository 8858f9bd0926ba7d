"""The program driven by others: schemas, Dakota's files, the UM-Bridge protocol, shells:  driven_test.py PROGRAM"""
import json
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import urllib.error
import urllib.request

import jsonschema

from coarse_runs import VARIABLES, coarse_study

program = str(pathlib.Path(sys.argv[1]).resolve())
studies = pathlib.Path(sys.argv[2])

STUDY = VARIABLES + """[[objective]]
response = "asymptotic_wear_volume_m3"
[[constraint]]
response = "peak_amplitude_m"
upper = 12e-3
"""


def answer(*arguments, folder=None, status=0):
    done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True)
    assert done.returncode == status, (arguments, done.returncode, done.stderr)
    return done.stdout


def wordless(schema, path=""):
    """Keys of which the schema does not say what they mean, and numbers without a unit."""
    for choice in (*schema.get("anyOf", []), *([schema["items"]] if "items" in schema else [])):
        yield from wordless(choice, path)
    for key, of in schema.get("properties", {}).items():
        number = any(choice.get("type") in ("number", "integer") for choice in (of, *of.get("anyOf", [])))
        if not of.get("description") or number != ("unit" in of):
            yield path + key
        yield from wordless(of, path + key + ".")


def check_schemas(folder):
    """Every study there is is one by the schema, and what is none is none; so are real answers."""
    schema = json.loads(answer("schema", "study"))
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    assert not list(wordless(schema)), list(wordless(schema))
    assert schema["properties"]["geometry"]["properties"]["flank_mismatch_um"]["unit"] == "um"
    files = sorted(studies.rglob("*.toml"))
    for template in ("section", "sector", "robust", "front"):
        answer("new", f"{template}.toml", "--template", template, folder=folder)
        files.append(folder / f"{template}.toml")
    assert len(files) > 7, files
    for file in files:
        errors = [error.message for error in validator.iter_errors(tomllib.loads(file.read_text()))]
        assert not errors, (file, errors)
    study = tomllib.loads((folder / "section.toml").read_text())
    for wrong in ({"geometry": study["geometry"] | {"neck_width_mm": -3}}, {"geometri": {}},
                  {"solver": study["solver"] | {"harmonics": 2.5}}, {"objective": [{"response": "beauty"}]},
                  {"contact": study["contact"] | {"wear_law": "none"}}):
        assert not validator.is_valid(study | wrong), wrong
    schema = json.loads(answer("schema", "evaluate"))
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    for options, status in ((["--no-bars"], 0), ([], 0), (["--set", "geometry.sectors=90"], 2)):
        real = json.loads(answer("evaluate", "study.toml", "--json", "-", *options, folder=folder, status=status))
        validator.validate(real)
    assert not validator.is_valid(real | {"feasible": "yes"})
    assert real["version"] == 1, real
    check_lists(folder)


def check_lists(folder):
    """Of materials and of runs: one that is finished, one that has a journal alone, one that is damaged."""
    for run, text in {"runs/torn": "torn", "runs/begun": None}.items():
        (folder / run).mkdir(parents=True)
        (folder / run / "study.toml").write_text((folder / "study.toml").read_text())
        if text:
            (folder / run / "journal.jsonl").write_text(text)
    once = ["--set", "optimizer.max_evaluations=1", "--set", "optimizer.verify=0", "--set", "optimizer.departures=false",
            "--set", "optimizer.finer_meshes=0", "--set", "optimizer.scan_evaluations=0"]
    subprocess.run([program, "run", "study.toml", "-o", "runs/done", *once], cwd=folder, capture_output=True, check=False)
    (folder / "runs/begun/journal.jsonl").write_text((folder / "runs/done/journal.jsonl").read_text())
    for command, name, of, count in ((["runs", "runs"], "runs", "status", 3), (["materials"], "materials", "name", 5)):
        schema = json.loads(answer("schema", name))
        jsonschema.Draft202012Validator.check_schema(schema)
        validator = jsonschema.Draft202012Validator(schema)
        real = json.loads(answer(*command, "--json", "-", folder=folder))
        validator.validate(real)
        assert real["version"] == 1 and len(real[name]) >= count, real
        assert not validator.is_valid(real | {"version": 2}) and not validator.is_valid(real[name])
        assert not validator.is_valid(real | {name: [{key: row[key] for key in row if key != of} for row in real[name]]})
        if name == "runs":
            assert [run["status"] for run in real["runs"]][::2] == ["unfinished", "damaged"], real


def check_dakota(folder):
    (folder / "params.in").write_text("1 variables\n8.75 geometry.neck_width_mm\n2 functions\n1 ASV_1:mass_kg\n"
                                      "1 ASV_2:peak_amplitude_m\n1 derivative_variables\n1 DVV_1:geometry.neck_width_mm\n"
                                      "0 analysis_components\n1 eval_id\n")
    quick = ["--no-bars", "--no-history"]
    answer("evaluate", "study.toml", *quick, "--dakota", "params.in", "results.out", folder=folder)
    lines = [line.split() for line in (folder / "results.out").read_text().splitlines()]
    direct = json.loads(answer("evaluate", "study.toml", *quick, "--set", "geometry.neck_width_mm=8.75", "--json", "-",
                               folder=folder))["responses"]
    assert [(float(value), name) for value, name in lines] == [(direct[name], name) for name in
                                                                ("mass_kg", "peak_amplitude_m")], lines
    (folder / "params.in").write_text((folder / "params.in").read_text().replace("1 ASV_1", "2 ASV_1"))
    answer("evaluate", "study.toml", *quick, "--dakota", "params.in", "results.out", folder=folder, status=3)
    assert (folder / "results.out").read_text().startswith("fail: derivatives"), (folder / "results.out").read_text()
    # What is no question, or a value that no design has, is a design that failed: no older answer stands for it.
    good = (folder / "params.in").read_text().replace("2 ASV_1", "1 ASV_1")
    for old, new, told in (("1 variables", "1e300 variables", "variables = 1e300: must be a whole number"),
                           ("2 functions", "-2 functions", "functions = -2: must be a whole number"),
                           ("1 variables", "variables", "is no line of a Dakota parameters file"),
                           ("1 ASV_1", "1.5 ASV_1", "ASV_1:mass_kg = 1.5: must be a whole number"),
                           ("8.75", "-3", "geometry.neck_width_mm=-3: must be > 0"),
                           ("8.75", "nan", "geometry.neck_width_mm=nan: must be a number > 0")):
        (folder / "params.in").write_text(good.replace(old, new, 1))
        (folder / "results.out").write_text("1 mass_kg\n")
        done = subprocess.run([program, "evaluate", "study.toml", *quick, "--dakota", "params.in", "results.out"],
                              cwd=folder, capture_output=True, text=True)
        result = (folder / "results.out").read_text()
        assert done.returncode == 2 and told in done.stderr, (new, done.stderr)
        assert result.startswith("fail: ") and told in result and len(result.splitlines()) == 1, result


def check_um_bridge(folder):
    server = subprocess.Popen([program, "serve", "study.toml", "--port", "0"], cwd=folder, stdout=subprocess.PIPE, text=True)
    try:
        place = server.stdout.readline().split(" at ")[1].split()[0]
        assert place.startswith("http://127.0.0.1:"), place

        def ask(path, request=None):
            body = None if request is None else json.dumps(request).encode()
            with urllib.request.urlopen(urllib.request.Request(place + path, data=body), timeout=120) as reply:
                return json.load(reply)

        info = ask("/Info")
        assert info["protocolVersion"] == 1.0, info
        name = info["models"][0]
        assert ask("/InputSizes", {"name": name, "config": {}}) == {"inputSizes": [2]}
        assert ask("/OutputSizes", {"name": name, "config": {}}) == {"outputSizes": [2]}
        about = ask("/ModelInfo", {"name": name})
        assert about["support"] == {"Evaluate": True, "Gradient": False, "ApplyJacobian": False, "ApplyHessian": False}
        output = ask("/Evaluate", {"name": name, "input": [[3.0, 8.75]], "config": {}})["output"]
        settings = [part for key, value in zip(about["inputs"], (3.0, 8.75)) for part in ("--set", f"{key}={value}")]
        direct = json.loads(answer("evaluate", "study.toml", "--no-bars", "--no-history", "--json", "-", *settings,
                                   folder=folder))["responses"]
        assert output == [[direct[response] for response in about["outputs"]]], (output, direct)
        try:
            ask("/Evaluate", {"name": name, "input": [[3.0]]})
            raise AssertionError("a wrong input is accepted")
        except urllib.error.HTTPError as error:
            assert error.code == 400 and json.load(error)["error"]["type"] == "InvalidInput"
    finally:
        server.terminate()
        server.wait()


def check_shells():
    script = answer("completion", "bash")
    complete = script + "\nCOMP_WORDS=(dovetail run s.toml --res); COMP_CWORD=3; _dovetail; echo \"${COMPREPLY[@]}\"" \
        "\nCOMP_WORDS=(dovetail exp); COMP_CWORD=1; _dovetail; echo \"${COMPREPLY[@]}\"" \
        "\nCOMP_WORDS=(dovetail new s.toml --template se); COMP_CWORD=4; _dovetail; echo \"${COMPREPLY[@]}\""
    done = subprocess.run(["bash", "-c", complete], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines() == ["--resume", "export", "section sector"], (done.stdout, done.stderr)
    assert answer("completion", "zsh").startswith("#compdef dovetail")
    page = answer("completion", "man")
    assert page.startswith(".TH DOVETAIL 1") and ".SS dovetail run" in page and "\\-\\-resume" in page


with tempfile.TemporaryDirectory() as name:
    work = pathlib.Path(name)
    coarse_study(program, work, STUDY)
    check_schemas(work)
    check_dakota(work)
    check_um_bridge(work)
    check_shells()
print("driven by others")
