"""Answers of `dovetail wear` as files:  wear_files_test.py PATH_OF_DOVETAIL

A history resumed from its JSON is the one that was never stopped, another one is refused, and a computation without a
state still answers.
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "..", "studies", "model_file"))
sys.dont_write_bytecode = True
import write_model  # noqa: E402

DOVETAIL = ""
HISTORY = ("--method", "history")
AT = ("--frequency", "0.45")
IMPLICIT = ("--integrator", "implicit")
STATES = ("cycles", "worn_volume_m3", "amplitude_m", "frequencies_hz", "depths_m", "wear_rates_m_per_cycle")


class WearFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.write("rod.h5", {})

    @classmethod
    def write(cls, name, factors):
        data = write_model.rod(4)
        for key, factor in factors.items():
            data[key] = data[key] * factor
        write_model.write_model(os.path.join(cls.folder.name, name), data)

    def wear(self, model, *options, file="answer.json", status=0):
        done = subprocess.run([DOVETAIL, "wear", model, *options, "--json", file], capture_output=True, text=True,
                              env={**os.environ, "OPENBLAS_NUM_THREADS": "1"}, cwd=self.folder.name, timeout=120)
        self.assertEqual(done.returncode, status, done.stderr)
        self.said = done.stderr
        path = os.path.join(self.folder.name, file)
        if status == 2:
            return None
        with open(path) as stream:
            return json.load(stream)

    def test_console_has_the_bars_of_the_answer(self):
        asked = ("rod.h5", "--method", "asymptote", *AT, "--error-bars")
        bars = self.wear(*asked)["error_bars"]
        done = subprocess.run([DOVETAIL, "wear", *asked], capture_output=True, text=True, cwd=self.folder.name,
                              env={**os.environ, "OPENBLAS_NUM_THREADS": "1"}, timeout=120)
        for key in ("worn_volume_m3", "largest_depth_m"):
            line = next(line for line in done.stdout.splitlines() if line.startswith(key))
            said = float(line.split(" +- ")[1])
            self.assertLessEqual(abs(said - bars[key]), 0.06 * bars[key], line)

    def refusal(self, model, *options):
        self.wear(model, *HISTORY, *options, file="refused.json", status=2)
        self.assertFalse(os.path.exists(os.path.join(self.folder.name, "refused.json")))
        return self.said

    def largest_difference(self, a, b):
        """Relative to the largest entry of each list; None only beside None."""
        flat = [([], []) for _ in STATES]
        for key, (left, right) in zip(STATES, flat):
            for x, y in zip(a[key], b[key], strict=True):
                for u, v in zip(x, y, strict=True) if isinstance(x, list) else [(x, y)]:
                    self.assertEqual(u is None, v is None, key)
                    if u is not None:
                        left.append(u)
                        right.append(v)
        return max(max(abs(u - v) for u, v in zip(left, right)) / (max(map(abs, left)) or 1) for left, right in flat)

    def test_a_resumed_history_is_the_one_never_stopped(self):
        # Steady states are solved to 1e-9; that of the last state is the only thing computed twice.
        for steps, options in {5: IMPLICIT, 12: IMPLICIT, 30: (), 8: ("--history-tolerance", "1e-3")}.items():
            whole = self.wear("rod.h5", *HISTORY, *AT, *options)
            self.wear("rod.h5", *HISTORY, *AT, *options, "--steps", str(steps), file="part.json", status=3)
            rest = self.wear("rod.h5", *HISTORY, *options[:2 if options == IMPLICIT else 0], "--resume", "part.json")
            self.assertGreater(len(whole["cycles"]), steps // 2 + 2)
            self.assertLess(self.largest_difference(whole, rest), 1e-8, options)
            for key in ("status", "ended", "finished"):
                self.assertEqual(whole[key], rest[key])

    def test_a_history_stopped_by_cycles_goes_on_within_the_error_of_its_steps(self):
        whole = self.wear("rod.h5", *HISTORY, *AT, *IMPLICIT)
        part = self.wear("rod.h5", *HISTORY, *AT, *IMPLICIT, "--cycles", repr(whole["cycles"][6] * 1.1), file="part.json")
        self.assertEqual(part["status"], "not_converged")
        self.assertIn("cycles asked for", part["reason"])
        rest = self.wear("rod.h5", *HISTORY, *IMPLICIT, "--resume", "part.json")
        # The local tolerance of 2e-4 over two dozen steps.
        self.assertAlmostEqual(rest["final_worn_volume_m3"] / whole["final_worn_volume_m3"], 1, delta=5e-3)
        self.assertEqual(rest["cycles"][:len(part["cycles"])], part["cycles"])

    def test_a_joint_at_rest_stays_at_rest(self):
        for options in IMPLICIT, ():
            rest = self.wear("rod.h5", *HISTORY, *AT, *options, file="rest.json")
            self.assertEqual(rest["status"], "asymptote")
            again = self.wear("rod.h5", *HISTORY, *options, "--resume", "rest.json", file="again.json")
            for key in (*STATES, "depth_m", "final_wear_rate_m_per_cycle", "ended", "finished", "solves"):
                self.assertEqual(rest[key], again[key], key)

    def test_the_last_entries_belong_to_the_depth(self):
        finished = 0
        for options in IMPLICIT, ():
            answer = self.wear("rod.h5", *HISTORY, *AT, *options)
            area = 0.25
            self.assertAlmostEqual(answer["worn_volume_m3"][-1] / (area * sum(answer["depth_m"])), 1, delta=1e-12)
            self.assertEqual(answer["depths_m"][-1], answer["depth_m"])
            self.assertEqual(answer["wear_rates_m_per_cycle"][-1], answer["final_wear_rate_m_per_cycle"])
            self.assertEqual(answer["cycles"][-1] is None, answer["finished"])
            self.assertEqual({len(answer[key]) for key in STATES}, {len(answer["cycles"])})
            self.assertEqual(answer["other_states"], [])
            finished += answer["finished"]
        self.assertGreater(finished, 0)

    def test_another_history_is_refused(self):
        self.wear("rod.h5", *HISTORY, *AT, "--steps", "5", file="five.json", status=3)
        five = ("--resume", "five.json")
        self.write("other.h5", {"/contact/friction": 0.999})
        for sentence, arguments in {
                "five.json: history.identity.model = ": ("other.h5", *five),
                "five.json: history.identity.frequency_hz = 0.45: must be 0.44, ": ("rod.h5", *five, "--frequency", "0.44"),
                "five.json: history.identity.harmonics = 5: must be 3, ": ("rod.h5", *five, "--harmonics", "3"),
                "five.json: history.identity.samples = 128: must be 64, ": ("rod.h5", *five, "--samples", "64"),
                "five.json: history.identity.integrator = explicit: must be implicit, ": ("rod.h5", *five, *IMPLICIT),
                "five.json: history.identity.follow = fixed: must be resonance, ": ("rod.h5", *five, "--follow",
                                                                                    "resonance"),
                "history.identity.pseudo_penalty_normal_n_per_m = 0: must be 7, ": ("rod.h5", *five,
                                                                                  "--pseudo-penalty-normal", "7"),
        }.items():
            said = self.refusal(*arguments)
            self.assertIn(sentence, said)
            self.assertEqual(said.count("\n"), 1, said)
        done = self.wear("rod.h5", *HISTORY, *five, "--steps", "1", status=3)["cycles"][5]
        self.assertIn("must be > ", self.refusal("rod.h5", *five, "--cycles", repr(done)))
        self.assertIn("the cycles done in five.json", self.said)

    def test_a_threshold_of_zero_is_none(self):
        # Only the law of energy may have one; its data sets are the same but for that.
        # The law is one text: a list of one or a scalar.
        for name, more in {"without.h5": {"/contact/wear_law": ["energy"]},
                           "with.h5": {"/contact/wear_law": "energy",
                                       "/contact/wear_threshold": write_model.np.zeros(4)}}.items():
            write_model.write_model(os.path.join(self.folder.name, name), {**write_model.rod(4), **more})
        self.wear("with.h5", *HISTORY, *AT, "--steps", "2", file="energy.json", status=3)
        self.wear("without.h5", *HISTORY, "--steps", "1", "--resume", "energy.json", status=3)

    def test_files_that_lack_something_are_refused(self):
        answer = self.wear("rod.h5", *HISTORY, *AT, "--steps", "2", file="two.json", status=3)
        for flaw in ({"depths_m": [[0.0] * 4]}, {"history": {}}, {"cycles": "many"}, {"method": 3}, {"finished": None},
                     {"ended": "at noon"}):
            with open(os.path.join(self.folder.name, "flawed.json"), "w") as file:
                json.dump({**answer, **flaw}, file)
            said = self.refusal("rod.h5", "--resume", "flawed.json")
            self.assertIn("--resume = flawed.json: is ", said)
            self.assertEqual(said.count("\n"), 1, said)

    def test_without_any_state_there_is_an_answer_without_numbers(self):
        self.write("damped.h5", {"/damping": 200})  # no peak
        answer = self.wear("damped.h5", "--method", "asymptote", status=3)
        self.assertEqual(answer["status"], "not_converged")
        self.assertIn("unworn resonance", answer["reason"])
        for key in ("cycles", "worn_volume_m3", "frequencies_hz"):
            self.assertEqual(answer[key], [None], key)
        for key in ("depth_m", "final_wear_rate_m_per_cycle"):
            self.assertEqual(answer[key], [None] * 4, key)
        self.assertIsNone(answer["frequency_hz"])
        answer = self.wear("damped.h5", *HISTORY, status=3)
        for key in STATES:
            self.assertEqual(answer[key], [], key)
        self.assertEqual(answer["depth_m"], [None] * 4)
        self.assertIsNone(answer["final_worn_volume_m3"])

    def test_hints_and_refusals_fit_the_choice(self):
        self.wear("rod.h5", *HISTORY, *AT, "--steps", "1", status=3)
        self.assertIn("--increment", self.said)
        self.wear("rod.h5", *HISTORY, *AT, *IMPLICIT, "--steps", "1", status=3)
        self.assertIn("allow more --steps", self.said)
        self.assertNotIn("--increment", self.said)
        # The rod's peak at 0.42 Hz becomes a flank of the one at 0.24 Hz when its pads come free.
        write_model.write_model(os.path.join(self.folder.name, "ten.h5"), write_model.rod(10))
        self.wear("ten.h5", "--method", "asymptote", "--follow", "resonance", status=3)
        self.assertIn("no_bracket: the resonance that was followed is no maximum any more", self.said)
        self.write("still.h5", {"/mass": 0})
        self.assertIn("--follow = resonance: needs a model with mass", self.refusal("still.h5", *AT, "--follow", "resonance"))


if __name__ == "__main__":
    DOVETAIL = os.path.abspath(sys.argv.pop(1))
    unittest.main()
