#!/usr/bin/env python3
"""Every plant of samples/classic: no mistake in it, derived, drawn and written; docs/classic.md shows each.

  classic_test.py AXIL SOURCE_FOLDER
"""
import json
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

AXIL = str(pathlib.Path(sys.argv[1]).resolve())
SOURCE = pathlib.Path(sys.argv[2]).resolve()
PLANTS = sorted((SOURCE / "samples/classic").glob("*.l"))


def axil(*arguments):
    done = subprocess.run([AXIL, *map(str, arguments)], capture_output=True, text=True, timeout=120)
    return done.returncode, done.stdout, done.stderr


def brightness(png):
    """The bytes of an 8-bit RGB PNG, filters undone only as far as a mean of differences needs: the raw scan lines."""
    data, at, packed = png.read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        packed += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += size + 12
    return zlib.decompress(packed)


class Classic(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="axil_classic_"))

    def tearDown(self):
        shutil.rmtree(self.folder)

    def test_there_are_a_dozen_at_least(self):
        self.assertGreaterEqual(len(PLANTS), 12)

    def test_each_is_clean_and_grows(self):
        for plant in PLANTS:
            with self.subTest(plant.stem):
                self.assertEqual(axil("check", plant), (0, "", ""))
                status, out, err = axil("derive", plant, "--counts")
                self.assertEqual((status, err), (0, ""))
                self.assertGreater(sum(json.loads(out)["letters"].values()), 80)
                status, _, err = axil("grow", plant, "-o", self.folder / "plant.glb")
                self.assertEqual((status, err), (0, ""), err)
                self.assertGreater((self.folder / "plant.glb").stat().st_size, 10_000)

    def test_pictures_are_not_empty(self):
        empty = self.folder / "empty.l"
        empty.write_text("Lsystem: e\nderivation length: 1\nAxiom: A\nA --> A\nendlsystem\n")
        self.assertEqual(axil("grow", empty, "-o", self.folder / "empty.png", "--width", 90, "--height", 120)[0], 0)
        blank = brightness(self.folder / "empty.png")
        for plant in PLANTS[::4]:
            with self.subTest(plant.stem):
                picture = self.folder / (plant.stem + ".png")
                self.assertEqual(axil("grow", plant, "-o", picture, "--width", 90, "--height", 120)[0], 0)
                drawn = brightness(picture)
                self.assertEqual(len(drawn), len(blank))
                changed = sum(a != b for a, b in zip(drawn, blank))
                self.assertGreater(changed, 0.02 * len(blank))

    def test_the_page_shows_each(self):
        page = (SOURCE / "docs/classic.md").read_text()
        for plant in PLANTS:
            self.assertIn(f"samples/classic/{plant.name}", page)
            self.assertIn(f"pictures/classic/{plant.stem}.jpg", page)
            self.assertTrue((SOURCE / f"docs/pictures/classic/{plant.stem}.jpg").exists(), plant.stem)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[3:])
