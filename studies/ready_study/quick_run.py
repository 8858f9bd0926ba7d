"""What the checks of ready studies share: one run of the program in its quick form, and its files."""
import os
import re
import subprocess
import sys
import tempfile
import unittest


class QuickRun(unittest.TestCase):
    program = study = ""

    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.folder = cls.kept.name
        command = [cls.program, cls.folder, "--study", cls.study, "--quick"]
        cls.answer = subprocess.run(command, capture_output=True, text=True)

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()

    def read(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            return file.read()

    def test_everything_converged(self):
        self.assertEqual(self.answer.returncode, 0, self.answer.stderr)

    def standing_alone(self):
        """The page, which refers to nothing outside of it, and says that it is a quick look."""
        page = self.read("report.html")
        without_scripts = re.sub(r"(?s)(<script[^>]*>).*?</script>", r"\1", page)
        self.assertIsNone(re.search(r'<(link|img)\b|<script[^>]* src|src="|href="http', without_scripts))
        self.assertIn("A quick look", page)
        for what in ("Time taken", "Commit", "Compiler", "Date", "Study file"):
            self.assertIn(what, page)
        return page


def main(check):
    """Of a check that is called with the program and a study file, that of its own folder if none is given."""
    QuickRun.program = sys.argv.pop(1)
    own = os.path.join(os.path.dirname(os.path.abspath(check)), "study.toml")
    QuickRun.study = sys.argv.pop(1) if len(sys.argv) > 1 else own
    unittest.main()
