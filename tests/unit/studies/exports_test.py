"""What `dovetail export` writes of studies, runs and their candidates:  exports_test.py PATH_OF_DOVETAIL

Every format is read back by a reader of its own: solids by the text of their files, drawings by ezdxf where it is
installed, fields and tables by what they say they are.
"""
import base64
import csv
import json
import math
import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml

try:
    import ezdxf
except ImportError:
    ezdxf = None

DOVETAIL = ""
# Few elements, few designs, all formats.
COARSE = {"flank_elements": 6, "bulk_size_mm": 12, "fillet_fraction": 0.6, "aerofoil_elements": 4, "sectors": 24,
          "flank_grading": 4, "max_evaluations": 3, "verify": 0, "finer_meshes": 0, "departures": "false",
          "formats": '["step", "iges", "stl", "pvd", "csv"]'}


def arrays(file):
    """Name -> values of the arrays of a VTU file, and the text of its tags."""
    types = {"Float64": "d", "Int64": "q", "UInt8": "B"}
    found = {}
    for array in xml.parse(file).getroot().iter("DataArray"):
        raw = base64.b64decode(array.text)
        size, = struct.unpack_from("<Q", raw)
        code = types[array.get("type")]
        found[array.get("Name")] = struct.unpack_from(f"<{size // struct.calcsize(code)}{code}", raw, 8)
    return found


def step_text(file):
    """A STEP file without its line breaks."""
    with open(file) as stream:
        return re.sub(r"\n\s*", "", stream.read())


def bspline_points(step):
    """Points of the cubic curves in space of a STEP file at their knots and in between, mm, by de Boor's recursion."""
    places = {number: tuple(map(float, at.split(","))) for number, at in
              re.findall(r"#(\d+) = CARTESIAN_POINT\('[^']*',\(([-+0-9.E,]+)\)\)", step)}
    curve = (r"B_SPLINE_CURVE_WITH_KNOTS\('[^']*',3,\(([#0-9,]+)\),\.[A-Z_]+\.,\.[A-Z]+\.,\.[A-Z]+\.,"
             r"\(([0-9,]+)\),\(([-+0-9.E,]+)\)")
    points = []
    for poles, times, values in re.findall(curve, step):
        poles = [places[number] for number in poles.replace("#", "").split(",")]
        values = [float(v) for v in values.split(",")]
        knots = [v for v, times in zip(values, times.split(",")) for _ in range(int(times))]
        for low, high in zip(values, values[1:]):
            for t in (low, (low + high) / 2, high):
                k = max(i for i in range(3, len(poles)) if knots[i] <= t and knots[i] < knots[i + 1])
                d = [poles[i] for i in range(k - 3, k + 1)]
                for r in range(1, 4):
                    for j in range(3, r - 1, -1):
                        a = (t - knots[j + k - 3]) / (knots[j + 1 + k - r] - knots[j + k - 3])
                        d[j] = tuple((1 - a) * p + a * q for p, q in zip(d[j - 1], d[j]))
                points.append(d[3])
    return points


class Exports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.run_program(cls, "new", "full.toml")
        with open(cls.path("full.toml")) as stream:
            text = stream.read()
        for key, value in COARSE.items():
            text, count = re.subn(rf"^{key} = .*$", f"{key} = {value}", text, flags=re.M)
            assert count == 1, key
        with open(cls.path("s.toml"), "w") as stream:
            stream.write(text)
        done = cls.run_program(cls, "run", "s.toml", "-o", "o")
        assert done.returncode == 0, done.stderr

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder.name, name)

    def run_program(self, *arguments):
        return subprocess.run([DOVETAIL, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder.name,
                              env={**os.environ, "OPENBLAS_NUM_THREADS": "1"}, timeout=300)

    def export(self, source, file, *options):
        done = self.run_program("export", source, "--format", file.rpartition(".")[2], "-o", file, *options)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, f"{file}: written\n", "nothing else is said")
        return self.path(file)

    def evaluate(self, study):
        done = self.run_program("evaluate", study, "--no-bars", "--json", "-")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def text(self, name):
        with open(self.path(name)) as stream:
            return stream.read()

    def test_step_has_the_radii_of_the_study(self):
        done = self.run_program("export", "s.toml", "--format", "step", "-o", "r.step", "--set",
                                "geometry.neck_fillet_radius_mm=2.125", "--set", "geometry.chord_mm=50")
        self.assertEqual(done.returncode, 0, done.stderr)
        step = step_text(self.path("r.step"))
        radii = {float(r) for r in re.findall(r"CIRCLE\('[^']*',#\d+,([-+0-9.E]+)\)", step)}
        for radius in (2.125, 1.5, 2, 1, 250, 120):  # fillet, corner and lobe, slot, blends, rim, bore
            self.assertTrue(any(abs(r / radius - 1) < 1e-12 for r in radii), (radius, radii))
        self.assertEqual(step.count("MANIFOLD_SOLID_BREP("), 2)
        for part in ("PRODUCT('BLADE'", "PRODUCT('DISK'", "SI_UNIT(.MILLI.,.METRE.)"):
            self.assertTrue(part in step, part)
        self.assertFalse("B_SPLINE" in step)

    def test_worn_flanks_are_as_deep_as_the_wear(self):
        self.export("s.toml", "worn.step", "--worn")
        points = bspline_points(step_text(self.path("worn.step")))
        self.assertTrue(points)
        # The nominal flanks of the default study: 50 degrees to the radial direction, their neck-side ends at the
        # lobe's depth below the rim.
        angle = math.radians(50)
        x = 8.5 / 2 + 2 * (1 - math.cos(angle))
        depths = [-((abs(px) - x) * math.cos(angle) + (py - 247) * math.sin(angle)) for px, py, _ in points]
        self.assertGreater(min(depths), -1e-9)
        deepest = self.evaluate("s.toml")["responses"]["asymptotic_wear_depth_max_m"]
        self.assertGreater(deepest, 0)
        self.assertLess(abs(max(depths) * 1e-3 / deepest - 1), 1e-6)

    def test_worn_solids_are_of_the_first_case(self):
        of_case = self.text("s.toml") + '\n[[case]]\nname = "bent"\n"geometry.flank_length_mm" = 6\n'
        with open(self.path("cases.toml"), "w") as stream:
            stream.write(of_case)
        self.export("cases.toml", "case.step", "--worn")
        self.export("s.toml", "same.step", "--worn", "--set", "geometry.flank_length_mm=6")
        points = [bspline_points(step_text(self.path(file))) for file in ("case.step", "same.step")]
        self.assertEqual(len(points[0]), len(points[1]))
        # mm; the mesh of a case is moved from that of the file's own geometry, and worn zones end a little elsewhere on it.
        # On the flank as the file has it points lie 0.4 mm off.
        self.assertLess(max(math.dist(a, b) for a, b in zip(*points)), 0.02)

    def test_fields_are_those_of_the_answers(self):
        fields = arrays(self.export("s.toml", "s.vtu"))
        responses = self.evaluate("s.toml")["responses"]
        self.assertAlmostEqual(max(fields["wear_depth_m"]) / responses["asymptotic_wear_depth_max_m"], 1, 9)
        # The answer is the peak of pressure on a grid of its own.
        self.assertLess(abs(max(fields["contact_pressure_pa"]) / responses["contact_pressure_max_pa"] - 1), 0.05)
        self.assertGreater(max(fields["slip_m_per_cycle"]), 0)
        self.assertAlmostEqual(fields["mode_frequency_hz"][0] / responses["glued_frequency_hz"], 1, 3)
        nodes = len(fields["von_mises_pa"])
        for name in ("displacement_m", "mode_1", "mode_2", "mode_3"):
            self.assertEqual(len(fields[name]), 3 * nodes)
        self.assertAlmostEqual(max(abs(u) for u in fields["mode_1"]), 1, 3)
        # Nothing presses or wears off the flanks.
        y = fields["Points"][1::3]
        self.assertLess(max(at for at, depth in zip(y, fields["wear_depth_m"]) if depth > 0), 0.2471)

    def test_series_over_the_wear_history(self):
        for pvd in (self.export("s.toml", "s.pvd"), self.path("o/best.pvd")):
            sets = [entry.attrib for entry in xml.parse(pvd).getroot().iter("DataSet")]
            times = [float(entry["timestep"]) for entry in sets]
            self.assertEqual(times, sorted(times))
            self.assertEqual(times[0], 0)
            deepest = [max(arrays(os.path.join(os.path.dirname(pvd), entry["file"]))["wear_depth_m"])
                       for entry in sets]
            self.assertEqual(deepest, sorted(deepest))
            self.assertEqual(deepest[0], 0)
            self.assertGreater(deepest[-1], 0)

    def test_surfaces_are_in_millimetres(self):
        with open(self.export("s.toml", "s.stl"), "rb") as stream:
            data = stream.read()
        triangles, = struct.unpack_from("<I", data, 80)
        self.assertEqual(len(data), 84 + 50 * triangles)
        volume = 0
        for t in range(triangles):
            a, b, c = (struct.unpack_from("<3f", data, 84 + 50 * t + 12 * i) for i in (1, 2, 3))
            volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                       + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
        # Titanium blade, and the sector of the disk between bore and rim less its slot of 150 to 450 mm^2.
        blade = self.evaluate("s.toml")["responses"]["mass_kg"] / 4430e-9
        disk = 40 * (math.pi * (250**2 - 120**2) / 24 - 300)
        self.assertLess(abs(volume - blade - disk), 40 * 150)

    @unittest.skipUnless(ezdxf, "ezdxf is not installed")
    def test_drawing_needs_no_repair(self):
        for source in ("s.toml", "o"):
            document = ezdxf.readfile(self.export(source, "s.dxf"))
            audit = document.audit()
            self.assertEqual([entry.message for entry in audit.errors + audit.fixes], [])
            self.assertEqual({entity.dxf.layer for entity in document.modelspace()}, {"BLADE", "DISK"})
            self.assertEqual(document.units, 4, "millimetres")

    def test_table_of_candidates(self):
        self.export("o", "all.csv")
        self.assertEqual(self.text("all.csv"), self.text("o/candidates.csv"))
        rows = list(csv.DictReader(self.text("all.csv").splitlines()))
        with open(self.path("o/journal.jsonl")) as stream:
            records = [json.loads(line)["record"] for line in list(stream)[1:]]
        self.assertEqual([row["evaluation"] for row in rows], ["1", "2", "3"])
        for row, record in zip(rows, records):
            self.assertEqual(row["feasible"], str(record["feasible"]).lower())
            for name, value in record["responses"].items():
                if row["evaluation"] != "1":  # start and best design are looked at more closely
                    self.assertEqual(float(row[name]), value, name)

    def test_candidates_of_a_run_are_studies(self):
        rows = list(csv.DictReader(self.text("o/candidates.csv").splitlines()))
        best = min((row for row in rows if row["feasible"] == "true"), key=lambda row: float(row["objective"]))
        self.export("o", "best.svg")
        self.export("o", "same.svg", "--candidate", best["evaluation"])
        self.assertEqual(self.text("best.svg"), self.text("same.svg"))
        self.export("o/best.toml", "file.svg")
        self.assertEqual(self.text("best.svg"), self.text("file.svg"))
        for number in (1, 2, 3):
            for file in ("c.step", "c.dxf", "c.vtu"):
                self.export("o", file, "--candidate", number)
        done = self.run_program("export", "o", "--format", "matrix-market", "--candidate", 2, "-o", "m.toml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.export("o", "w.step", "--worn")
        self.assertTrue(bspline_points(step_text(self.path("w.step"))))
        for file in ("best.step", "best.iges", "best.stl"):
            self.assertGreater(os.path.getsize(self.path("o/" + file)), 10000)

    def test_a_run_that_asked_for_no_wear_wears_where_it_is_exported(self):
        text = re.sub(r'"asymptotic_wear_volume_m3"', '"peak_amplitude_m"', self.text("s.toml"))
        text = re.sub(r"(?m)^max_evaluations = .*$", "max_evaluations = 1", text)
        with open(self.path("amplitude.toml"), "w") as stream:
            stream.write(text + '[[case]]\nname = "a"\n[[case]]\nname = "b"\n"loading.tip_force_n" = 3\n')
        done = self.run_program("run", "amplitude.toml", "-o", "amplitude")
        self.assertEqual(done.returncode, 0, done.stderr)
        for file, option in (("worn.step", ["--worn"]), ("wear.pvd", [])):
            done = self.run_program("export", "amplitude", "--format", file[-4:].strip("."), "-o", file, *option)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("of case a, the first, alone", done.stderr)
        self.assertTrue(bspline_points(step_text(self.path("worn.step"))))

    def test_wrong_input_is_one_sentence(self):
        for said, *arguments in (
                ("must be 1 to 3: the run has no more", "o", "--format", "step", "--candidate", 4),
                ("must be >= 1", "o", "--format", "step", "--candidate", 0),
                ("only has a meaning with the directory of a run", "s.toml", "--format", "step", "--candidate", 1),
                ("must be one of dxf", "s.toml", "--format", "stp"),
                ("has no meaning with csv", "o", "--format", "csv", "--candidate", 1),
                ("what a run computed", "o", "--format", "csv", "--set", "geometry.neck_width_mm=9"),
                ("must be the directory of a run for csv", "s.toml", "--format", "csv"),
                ("must be step, iges or stl with --worn", "s.toml", "--format", "dxf", "--worn"),
                ("holds no results", ".", "--format", "pvd"),
                ("geometry.rim_radius_mm", "s.toml", "--format", "step", "--set", "geometry.neck_width_mm=1000",
                 "--set", "geometry.rim_radius_mm=400")):
            done = self.run_program("export", *arguments, "-o", "wrong.out")
            self.assertEqual(done.returncode, 2, arguments)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn(said, done.stderr)
            self.assertFalse(os.path.exists(self.path("wrong.out")))


if __name__ == "__main__":
    DOVETAIL = os.path.abspath(sys.argv.pop(1))
    unittest.main()
