#!/usr/bin/env python3
"""The samples' structured grammars are those that are checked in, and their text stays short.

  grammars_test.py AXIL SOURCE_FOLDER

A mismatch leaves NAME.out beside the golden file; look at the difference and copy it over when it is meant.
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

AXIL = str(pathlib.Path(sys.argv[1]).resolve())
SOURCE = pathlib.Path(sys.argv[2]).resolve()
GOLDEN = SOURCE / "tests/golden/grammars"
FORMS = ("exact", "statistical")


def emitted(sample, *options):
    done = subprocess.run([AXIL, "emit", str(SOURCE / f"samples/{sample}/{sample}.axil"), *options], capture_output=True, timeout=300)
    assert done.returncode == 0, done.stderr.decode()
    return done.stdout


class Golden(unittest.TestCase):
    def test_structured_grammars_are_as_checked_in(self):
        for sample in ("lantana", "aspen"):
            for form in FORMS:
                with self.subTest(sample=sample, form=form):
                    golden = GOLDEN / f"{sample}_{form}.simeco"
                    text = emitted(sample, "--kind", "structured", "--form", form)
                    if text != golden.read_bytes():
                        golden.with_suffix(".out").write_bytes(text)
                    self.assertEqual(text.decode(), golden.read_text(encoding="utf-8"))

    def test_the_exact_form_takes_less_than_a_third_of_the_initial_grammar(self):
        for sample in ("lantana", "aspen"):
            initial = len(emitted(sample, "--kind", "initial"))
            exact = len(emitted(sample, "--kind", "structured", "--form", "exact"))
            print(f"{sample}: {exact} of {initial} bytes, {100 * exact / initial:.1f} %")
            self.assertLessEqual(exact, 0.3 * initial)

    def test_options_that_the_kind_does_not_read_are_refused(self):
        project = str(SOURCE / "samples/lantana/lantana.axil")
        for options in (["--stages", "3"], ["--kind", "structured", "--style", "thesis"], ["--form", "exact"], ["--kind", "structured", "--error", "0.1"],
                        ["--kind", "structured", "--form", "exact", "--orders", "1"], ["--kind", "structured", "--form", "exact", "--also", project]):
            with self.subTest(options=options):
                done = subprocess.run([AXIL, "emit", project, *options], capture_output=True, text=True, timeout=300)
                self.assertEqual(done.returncode, 2)
                self.assertIn("leave it out", done.stderr)
                self.assertEqual(done.stdout, "")

    def test_a_family_of_several_plants_has_two_rules_an_order(self):
        text = emitted("lantana", "--kind", "structured", "--also", str(SOURCE / "samples/lantana/lantana.axil")).decode()
        self.assertIn("Plants like 2 measured ones", text)
        self.assertLessEqual(text.count("->"), 4)


class Compare(unittest.TestCase):
    def run_axil(self, *arguments):
        return subprocess.run([AXIL, *arguments], capture_output=True, text=True, timeout=300)

    def test_a_plant_is_the_same_as_itself_and_as_its_initial_grammar(self):
        project = str(SOURCE / "samples/lantana/lantana.axil")
        with tempfile.TemporaryDirectory() as folder:
            grammar = pathlib.Path(folder) / "initial.simeco"
            grammar.write_bytes(emitted("lantana", "--kind", "initial"))
            for other in (project, str(grammar)):
                done = self.run_axil("compare", project, other, "--json")
                self.assertEqual(done.returncode, 0, done.stderr)
                result = json.loads(done.stdout)
                self.assertEqual(result["nodes"]["recall"], 1)
                if other == project:  # a grammar's leaf stalks count as stems
                    self.assertEqual(result["nodes"]["precision"], 1)
                    self.assertEqual(result["tree_edit_distance"], 0)

    def test_wrong_input_is_named(self):
        done = self.run_axil("compare", str(SOURCE / "samples/lantana/lantana.axil"), "/nowhere/at/all.axil")
        self.assertEqual(done.returncode, 1)
        self.assertIn("/nowhere/at/all.axil", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
