#!/usr/bin/env python3
"""`axil fmt` and the traces of `axil derive`, as a user runs them.

  grammar_text_test.py AXIL
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

AXIL = str(pathlib.Path(sys.argv[1]).resolve())

UNTIDY = "lsystem:1\r\n#define N  2\r\nderivation   length:N\r\nAxiom:A(1)\r\nA(x):x<3-->F(x)A(x+1)   // grows\r\nhomomorphism\nF(l)-->G(l)\nendlsystem"
TIDY = "lsystem: 1\n#define N  2\nderivation length: N\nAxiom: A(1)\nA(x) : x<3 --> F(x)A(x+1)  // grows\nhomomorphism\nF(l) --> G(l)\nendlsystem\n"
BROKEN = "Lsystem: 1\nAxiom: A\nA -> B\nendlsystem\n"


def axil(*arguments, **options):
    return subprocess.run([AXIL, *map(str, arguments)], capture_output=True, text=True, timeout=60, **options)


class Fmt(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.file = self.folder / "plant.l"
        self.file.write_bytes(UNTIDY.encode())

    def test_lays_a_file_out_in_place_and_once(self):
        self.file.chmod(0o640)
        done = axil("fmt", self.file)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assertEqual(self.file.read_bytes().decode(), TIDY)
        self.assertEqual(self.file.stat().st_mode & 0o777, 0o640)
        self.assertEqual(os.listdir(self.folder), ["plant.l"])
        self.assertEqual(axil("fmt", "--check", self.file).returncode, 0)

    def test_check_names_the_file_and_leaves_it(self):
        done = axil("fmt", "--check", self.file)
        self.assertEqual((done.returncode, done.stdout), (1, f"{self.file}\n"))
        self.assertEqual(self.file.read_bytes().decode(), UNTIDY)

    def test_standard_input_is_printed(self):
        done = axil("fmt", "-", input=UNTIDY)
        self.assertEqual((done.returncode, done.stdout), (0, TIDY))
        self.assertEqual(axil("fmt", "-", input=BROKEN).returncode, 1)

    def test_a_broken_file_stays_and_the_others_are_laid_out(self):
        broken = self.folder / "broken.l"
        broken.write_text(BROKEN)
        done = axil("fmt", broken, self.file)
        self.assertEqual(done.returncode, 1)
        self.assertIn("broken.l:3:3: error: an arrow is written -->", done.stderr)
        self.assertEqual(broken.read_text(), BROKEN)
        self.assertEqual(self.file.read_text(), TIDY)

    def test_a_link_stays_a_link(self):
        link = self.folder / "link.l"
        link.symlink_to(self.file)
        self.assertEqual(axil("fmt", link).returncode, 0)
        self.assertTrue(link.is_symlink())
        self.assertEqual(self.file.read_text(), TIDY)


class Trace(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = pathlib.Path(folder.name) / "plant.l"
        self.file.write_text(TIDY)

    def test_a_line_a_module_names_its_rule(self):
        lines = axil("derive", self.file, "--trace").stdout.splitlines()
        self.assertEqual(len(lines), 3)
        number, module, step, rule = lines[1].split("\t")
        self.assertEqual((number, module, step), ("2", "F(2)", "step 2"))
        self.assertIn("plant.l:5", rule)

    def test_json_has_rules_with_lines_and_modules_with_rules(self):
        trace = json.loads(axil("derive", self.file, "--trace", "--json").stdout)
        self.assertEqual(trace["rules"][0]["line"], 5)
        self.assertEqual([(m["letter"], m["step"], m["rule"]) for m in trace["modules"]], [("F", 1, 0), ("F", 2, 0), ("A", 2, 0)])
        axiom = json.loads(axil("derive", self.file, "--trace", "--json", "--steps", 0).stdout)
        self.assertIsNone(axiom["modules"][0]["rule"])

    def test_the_string_as_it_is_drawn(self):
        self.assertEqual(axil("derive", self.file, "--interpreted").stdout, "G(1)G(2)A(3)\n")
        self.assertEqual(axil("derive", self.file).stdout, "F(1)F(2)A(3)\n")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
