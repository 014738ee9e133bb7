#!/usr/bin/env python3
"""`axil` starts at once: light commands load no heavy library, the others are handed over to the program that has them.

  start_test.py AXIL
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

AXIL = pathlib.Path(sys.argv[1]).resolve()
HEAVY = ("libvtk", "libopencv", "libceres")
PLANT = "Lsystem: a\nderivation length: 2\nAxiom: A\nA --> F[+A]A\nendlsystem\n"


def run(*words, **options):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True, timeout=120, **options)
    return done.returncode, done.stdout, done.stderr


def libraries(program):
    return run("ldd", program)[1]


class Start(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="axil_start_"))
        self.plant = self.folder / "plant.l"
        self.plant.write_text(PLANT)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def test_the_light_program_loads_nothing_heavy(self):
        loaded = libraries(AXIL)
        self.assertIn("libc.so", loaded)
        self.assertEqual([name for name in HEAVY if name in loaded], [])

    def test_measuring_loads_no_drawing_library(self):
        loaded = libraries(AXIL.parent / "axil-measure")
        self.assertTrue("libopencv_calib3d" in loaded and "libvtk" not in loaded)

    def test_help_lists_every_command_of_every_program(self):
        light = run(AXIL, "--help")[1]
        self.assertEqual(light, run(AXIL.parent / "axil-draw", "--help")[1])
        for command in ("derive", "emit", "grow", "build", "completion"):
            self.assertIn(command, light)

    def test_alone_it_does_what_it_can_and_says_what_is_missing(self):
        alone = self.folder / "bin/axil"
        alone.parent.mkdir()
        shutil.copy(AXIL, alone)
        self.assertEqual(run(alone, "derive", self.plant), (0, "F[+F[+A]A]F[+A]A\n", ""))
        status, out, err = run(alone, "grow", self.plant, "-o", self.folder / "x.json")
        self.assertEqual((status, out), (1, ""))
        self.assertIn("axil-draw", err)
        self.assertEqual(err.count("\n"), 1)

    def test_installed_it_finds_the_others(self):
        places = {"axil": "bin/axil", "axil-measure": "libexec/axil/axil-measure", "axil-draw": "libexec/axil/axil-draw"}
        for name, place in places.items():
            (self.folder / place).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(AXIL.parent / name, self.folder / place)
        status, _, err = run(self.folder / "bin/axil", "grow", self.plant, "-o", self.folder / "x.json")
        self.assertEqual((status, err), (0, ""))
        (self.folder / "here").symlink_to(self.folder / "bin/axil")
        self.assertEqual(run(self.folder / "here", "quantify", self.folder / "none.axil")[0], 1)

    def test_status_and_usage_come_through(self):
        self.assertEqual(run(AXIL, "grow")[0], 2)
        self.assertEqual(run(AXIL, "emit", self.folder / "none.axil")[0], 1)
        status, out, _ = run(AXIL, "build", "--help")
        self.assertEqual(status, 0)
        self.assertIn("Usage: axil build", out)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[2:])
