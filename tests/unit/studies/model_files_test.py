"""Models made elsewhere, as their makers bring them:  model_files_test.py PATH_OF_DOVETAIL

Writes model files with h5py and by hand, runs the program on them, and holds its answers to closed forms, to linear
algebra and to published values.
"""
import json
import math
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import h5py
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLE = os.path.join(HERE, "..", "..", "..", "studies", "model_file")
sys.path.insert(0, EXAMPLE)
sys.dont_write_bytecode = True
import write_model  # noqa: E402

DOVETAIL = ""
HZ_OF_THE_ROD = 2.5 / (2 * math.pi)


def slider(stiffness=2.0, limit=0.3, force=1.0, mass=0.0, damping=0.0, directions=1):
    """One contact node, pressed so that it slides at `limit`, on a spring; the force acts on the node itself."""
    n = 1 + directions
    matrix = np.diag([1.0] + [stiffness] * directions)
    unit = np.zeros(n)
    unit[1] = 1
    return {
        "/mass": mass * np.diag(unit),
        "/damping": damping * np.diag(unit),
        "/stiffness": matrix,
        "/contact/normal": np.array([0]),
        "/contact/tangential": np.arange(1, n).reshape(1, directions),
        "/contact/area": np.array([1e-4]),
        "/contact/gap": np.zeros(1),
        "/contact/friction": np.array([0.5]),
        "/contact/wear_coefficient": np.array([1e-9]),
        "/force/static": np.concatenate([[2 * limit], np.zeros(directions)]),
        "/force/cosine": force * unit.reshape(1, n),
        "/force/sine": np.zeros((1, n)),
        "/output/vectors": unit.reshape(1, n),
        "/output/names": ["u"],
    }


class ModelFiles(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.model = os.path.join(self.folder.name, "model.h5")

    def run_program(self, *arguments):
        environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
        return subprocess.run([DOVETAIL, *map(str, arguments)], capture_output=True, text=True, env=environment,
                              cwd=self.folder.name, timeout=120)

    def answer(self, *arguments, status=0):
        done = self.run_program(*arguments, "--json", "-")
        self.assertEqual(done.returncode, status, done.stderr)
        return json.loads(done.stdout)

    def response(self, data, begin, end, points, *options, status=0):
        write_model.write_model(self.model, data)
        return self.answer("response", self.model, "--from", repr(begin), "--to", repr(end), "--points", points,
                           *options, status=status)

    def refusal(self, data, *command):
        write_model.write_model(self.model, data)
        done = self.run_program(*(command or ("response", self.model, "--from", 1, "--to", 2, "--points", 2)))
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stdout, "")
        return done.stderr

    def test_the_rod_has_its_published_amplitudes(self):
        # Three independent codes agree on these values; the last digits printed are rounded, and a residual of 1e-9 of
        # the excitation moves amplitudes by less than 1e-9 of themselves here.
        published = {(10, 3): (0.180214843944, 0.00343507318754), (10, 7): (0.179869422188, 0.00348405307794),
                     (100, 3): (0.184913938551, None)}
        for (nodes, harmonics), amplitudes in published.items():
            answer = self.response(write_model.rod(nodes), HZ_OF_THE_ROD, HZ_OF_THE_ROD, 1, "--harmonics", harmonics,
                                   "--samples", 128, "--pseudo-penalty", 10 / nodes)
            tip = answer["outputs"]["tip"]
            for harmonic, wanted in zip((1, 3), amplitudes):
                if wanted is None:
                    continue
                found = math.hypot(tip["cosine"][0][harmonic], tip["sine"][0][harmonic])
                self.assertAlmostEqual(found / wanted, 1, delta=2e-9, msg=(nodes, harmonics, harmonic))

    def test_the_command_of_the_readme_writes_the_rod(self):
        script = os.path.join(EXAMPLE, "write_model.py")
        subprocess.run([sys.executable, "-B", script, self.model, "--nodes", "3"], check=True, capture_output=True)
        with h5py.File(self.model) as file:
            self.assertEqual(file["/stiffness"].shape, (9, 9))
            np.testing.assert_array_equal(file["/stiffness"][()], write_model.rod(3)["/stiffness"])

    def test_every_solver_finds_the_same_state(self):
        amplitudes = []
        for solver in ("auto", "newton", "powell", "powell_fd"):
            answer = self.response(write_model.rod(4), HZ_OF_THE_ROD, HZ_OF_THE_ROD, 1, "--solver", solver)
            self.assertEqual(answer["settings"]["solver"], solver)
            amplitudes += answer["outputs"]["tip"]["amplitude"]
        np.testing.assert_allclose(amplitudes, amplitudes[0], rtol=1e-7)

    def test_a_pseudo_penalty_given_is_the_one_used(self):
        chosen = self.response(slider(), 1.0, 1.0, 1)["settings"]["pseudo_penalty_n_per_m"]
        self.assertEqual(chosen, {"normal": [1.0], "tangential": [2.0]})
        given = self.response(slider(), 1.0, 1.0, 1, "--pseudo-penalty", 5)["settings"]["pseudo_penalty_n_per_m"]
        self.assertEqual(given, {"normal": [5.0], "tangential": [5.0]})
        both = self.response(slider(), 1.0, 1.0, 1, "--pseudo-penalty", 5, "--pseudo-penalty-normal", 7)
        self.assertEqual(both["settings"]["pseudo_penalty_n_per_m"], {"normal": [7.0], "tangential": [5.0]})

    def structure(self, text=""):
        """A node on springs in series, 3 and 6 N/m along, 2 and 2 N/m across, that slides on the ground."""
        along, across = np.array([[3.0, -3], [-3, 9]]), np.array([[2.0, -2], [-2, 4]])
        lines = [f"{i + 1},{d}, {j + 1},{d}, {values[i, j]:.15e}"
                 for d, values in ((1, along), (2, across)) for i, j in ((0, 0), (1, 0), (1, 1))]
        with open(os.path.join(self.folder.name, "stiffness.mtx"), "w") as file:
            file.write("** Abaqus, MATRIX INPUT\n" + "\n".join(lines) + "\n")
        path = os.path.join(self.folder.name, "joint.toml")
        with open(path, "w") as file:
            file.write("""format = "dovetail-structure"
version = 1
stiffness = "stiffness.mtx"
[contact]
nodes = [1]
normal = [0, 1]
area = 1e-4
gap = 0
friction = 0.5
wear_coefficient = 1e-9
[[force]]
node = 1
direction = 2
harmonic = 0
cosine = 0.6
[[force]]
node = 1
direction = 1
harmonic = 1
cosine = 1
[[output]]
name = "u"
node = 1
direction = 1
""" + text)
        return path

    def test_a_structure_of_another_code_is_its_reduced_model(self):
        path = self.structure()
        wanted = self.response(slider(), 1.0, 1.0, 1)
        for key in ("response", "imported"):
            answer = self.answer("response", path, "--from", 1, "--to", 1, "--points", 1)
            self.assertAlmostEqual(answer["outputs"]["u"]["amplitude"][0], wanted["outputs"]["u"]["amplitude"][0], delta=1e-9)
            self.assertAlmostEqual(answer["dissipated_energy_j"][0] / wanted["dissipated_energy_j"][0], 1, delta=1e-9)
            imported = os.path.join(self.folder.name, "joint.h5")
            self.assertEqual(self.run_program("import", path, "-o", imported).returncode, 0)
            path = imported
        direct = self.answer("wear", self.structure(), "--method", "history", "--frequency", 1, "--cycles", 10)
        self.assertEqual(direct, self.answer("wear", path, "--method", "history", "--frequency", 1, "--cycles", 10))
        expected = self.answer("wear", self.model, "--method", "history", "--frequency", 1, "--cycles", 10)
        self.assertAlmostEqual(direct["depth_m"][0] / expected["depth_m"][0], 1, delta=1e-9)

    def test_a_wrong_structure_is_refused_in_one_sentence(self):
        for change, sentence in (("[[output]]\nname = 'v'\nnode = 9\ndirection = 1\n", "node 9 has no direction 1 in the matrices"),
                                 ("[reduction]\nmods = 3\n", "did you mean reduction.modes")):
            done = self.run_program("import", self.structure(change), "-o", "joint.h5")
            self.assertEqual(done.returncode, 2)
            self.assertIn(sentence, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_a_load_that_acts_nowhere_is_refused(self):
        force = "[[force]]\nfile = 'load.inp'\nharmonic = 1\ncosine = 1\n"
        for line, status in (("9, 1, 1.0", 2), ("1, 3, 1.0", 2), ("9, 1, 1.0\n2, 1, 1.0", 0)):
            with open(os.path.join(self.folder.name, "load.inp"), "w") as file:
                file.write(f"*CLOAD\n{line}\n")
            done = self.run_program("import", self.structure(force), "-o", "joint.h5")
            self.assertEqual(done.returncode, status, done.stderr)
            if status:
                self.assertRegex(done.stderr, r"force\[2\]\.file: has no force at a node and direction of the matrices\n$")
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_a_threshold_of_a_law_without_one_is_refused(self):
        data = {**slider(), "/contact/wear_threshold": np.array([3.0])}
        for command in (("wear", self.model, "--method", "asymptote", "--frequency", 1),
                        ("import", self.model, "-o", "again.h5"), ()):
            self.assertIn('model.h5: /contact/wear_threshold: has no meaning unless wear_law = "energy"',
                          self.refusal(data, *command))
        self.response({**data, "/contact/wear_law": ["energy"]}, 1.0, 1.0, 1)

    def test_a_quasi_static_cycle_is_the_hysteresis_loop_at_any_frequency(self):
        # k u + lambda = F cos, |lambda| <= R: for F > R, u runs to +-(F - R)/k and friction takes 4 R (F - R)/k.
        stiffness, limit, force = 2.0, 0.3, 1.0
        for directions in (1, 2):
            answer = self.response(slider(stiffness, limit, force, directions=directions), 1e-3, 1e5, 2,
                                   "--harmonics", 31, "--samples", 1024)
            first, last = answer["outputs"]["u"]["amplitude"]
            # Four kinks per period are a series of coefficients 1/h^2: beyond 31 harmonics a per cent of u is left.
            self.assertAlmostEqual(first, (force - limit) / stiffness, delta=1e-2 * first)
            energy = answer["dissipated_energy_j"][0]
            self.assertAlmostEqual(energy, 4 * limit * (force - limit) / stiffness, delta=2e-3 * energy)
            self.assertAlmostEqual(first / last, 1, delta=1e-12)
            self.assertAlmostEqual(energy / answer["dissipated_energy_j"][1], 1, delta=1e-12)

    def test_a_massless_gap_cuts_the_motion_off(self):
        # k u + lambda = F cos with u <= g: u = min(F cos / k, g), at every harmonic computed.
        data = slider(stiffness=1.0)
        data["/stiffness"] = np.diag([2.0, 1.0])
        data.update({"/force/static": np.zeros(2), "/force/cosine": np.array([[1.0, 0.0]]),
                     "/contact/gap": np.array([0.2]), "/output/vectors": np.array([[1.0, 0.0]])})
        answer = self.response(data, 3.0, 1.0, 2, "--samples", 2048)
        self.assertEqual(answer["frequency_hz"], [3.0, 1.0])
        phase = 2 * math.pi * np.arange(200000) / 200000
        motion = np.minimum(np.cos(phase) / 2, 0.2)
        wanted = [motion.mean()] + [2 * np.mean(motion * np.cos(h * phase)) for h in range(1, 6)]
        # 2048 samples find the kinks to a fraction of a sample: an error of the order of 1/N^2.
        np.testing.assert_allclose(answer["outputs"]["u"]["cosine"][1], wanted, atol=1e-6)

    def test_stuck_and_open_contact_is_linear(self):
        data = write_model.rod(3)
        n = data["/mass"].shape[0]
        contact = np.concatenate([data["/contact/normal"], data["/contact/tangential"].ravel()])
        data["/force/cosine"] = np.vstack([data["/force/cosine"], np.zeros(n), 0.2 * data["/force/cosine"]])
        data["/force/sine"] = np.vstack([np.zeros((2, n)), 0.1 * data["/force/cosine"][:1]])
        stuck = {**data, "/contact/friction": np.full(3, 1e6)}
        opened = {**data, "/contact/gap": np.full(3, 1e3)}
        for variant, held in ((stuck, contact), (opened, np.array([], dtype=int))):
            answer = self.response(variant, 0.21, 0.21, 1)
            tip = answer["outputs"]["tip"]
            free = np.setdiff1d(np.arange(n), held)
            for h in (1, 3):
                omega = 2 * math.pi * 0.21 * h
                dynamic = data["/stiffness"] + 1j * omega * data["/damping"] - omega**2 * data["/mass"]
                force = data["/force/cosine"][h - 1] - 1j * data["/force/sine"][h - 1]
                motion = np.linalg.solve(dynamic[np.ix_(free, free)], force[free])
                wanted = motion[list(free).index(2)]
                found = tip["cosine"][0][h] - 1j * tip["sine"][0][h]
                self.assertAlmostEqual(abs(found - wanted), 0, delta=1e-9 * abs(wanted))

    def test_the_static_force_and_interference_press_a_stuck_contact(self):
        # Without excitation: u_N = g, lambda = f - K u; the tangential spring carries its mean load if stuck.
        data = slider(force=0.0)
        data["/force/static"] = np.array([3.0, 0.4])
        data["/contact/gap"] = np.array([-0.1])
        data["/output/vectors"] = np.eye(2)
        data["/output/names"] = ["u_n", "u_t"]
        answer = self.response(data, 1.0, 1.0, 1)
        self.assertAlmostEqual(answer["outputs"]["u_n"]["cosine"][0][0], -0.1, delta=1e-12)
        self.assertAlmostEqual(answer["outputs"]["u_t"]["cosine"][0][0], 0.0, delta=1e-12)
        self.assertEqual(answer["dissipated_energy_j"], [0.0])

    def test_a_floating_body_is_held_by_contact(self):
        # A mass on two contact springs and nothing else: K is singular, stuck contact makes it k_t/(k_t - w^2 m).
        data = {**slider(), "/output/names": ["u"]}
        n, spring = 4, 5.0
        stiffness = np.zeros((n, n))
        for body, node in ((0, 2), (1, 3)):
            stiffness[body, body] += spring
            stiffness[node, node] += spring
            stiffness[body, node] -= spring
            stiffness[node, body] -= spring
        data.update({
            "/stiffness": stiffness, "/mass": np.diag([1.0, 1.0, 0, 0]), "/damping": np.diag([0.1, 0.1, 0, 0]),
            "/contact/normal": np.array([2]), "/contact/tangential": np.array([[3]]),
            "/force/static": np.array([4.0, 0, 0, 0]), "/force/cosine": np.array([[0, 0.1, 0, 0]]),
            "/force/sine": np.zeros((1, 4)), "/output/vectors": np.array([[0, 1.0, 0, 0]])})
        answer = self.response(data, 0.1, 0.1, 1)
        omega = 0.2 * math.pi
        wanted = 0.1 / abs(spring + 0.1j * omega - omega**2)
        self.assertAlmostEqual(answer["outputs"]["u"]["amplitude"][0] / wanted, 1, delta=1e-9)

    def test_a_model_without_contact_is_linear_and_does_not_wear(self):
        data = write_model.rod(2)
        for name in [key for key in data if key.startswith("/contact/")]:
            data[name] = data[name][:0]
        answer = self.response(data, 0.3, 0.3, 1)
        omega = 0.6 * math.pi
        dynamic = data["/stiffness"] + 1j * omega * data["/damping"] - omega**2 * data["/mass"]
        wanted = abs(np.linalg.solve(dynamic, data["/force/cosine"][0])[1])
        self.assertAlmostEqual(answer["outputs"]["tip"]["amplitude"][0] / wanted, 1, delta=1e-9)
        self.assertEqual(answer["wear_rate_m_per_cycle"], [[]])
        sentence = self.refusal(data, "wear", self.model, "--method", "asymptote", "--frequency", 0.3)
        self.assertIn("has no contact nodes", sentence)

    def test_no_harmonic_of_the_force_is_dropped(self):
        data = slider(mass=0.01, damping=0.1)
        data["/force/cosine"] = np.vstack([data["/force/cosine"]] + [np.zeros((5, 2))] + [data["/force/cosine"] * 0.2])
        data["/force/sine"] = np.zeros((7, 2))
        answer = self.response(data, 1.0, 1.0, 1)
        self.assertEqual(answer["settings"]["harmonics"], 7)
        sentence = self.refusal(data, "response", self.model, "--from", 1, "--to", 1, "--points", 1, "--harmonics", 3)
        self.assertIn("--harmonics = 3: must be >= 7, the largest of the force", sentence)
        data["/force/cosine"][6] = 0  # rows of zeros ask for nothing
        self.assertEqual(self.response(data, 1.0, 1.0, 1)["settings"]["harmonics"], 5)

    def test_automatic_harmonics_and_samples_reach_the_accuracy(self):
        data = write_model.rod(4)
        fine = self.response(data, HZ_OF_THE_ROD, HZ_OF_THE_ROD, 1, "--harmonics", 63, "--samples", 4096)
        found = self.response(data, HZ_OF_THE_ROD, HZ_OF_THE_ROD, 1, "--harmonics", "auto", "--samples", "auto",
                              "--accuracy", 1e-3)
        self.assertEqual(found["settings"]["automatic"], {"status": "converged", "accuracy": 1e-3})
        self.assertGreaterEqual(found["settings"]["harmonics"], 3)
        wanted = fine["outputs"]["tip"]["amplitude"][0]
        self.assertAlmostEqual(found["outputs"]["tip"]["amplitude"][0] / wanted, 1, delta=1e-3)

    def test_analyses_have_an_entry_for_each_frequency(self):
        answer = self.response(write_model.rod(3), 0.3, 0.5, 3, "--error-bars", "--penalty-sensitivity", "--stability")
        self.assertEqual(answer["error_bars"]["status"], ["converged"] * 3)
        for part in ("total", "harmonics", "samples", "penalty"):
            self.assertEqual(len(answer["error_bars"][part]["outputs"]["tip"]), 3)
        self.assertTrue(all(bar > 0 for bar in answer["error_bars"]["total"]["outputs"]["tip"]))
        self.assertEqual(answer["penalty_sensitivity"]["ratios"], [0.5, 1, 2, 10])
        for amplitude, by_ratio in zip(answer["outputs"]["tip"]["amplitude"],
                                       answer["penalty_sensitivity"]["values"]["outputs"]["tip"]):
            self.assertAlmostEqual(by_ratio[1] / amplitude, 1, delta=1e-7)
        self.assertEqual(answer["stability"]["verdict"], ["stable"] * 3)

    def test_the_response_is_followed_through_its_interval(self):
        answer = self.response(write_model.rod(3), 0.3, 0.5, 5, "--arclength")
        self.assertEqual(answer["arclength"]["status"], "converged")
        self.assertEqual((answer["frequency_hz"][0], answer["frequency_hz"][-1]), (0.3, 0.5))
        self.assertGreaterEqual(len(answer["frequency_hz"]), 5)
        ends = self.response(write_model.rod(3), 0.3, 0.5, 2)
        for end in (0, -1):
            self.assertAlmostEqual(answer["outputs"]["tip"]["amplitude"][end] / ends["outputs"]["tip"]["amplitude"][end],
                                   1, delta=1e-6)
        sentence = self.refusal(write_model.rod(3), "response", self.model, "--from", 1, "--to", 1, "--points", 1,
                                "--arclength")
        self.assertIn("--arclength: needs an interval", sentence)

    def test_a_backbone_of_open_contact_is_the_linear_resonance(self):
        # m = 1, c = 0.1, k = 2: the amplitude is largest at w^2 = k/m - c^2/(2 m^2), F/(c sqrt(k/m - c^2/(4 m^2))).
        data = slider(mass=1.0, damping=0.1)
        data["/contact/gap"] = np.array([1e3])
        write_model.write_model(self.model, data)
        answer = self.answer("backbone", self.model, "--from", 0.5, "--to", 8, "--points", 5, "--logarithmic",
                             "--frequency", 0.21)
        for factor, hz, amplitude in zip(answer["parameter"], answer["frequency_hz"], answer["amplitude"]):
            # The search stops at a relative 1e-7 of the frequency; the amplitude is stationary there.
            self.assertAlmostEqual(hz / (math.sqrt(2 - 0.005) / (2 * math.pi)), 1, delta=3e-7)
            self.assertAlmostEqual(amplitude / (factor / (0.1 * math.sqrt(2 - 0.0025))), 1, delta=1e-9)
        done = self.run_program("backbone", self.model, "--from", 1, "--to", 2, "--points", 2)
        self.assertEqual(done.returncode, 2)
        self.assertIn("give --frequency HZ", done.stderr)

    def test_an_interrupted_response_keeps_what_is_finished(self):
        write_model.write_model(self.model, write_model.rod(20))
        command = [DOVETAIL, "response", self.model, "--from", "0.1", "--to", "0.6", "--points", "100000", "--json",
                   "out.json"]
        process = subprocess.Popen(command, cwd=self.folder.name, stderr=subprocess.PIPE)
        time.sleep(1)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        with open(os.path.join(self.folder.name, "out.json")) as file:
            answer = json.load(file)
        self.assertEqual(len(answer["status"]), 100000)
        self.assertEqual(set(answer["status"]), {"converged", "interrupted"})
        self.assertEqual(sorted(os.listdir(self.folder.name)), ["model.h5", "out.json"])

    def test_matrix_market_and_back_is_the_same_to_the_last_bit(self):
        data = write_model.rod(3)
        rng = np.random.default_rng(1)
        noise = rng.normal(size=(9, 9))
        data["/damping"] = noise @ noise.T / 7
        data["/contact/slip_origin"] = rng.normal(size=(3, 1)) / 3
        write_model.write_model(self.model, data)
        done = self.run_program("export", self.model, "--format", "matrix-market", "-o", "m.toml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(os.listdir(self.folder.name)),
                         ["m.damping.mtx", "m.mass.mtx", "m.stiffness.mtx", "m.toml", "model.h5"])
        self.assertEqual(self.run_program("import", "m.toml", "-o", "back.h5").returncode, 0)
        with h5py.File(os.path.join(self.folder.name, "back.h5")) as file:
            for name, values in data.items():
                if name != "/output/names":
                    self.assertEqual(file[name][()].tobytes(), np.ascontiguousarray(values).tobytes(), name)
            self.assertEqual([name.decode() for name in file["/output/names"]], ["tip"])
        question = ("--from", 0.3, "--to", 0.4, "--points", 2, "--json", "-")
        answers = [self.run_program("response", name, *question).stdout for name in ("model.h5", "m.toml", "back.h5")]
        self.assertEqual(answers[0], answers[1])
        self.assertEqual(answers[0], answers[2])
        wear = ("--method", "asymptote", "--frequency", 0.4, "--json", "-")
        self.assertEqual(self.run_program("wear", "m.toml", *wear).stdout,
                         self.run_program("wear", "model.h5", *wear).stdout)

    def test_files_that_are_no_models_are_told_apart(self):
        study = os.path.join(self.folder.name, "study.toml")
        self.assertEqual(self.run_program("new", study).returncode, 0)
        done = self.run_program("import", study, "-o", "m.h5")
        self.assertEqual(done.returncode, 2)
        self.assertIn("is not a reduced model", done.stderr)
        self.assertFalse(os.path.exists(os.path.join(self.folder.name, "m.h5")))
        write_model.write_model(self.model, slider())
        done = self.run_program("export", self.model, "--format", "dxf", "-o", "m.dxf")
        self.assertEqual(done.returncode, 2)
        self.assertIn("is a reduced model", done.stderr)
        done = self.run_program("response", self.model, "--from", 1, "--to", 2, "--points", 2, "--set", "a.b=1")
        self.assertIn("sets a key of a study file", done.stderr)

    def test_every_flaw_is_one_sentence(self):
        def changed(name, change):
            data = slider()
            data[name] = change(data[name])
            return data

        flaws = {
            "/mass = shape [1,2]": ("/mass", lambda a: a[:1]),
            "/stiffness[0,0] = nan": ("/stiffness", lambda a: a * np.nan),
            "must be symmetric": ("/damping", lambda a: a + [[0, 1], [0, 0]]),
            "/mass diagonal [1] = -1": ("/mass", lambda a: a - np.diag([0, 1])),
            "/contact/normal[0] = 7": ("/contact/normal", lambda a: a + 7),
            "must be a dof of its own": ("/contact/normal", lambda a: a + 1),
            "/contact/area[0] = 0": ("/contact/area", lambda a: 0 * a),
            "/contact/friction[0] = -0.5": ("/contact/friction", lambda a: -a),
            "/force/sine = shape [2,2]": ("/force/sine", lambda a: np.vstack([a, a])),
            "/output/names = shape [2]": ("/output/names", lambda a: ["a", "b"]),
        }
        for sentence, (name, change) in flaws.items():
            said = self.refusal(changed(name, change))
            self.assertIn(sentence, said)
            self.assertEqual(said.count("\n"), 1, said)
        for option, sentence in {("--pseudo-penalty", "-1"): "--pseudo-penalty -1: must be >= 0",
                                 ("--solver", "magic"): "--solver", ("--harmonics", "many"): "whole number or auto",
                                 ("--accuracy", "0.1"): "only has a meaning with"}.items():
            said = self.refusal(slider(), "response", self.model, "--from", 1, "--to", 2, "--points", 2, *option)
            self.assertIn(sentence, said)
            self.assertEqual(said.count("\n"), 1, said)


if __name__ == "__main__":
    DOVETAIL = os.path.abspath(sys.argv.pop(1))
    unittest.main()
