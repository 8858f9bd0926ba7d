"""The Python module against the program, to the last bit:  module_test.py PATH_OF_DOVETAIL FOLDER_OF_THE_MODULE"""
import ast
import contextlib
import inspect
import io
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import tomllib
import unittest

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[3]
QUICKSTART = ROOT / "studies" / "quickstart" / "study.toml"
DOVETAIL, MODULE = sys.argv.pop(1), sys.argv.pop(1)
sys.path[:0] = [MODULE, str(ROOT / "studies" / "model_file")]
sys.dont_write_bytecode = True
import dovetail  # noqa: E402
import write_model  # noqa: E402

# A coarse section: half a second.
COARSE = {"mesh.flank_elements": 8, "mesh.fillet_fraction": 0.4, "mesh.bulk_size_mm": 8.0, "solver.harmonics": 3}
CASES = """
[[case]]
name = "cruise"
weight = 4

[[case]]
name = "climb"
"scene.speed_rpm" = 10500
"loading.tip_force_n" = 3
"""


class PythonModule(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def program(self, *arguments, status=0):
        done = subprocess.run([DOVETAIL, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def json(self, *arguments, status=0):
        return json.loads(self.program(*arguments, "--json", "-", status=status).stdout)

    def coarse(self, text=""):
        """A coarse quickstart with that at its end, and what the program needs to have the same."""
        path = self.folder / "study.toml"
        path.write_text(QUICKSTART.read_text() + text)
        study = dovetail.Study(path)
        for key, value in COARSE.items():
            study.set(key, value)
        return study, [path, *(f"--set={key}={value}" for key, value in COARSE.items())]

    def same(self, answer, expected):
        found = dict(answer)
        for values in (found, expected):
            values.pop("timings_s", None)
            for case in values.get("cases", {}).values():
                case.pop("timings_s", None)
        self.assertEqual(json.dumps(found), json.dumps(expected))

    def test_a_section_is_evaluated_to_the_same_bits(self):
        study, arguments = self.coarse()
        study.set("geometry.flank_mismatch_um", 5)
        answer = study.evaluate()
        self.same(answer, self.json("evaluate", *arguments, "--set=geometry.flank_mismatch_um=5"))
        self.assertTrue(answer.converged)
        self.assertEqual(answer.parameters["geometry.flank_mismatch_um"], 5)
        self.assertGreater(answer.responses["asymptotic_wear_volume_m3"], 0)
        self.assertGreater(answer["error_estimates"]["asymptotic_wear_volume_m3"], 0)
        self.assertIsInstance(answer.feasible, bool)
        self.assertIn("constraints", answer)
        with self.assertRaises(AttributeError):
            answer.gradients

    def test_a_study_with_cases_is_evaluated_to_the_same_bits(self):
        study, arguments = self.coarse(CASES)
        answer = study.evaluate(no_bars=True, no_history=True)
        self.same(answer, self.json("evaluate", *arguments, "--no-bars", "--no-history"))
        self.assertEqual(sorted(answer.cases), ["climb", "cruise"])

    def test_a_model_file_has_the_same_response_and_wear(self):
        path = self.folder / "rod.h5"
        write_model.write_model(path, write_model.rod(4))
        frequencies = ("--from", 0.3, "--to", 0.5, "--points", 5)
        expected = self.json("response", path, *frequencies, "--error-bars", "--harmonics", 7)
        for given in (path, dovetail.Model.read(path)):
            answer = dovetail.response(given, expected["frequency_hz"], error_bars=True, harmonics=7)
            self.same(answer, expected)
        expected = self.json("wear", path, "--method", "asymptote", "--frequency", 0.4)
        self.same(dovetail.wear(dovetail.Model.read(path), method="asymptote", frequency=0.4), expected)
        history = ("--method", "history", "--frequency", 0.4, "--steps", 3)
        answer = dovetail.wear(dovetail.Model.read(path), method="history", frequency=0.4, steps=3)
        self.assertFalse(answer.converged)
        self.same(answer, self.json("wear", path, *history, status=3))

    def test_a_reduced_model_is_the_one_that_the_program_writes(self):
        study, arguments = self.coarse()
        model, path = study.reduce(), self.folder / "model.h5"
        self.program("reduce", *arguments, "-o", path)
        model.write(self.folder / "ours.h5")
        with h5py.File(path) as theirs, h5py.File(self.folder / "ours.h5") as ours:
            names = []
            theirs.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) else None)
            for name in names:
                np.testing.assert_array_equal(ours[name][()], theirs[name][()], err_msg=name)
            np.testing.assert_array_equal(model.stiffness, theirs["/stiffness"][()])
            np.testing.assert_array_equal(model.contact.tangential, theirs["/contact/tangential"][()])
        self.assertEqual(len(model.contact), len(model.contact.area))
        self.same(dovetail.wear(study, method="asymptote"), self.json("wear", *arguments, "--method", "asymptote"))

    def test_arrays_are_views_that_keep_their_model(self):
        path = self.folder / "rod.h5"
        write_model.write_model(path, write_model.rod(2))
        model = dovetail.Model.read(path)
        stiffness, friction = model.stiffness, model.contact.friction
        self.assertTrue(np.shares_memory(stiffness, model.stiffness))
        friction[:] = 0.25
        np.testing.assert_array_equal(model.contact.friction, [0.25, 0.25])
        del model
        self.assertEqual(stiffness.shape, (6, 6))
        self.assertEqual(stiffness[0, 0], write_model.rod(2)["/stiffness"][0, 0])
        self.assertEqual(friction[1], 0.25)

    def test_a_model_that_was_spoilt_is_refused(self):
        path = self.folder / "rod.h5"
        write_model.write_model(path, write_model.rod(2))
        model = dovetail.Model.read(path)
        model.contact.area[1] = -1
        for use in (lambda: dovetail.wear(model, method="asymptote", frequency=0.4), lambda: model.write(path)):
            with self.assertRaisesRegex(dovetail.InputError, r"/contact/area\[1\] = -1: must be > 0"):
                use()

    def test_wrong_input_is_told_in_the_same_sentence(self):
        study, arguments = self.coarse()
        told = self.program("evaluate", *arguments, "--set=geometry.neck_width_mm=-3", status=2).stderr.strip()
        with self.assertRaises(dovetail.InputError) as caught:
            study.set("geometry.neck_width_mm", -3)
        sentence = next(line for line in told.splitlines() if "neck_width_mm" in line)
        self.assertIn(sentence, str(caught.exception).splitlines())
        study.evaluate(unworn=True)  # the study is as before
        told = self.program("check", self.folder / "none.toml", status=2).stderr.strip()
        with self.assertRaises(ValueError) as caught:
            dovetail.Study(self.folder / "none.toml")
        self.assertEqual(str(caught.exception), told)
        told = self.program("evaluate", *arguments, "--set=geometry.neck_width_mm=25", status=2).stderr.strip()
        study.set("geometry.neck_width_mm", 25)
        with self.assertRaises(dovetail.InputError) as caught:
            study.evaluate(no_bars=True)
        self.assertEqual(str(caught.exception), told)

    def test_keywords_are_checked(self):
        with self.assertRaisesRegex(TypeError, "no keyword harmonic; did you mean harmonics"):
            dovetail.response("model.h5", [1.0], harmonic=3)
        with self.assertRaisesRegex(dovetail.InputError, "--cycles = 5: only has a meaning with --method history"):
            dovetail.wear("model.h5", method="asymptote", cycles=5)
        with self.assertRaisesRegex(dovetail.InputError, "must be one of history, asymptote"):
            dovetail.wear("model.h5", method="nothing")
        with self.assertRaisesRegex(TypeError, "has the wrong type"):
            dovetail.wear("model.h5", method="asymptote", frequency="high")

    def test_what_does_not_converge_is_a_status(self):
        study, _ = self.coarse()
        study.set("solver.max_jacobians", 1)
        answer = study.evaluate(no_bars=True)
        self.assertFalse(answer.converged)
        self.assertTrue(answer.status.endswith("budget_spent"), answer.status)
        self.assertTrue(any("not converged" in remark for remark in answer.remarks), list(answer.remarks))

    def test_a_run_is_that_of_the_program_and_tells_of_every_evaluation(self):
        text = QUICKSTART.read_text().replace("scan_evaluations = 24", "scan_evaluations = 3")
        text = text.replace("max_evaluations = 90", "max_evaluations = 60\nverify = 0\ndepartures = false\nfiner_meshes = 0")
        path = self.folder / "study.toml"
        path.write_text(text)
        study = dovetail.Study(path)
        for key, value in COARSE.items():
            study.set(key, value)
        study.set("optimizer.max_evaluations", 6)
        heard = []
        answer = dovetail.run(study, self.folder / "ours", jobs=1,
                              callback=lambda number, evaluation, best: heard.append((number, evaluation, best)))
        self.assertEqual([number for number, _, _ in heard], [1, 2, 3, 4, 5, 6])
        self.assertIn("asymptotic_wear_volume_m3", heard[0][1].responses)
        # The same text for the program: what was set is in it.
        path.write_text((self.folder / "ours" / "study.toml").read_text())
        self.assertIn("flank_elements = 8", path.read_text())
        self.assertIn("max_evaluations = 6\n", path.read_text())
        done = subprocess.run([DOVETAIL, "run", path, "-o", self.folder / "theirs", "--jobs", "1"], capture_output=True,
                              text=True)
        self.assertEqual(answer["status"], {0: "done", 3: "not_converged"}[done.returncode], done.stderr)
        read = [(self.folder / who / "journal.jsonl").read_text().splitlines() for who in ("ours", "theirs")]
        self.assertEqual(len(read[0]), len(read[1]))
        for ours, theirs in zip(*map(lambda lines: [json.loads(line) for line in lines], read)):
            self.assertEqual(ours.get("record", {}).get("responses"), theirs.get("record", {}).get("responses"))
        if answer["best"]:
            self.assertEqual(pathlib.Path(answer["best"]).read_text(), (self.folder / "theirs" / "best.toml").read_text())
        with self.assertRaisesRegex(RuntimeError, "enough"):
            dovetail.run(study, self.folder / "other", jobs=1, callback=self.enough)
        stopped = []
        answer = dovetail.run(study, self.folder / "third", jobs=1, callback=lambda number, *_: stopped.append(number) or number < 2)
        self.assertEqual((answer["status"], stopped), ("interrupted", [1, 2]))

    def test_values_that_are_words_lists_and_new_keys_are_in_a_run_as_in_an_evaluation(self):
        study, _ = self.coarse()
        for key, value in {"solver.solver": "newton", "title": 'a "title"', "solver.prestress": "own",
                           "export.formats": ["csv", "dxf"], "optimizer.departures": False, "optimizer.verify": 0,
                           "optimizer.finer_meshes": 0, "optimizer.scan_evaluations": 0,
                           "optimizer.max_evaluations": np.int64(1), "geometry.left.flank_edge_radius_mm": 0.0}.items():
            study.set(key, value)
        log = self.folder / "run.jsonl"
        dovetail.run(study, self.folder / "out", jobs=1, json_log=log)
        kept = tomllib.loads((self.folder / "out" / "study.toml").read_text())
        self.assertEqual((kept["solver"]["solver"], kept["title"]), ("newton", 'a "title"'))
        self.assertEqual(kept["geometry"]["left"]["flank_edge_radius_mm"], 0)
        self.assertTrue((self.folder / "out" / "best.dxf").exists())
        evaluated, = [json.loads(line) for line in (self.folder / "out" / "journal.jsonl").read_text().splitlines()[1:]]
        answer = study.evaluate(no_bars=True, no_history=True)
        self.assertTrue(evaluated["record"]["responses"])
        for name, value in evaluated["record"]["responses"].items():
            self.assertEqual(answer.responses[name], value, name)
        events = [json.loads(line)["event"] for line in log.read_text().splitlines()]
        self.assertEqual((events[0], events[-1], events.count("evaluation")), ("begin", "end", 1), events)
        # The directory of the run stands for its best design.
        best = dovetail.Study(self.folder / "out")
        self.assertEqual(best.path, str(self.folder / "out" / "best.toml"))
        self.same(best.evaluate(no_bars=True), self.json("evaluate", self.folder / "out", "--no-bars"))
        told = self.program("evaluate", self.folder, status=2).stderr.strip()
        with self.assertRaises(dovetail.InputError) as caught:
            dovetail.Study(self.folder)
        self.assertEqual(str(caught.exception), told)

    def test_functions_write_a_log(self):
        path, log = self.folder / "rod.h5", self.folder / "log.jsonl"
        write_model.write_model(path, write_model.rod(2))
        study, _ = self.coarse()
        for call in (lambda: study.evaluate(no_bars=True, json_log=log), lambda: dovetail.response(path, [0.3], json_log=log),
                     lambda: dovetail.response(dovetail.Model.read(path), [0.3], json_log=str(log)),
                     lambda: dovetail.wear(study, method="asymptote", json_log=log)):
            log.unlink(missing_ok=True)
            call()
            events = [json.loads(line) for line in log.read_text().splitlines()]
            self.assertEqual((events[0]["event"], events[-1]["event"], events[-1]["exit_status"]), ("begin", "end", 0))
            self.assertTrue(all(event["event"] == "stage" and event["what"] for event in events[1:-1]), events)

    def test_what_ends_one_computation_is_nothing_to_other_threads(self):
        text = QUICKSTART.read_text().replace("scan_evaluations = 24", "scan_evaluations = 3")
        (self.folder / "study.toml").write_text(text)
        study, path = dovetail.Study(self.folder / "study.toml"), self.folder / "rod.h5"
        for key, value in COARSE.items():
            study.set(key, value)
        write_model.write_model(path, write_model.rod(4))
        model, frequencies = dovetail.Model.read(path), np.linspace(0.3, 0.5, 40)
        answers, over = [], threading.Event()

        def respond():
            while not over.is_set():
                answers.append(dovetail.response(model, frequencies))

        other = threading.Thread(target=respond)
        other.start()
        stopped = []
        try:
            run = dovetail.run(study, self.folder / "out", jobs=1,
                               callback=lambda number, *_: stopped.append(number) or number < 2)
        finally:
            over.set()
            other.join()
        self.assertEqual((run["status"], stopped), ("interrupted", [1, 2]))
        self.assertGreater(len(answers), 2)
        self.assertEqual({(len(answer.frequency_hz), answer.converged) for answer in answers}, {(40, True)})

    @staticmethod
    def enough(*_):
        raise RuntimeError("enough")

    def test_other_threads_go_on_and_ctrl_c_is_answered(self):
        study = dovetail.Study(QUICKSTART)
        study.set("mesh.flank_elements", 64)  # ten seconds and more
        ticks, over = [], threading.Event()

        def tick():
            while not over.wait(0.01):
                ticks.append(time.monotonic())

        threading.Thread(target=tick).start()
        threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            study.evaluate()
        seconds = time.monotonic() - begin
        over.set()
        self.assertLess(seconds, 3.0)
        # A thread that could not run for half a second was locked out.
        self.assertLess(max(b - a for a, b in zip(ticks, ticks[1:])), 0.5)
        self.assertTrue(dovetail.Study(QUICKSTART).evaluate(unworn=True).converged)  # and it computes on

    def test_help_shows_shapes_and_units(self):
        text = io.StringIO()
        with contextlib.redirect_stdout(text):
            help(dovetail)
        for words in ("float64 [n, n], N/m", "int32 [Nc, d-1]", "`worn_volume_m3` [S]", "history_tolerance (X)", "in Hz"):
            self.assertIn(words, text.getvalue())

    def test_the_stubs_are_those_of_the_module(self):
        stubs = ast.parse((pathlib.Path(MODULE) / "dovetail.pyi").read_text())
        named = {node.name: node for node in stubs.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        self.assertEqual(set(named), {name for name in dir(dovetail) if not name.startswith("__")})
        for name, node in named.items():
            if isinstance(node, ast.FunctionDef):
                self.same_parameters(node, getattr(dovetail, name), name)
                continue
            members = vars(getattr(dovetail, name))
            for stub in node.body:
                if isinstance(stub, ast.FunctionDef):
                    self.assertIn(stub.name, members, name)
                    if not stub.name.startswith("__") and not stub.decorator_list or stub.name in ("read",):
                        self.same_parameters(stub, getattr(getattr(dovetail, name), stub.name), f"{name}.{stub.name}")
            listed = {stub.name if isinstance(stub, ast.FunctionDef) else stub.target.id for stub in node.body
                      if isinstance(stub, (ast.FunctionDef, ast.AnnAssign))}
            public = {member for member in members if not member.startswith("_")}
            self.assertEqual(public - listed, set(), name)

    def same_parameters(self, stub, function, name):
        of_stub = [argument.arg for argument in stub.args.args + stub.args.kwonlyargs]
        self.assertEqual(of_stub, list(inspect.signature(function).parameters), name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv + ["-v"])
