#!/usr/bin/env python3
"""The samples' structured grammars are those that are checked in, and their text stays short.

  grammars_test.py AXIL SOURCE_FOLDER

A mismatch leaves NAME.out beside the golden file; look at the difference and copy it over when it is meant.
"""
import pathlib
import subprocess
import sys
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


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
