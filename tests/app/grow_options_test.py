#!/usr/bin/env python3
"""The options of `axil grow` and `axil derive` that say what surrounds a plant and how much a grammar may take.

  grow_options_test.py AXIL
"""
import json
import math
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

AXIL = str(pathlib.Path(sys.argv[1]).resolve())

PLANT = """EcoSystem 1.1 "g" {
    Plant "p" {
        Direction = vector(0, 1, 0);
        DeriveTime = 1;
        Apex {}
        Stem { Stage 1 { GrowRate = 0.1; GrowTime = 1; BroadenRate = 0.005; GravityTropism = 0.2; LightTropism = 0.3; } }
        Leaf {} Root {} Fruit {} Flower {}
        Grow { w = A(0); A(i) -> rotr(0.15) S(1) A(i+1, i < 9); }
    }
}
"""
ENDLESS = 'Lsystem: e\nderivation length: 60\nAxiom: A\nA --> AA\nendlsystem\n'
LOOP = "Lsystem: l\nderivation length: 2\nAxiom: A(0)\nA(n) : * {i=0; while (i < n*1000) { i=i+1; }} --> A(n+1)\nendlsystem\n"


def axil(*arguments):
    done = subprocess.run([AXIL, *map(str, arguments)], capture_output=True, text=True, timeout=120)
    return done.returncode, done.stdout, done.stderr


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="axil_grow_"))
        self.plant = self.write("p.simeco", PLANT)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name

    def nodes(self, *options):
        out = self.folder / "grown.json"
        status, _, err = axil("grow", self.plant, "-o", out, *options)
        self.assertEqual(status, 0, err)
        return [node["position"] for node in json.loads(out.read_text())["nodes"]]


class Environment(Case):
    def test_wind_and_light_move_the_tip_their_way(self):
        still = self.nodes()[-1]
        self.assertGreater(self.nodes("--wind", "0.8,0,0")[-1][0], still[0] + 0.01)
        self.assertLess(self.nodes("--wind", "-0.8,0,0")[-1][0], still[0] - 0.01)
        self.assertGreater(self.nodes("--light", "0,0.2,1")[-1][2], still[2] + 0.01)

    def test_gravity_may_point_anywhere(self):
        self.assertNotEqual(self.nodes("--gravity", "1,0,0"), self.nodes("--gravity", "-1,0,0"))

    def test_the_best_of_everything_is_as_without_and_worse_is_smaller(self):
        best = self.nodes("--soil-ph", 7, "--rain", 0.9, "--day-light", 12, "--temperature", 22)
        self.assertEqual(best, self.nodes())
        height = lambda nodes: sum(math.dist(a, b) for a, b in zip(nodes, nodes[1:]))
        for option, value in (("--soil-ph", 4.5), ("--rain", 0.2), ("--day-light", 5), ("--temperature", 9)):
            self.assertLess(height(self.nodes(option, value)), 0.99 * height(best), option)

    def test_nothing_grows_into_an_obstacle(self):
        ahead = self.nodes()[-3]
        centre = ",".join(str(x) for x in ahead)
        for node in self.nodes("--obstacle", f"sphere:{centre},0.08"):
            self.assertGreater(math.dist(node, ahead), 0.0799)
        low, high = [x - 0.06 for x in ahead], [x + 0.06 for x in ahead]
        for node in self.nodes("--obstacle", "box:" + ",".join(map(str, low + high))):
            self.assertFalse(all(l + 1e-6 < x < h - 1e-6 for l, x, h in zip(low, node, high)), node)
        # The same box as a mesh of six squares.
        obj = "".join(f"v {(low, high)[i & 1][0]} {(low, high)[i >> 1 & 1][1]} {(low, high)[i >> 2][2]}\n" for i in range(8))
        (self.folder / "box.obj").write_text(obj + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n")
        nodes = self.nodes("--obstacle", f"mesh:{self.folder / 'box.obj'}")
        self.assertNotEqual(nodes, self.nodes())
        for node in nodes:
            self.assertFalse(all(l + 1e-6 < x < h - 1e-6 for l, x, h in zip(low, node, high)), node)

    def test_an_obstacle_is_in_the_picture(self):
        size = ("--width", 60, "--height", 80)
        self.assertEqual(axil("grow", self.plant, "-o", self.folder / "a.png", *size)[0], 0)
        self.assertEqual(axil("grow", self.plant, "-o", self.folder / "b.png", *size, "--obstacle", "sphere:1,0.2,0.3,0.2")[0], 0)
        self.assertNotEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())

    def test_what_makes_no_sense_is_said(self):
        for words, says in ((("--wind", "1,2"), "three numbers"), (("--light", "a,b,c"), "three numbers"), (("--obstacle", "cone:1,2,3"), "sphere:"),
                            (("--obstacle", "sphere:1,2,3"), "sphere:"), (("--obstacle", "mesh:nowhere.obj"), "nowhere.obj"), (("--temperature", "warm"), "temperature")):
            status, _, err = axil("grow", self.plant, "-o", self.folder / "x.json", *words)
            self.assertEqual(status, 2, words)
            self.assertIn(says, err)
        for words in (("--obstacle", "sphere:0,0,0,-1"), ("--light", "0,0,0")):
            status, _, err = axil("grow", self.plant, "-o", self.folder / "x.json", *words)
            self.assertEqual((status, err.count("error")), (1, 1), err)
        self.assertFalse((self.folder / "x.json").exists())


class Limits(Case):
    def refused(self, grammar, *options, says):
        for command in (("derive", grammar), ("grow", grammar, "-o", self.folder / "x.json")):
            status, out, err = axil(*command, *options)
            self.assertEqual((status, out), (1, ""), err)
            self.assertIn(says, err)

    def test_each_stops_with_its_own_words(self):
        endless, loop = self.write("e.l", ENDLESS), self.write("l.l", LOOP)
        self.refused(endless, "--max-modules", 1000, says="1000 modules")
        self.refused(endless, "--max-memory", "1MB", says="bytes")
        self.refused(endless, "--max-steps", 20, says="20")
        self.refused(loop, "--max-loop-iterations", 500, says="500")
        deep = self.write("d.l", "Lsystem: d\nderivation length: 1\nAxiom: A(1)\nA(n) --> A(" + "(" * 30 + "n" + "+1)" * 30 + ")\nendlsystem\n")
        self.refused(deep, "--max-expression-depth", 10, says="10")

    def test_wall_time(self):
        slow = self.write("s.l", LOOP.replace("length: 2", "length: 100000").replace("n*1000", "100000"))
        start = time.monotonic()
        status, _, err = axil("derive", slow, "--max-seconds", 0.3)
        self.assertEqual(status, 1, err)
        self.assertIn("longer than its limit of 0.3 s", err)
        self.assertLess(time.monotonic() - start, 5)

    def test_build_has_them_too(self):
        self.assertIn("--max-memory", axil("build", "--help")[1])

    def test_ctrl_c_ends_long_work_and_leaves_nothing(self):
        slow = self.write("s.l", LOOP.replace("length: 2", "length: 100000").replace("n*1000", "100000"))
        before = sorted(p.name for p in self.folder.iterdir())
        for command in (("derive", slow), ("grow", slow, "-o", str(self.folder / "x.png"))):
            running = subprocess.Popen([AXIL, *map(str, command)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            time.sleep(0.7)
            start = time.monotonic()
            running.send_signal(signal.SIGINT)
            out, err = running.communicate(timeout=30)
            self.assertLess(time.monotonic() - start, 3)
            self.assertEqual((running.returncode, out), (1, ""))
            self.assertIn("cancelled", err)
        self.assertEqual(before, sorted(p.name for p in self.folder.iterdir()))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[2:])
