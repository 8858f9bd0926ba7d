#!/usr/bin/env python3
"""Builds the site of all pages and opens in a browser those that have formulas:  site_test.py PATH_OF_DOVETAIL

Leaves with 77 where no Chromium is installed."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import browser

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.site = pathlib.Path(cls.folder.name)
        subprocess.run(["bash", ROOT / "studies/docs/build", PROGRAM, cls.site], check=True, stdout=subprocess.DEVNULL)
        cls.browser = browser.Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.folder.cleanup()

    def test_formulas_are_drawn(self):
        pages = [page for page in self.site.rglob("*.html") if 'class="formula"' in page.read_text()]
        self.assertGreater(len(pages), 8)
        for page in pages:
            with self.subTest(page=page.relative_to(self.site).as_posix()):
                self.browser.open(page)
                self.assertEqual(self.browser.errors, [])
                self.assertTrue(self.browser.ask("[...document.querySelectorAll('.formula')].every(f => f.querySelector('.katex-html'))"))
                # In KaTeX's own letters, which lie beside the page.
                self.assertTrue(self.browser.ask("document.fonts.ready.then(() => document.fonts.check('16px KaTeX_Math'))"))
                self.assertEqual(self.browser.ask("[...document.fonts].filter(f => f.status === 'error').length"), 0)

    def test_the_reference_shows_how_data_flow(self):
        self.browser.open(self.site / "api/index.html")
        self.assertEqual(self.browser.errors, [])
        self.assertIn("optimizer::SceneEvaluator", self.browser.ask("document.body.innerText"))
        self.assertIn("int main", self.browser.ask("document.body.innerText"))


if not browser.find():
    print("skipped: no Chromium is installed")
    sys.exit(77)
PROGRAM = sys.argv.pop(1)
unittest.main()
