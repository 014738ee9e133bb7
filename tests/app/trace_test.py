#!/usr/bin/env python3
"""`axil trace` and `axil skeleton --snap` as a user runs them.

  trace_test.py AXIL SOURCE_FOLDER [TEST ...]
"""
import json
import math
import pathlib
import random
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

AXIL = str(pathlib.Path(sys.argv[1]).resolve())
SOURCE = pathlib.Path(sys.argv[2]).resolve()
SIZE = (300, 400)
FOCAL, DISTANCE = 640.0, 2.4
NOMINAL = {"front": ((1, 0, 0), (0, -1, 0), (0, 0, -1)), "right": ((0, 0, -1), (0, -1, 0), (-1, 0, 0)), "top": ((1, 0, 0), (0, 0, 1), (0, -1, 0))}
STEMS = [[(0, 0, 0), (0.01, 0.95, 0)], [(0.005, 0.45, 0), (0.3, 0.7, 0.12)], [(0.007, 0.65, 0), (-0.22, 0.9, -0.2)]]


def axil(*arguments, timeout=240):
    """-> (exit status, stdout, stderr)"""
    done = subprocess.run([AXIL, *map(str, arguments)], capture_output=True, timeout=timeout)
    return done.returncode, done.stdout.decode("utf-8"), done.stderr.decode("utf-8")


def pixel(view, point):
    """Aimed at half of the plant's height."""
    p = (point[0], point[1] - 0.5, point[2])
    x, y, z = (sum(r * c for r, c in zip(row, p)) for row in NOMINAL[view])
    return SIZE[0] / 2 + FOCAL * x / (z + DISTANCE), SIZE[1] / 2 + FOCAL * y / (z + DISTANCE)


def camera(view):
    translation = [-0.5 * row[1] + (DISTANCE if k == 2 else 0) for k, row in enumerate(NOMINAL[view])]
    return {"model": "perspective", "focal_px": [FOCAL, FOCAL], "centre_px": [SIZE[0] / 2, SIZE[1] / 2], "distortion": [0] * 5, "rotation": NOMINAL[view], "translation": translation}


def between(a, b, share):
    return tuple(u + share * (v - u) for u, v in zip(a, b))


def coverage(view, width):
    """How much of each pixel stems cover, 0 to 1, a list of rows: the distance from the nearest stem's line, softened over a pixel."""
    rows = [[0.0] * SIZE[0] for _ in range(SIZE[1])]
    for a, b in STEMS:
        steps = 300
        for k in range(steps + 1):
            u, v = pixel(view, between(a, b, k / steps))
            for y in range(max(0, int(v - width)), min(SIZE[1], int(v + width) + 1)):
                for x in range(max(0, int(u - width)), min(SIZE[0], int(u + width) + 1)):
                    inside = width / 2 - math.hypot(x + 0.5 - u, y + 0.5 - v) + 0.5
                    rows[y][x] = max(rows[y][x], min(1.0, max(0.0, inside)))
    return rows


def write_png(path, rows, plant, back):
    """`rows` of shares as a colour picture."""
    data = b"".join(b"\0" + bytes(round(b + s * (p - b)) for s in row for p, b in zip(plant, back)) for row in rows)
    chunk = lambda kind, body: struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b""))


class Drawn(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="axil_trace_"))
        for view in NOMINAL:
            rows = coverage(view, 6)
            write_png(cls.folder / f"{view}.png", rows, (70, 120, 50), (205, 203, 198))
            write_png(cls.folder / f"{view}.mask.png", [[1.0 if s >= 0.5 else 0.0 for s in row] for row in rows], (255, 255, 255), (0, 0, 0))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def project(self, name, nodes=(), stems=()):
        views = [{"name": v, "photo": f"{v}.png", "camera": camera(v)} for v in NOMINAL]
        path = self.folder / name
        path.write_text(json.dumps({"axil": 1, "name": "drawn", "unit": "m", "views": views, "nodes": list(nodes), "stems": list(stems)}))
        return path

    def masks(self):
        return [part for v in NOMINAL for part in ("--mask", f"{v}={self.folder / v}.mask.png")]


class Trace(Drawn):
    def check(self, traced):
        status, out, err = axil("skeleton", traced)
        self.assertEqual(status, 0, err)
        skeleton = json.loads(out)
        self.assertEqual(len(skeleton["stems"]), 3, err)
        place = {n["id"]: n["position"] for n in skeleton["nodes"]}
        for _, tip in STEMS:
            self.assertLess(min(math.dist(tip, place[s["nodes"][-1]]) for s in skeleton["stems"]), 0.03)

    def test_masks_give_the_stems_and_how_sure_each_is(self):
        traced = self.folder / "traced.axil"
        status, out, err = axil("trace", self.project("plain.axil"), *self.masks(), "-o", traced)
        self.assertEqual((status, out), (0, ""), err)
        self.assertIn("% sure", err)
        self.check(traced)
        self.assertTrue(all(0 < float(s["draft_sureness"]) <= 1 for s in json.loads(traced.read_text())["stems"]))

    def test_colours_in_a_box_do_without_masks(self):
        boxes = []
        for v in NOMINAL:
            seen = [pixel(v, between(a, b, k / 20)) for a, b in STEMS for k in range(21)]
            low, high = [max(0, min(p[i] for p in seen) - 9) for i in (0, 1)], [min(SIZE[i], max(p[i] for p in seen) + 9) for i in (0, 1)]
            boxes += ["--box", f"{v}={low[0]:.0f},{low[1]:.0f},{high[0]:.0f},{high[1]:.0f}"]
        traced = self.folder / "boxed.axil"
        status, _, err = axil("trace", self.project("colours.axil"), *boxes, "-o", traced)
        self.assertEqual(status, 0, err)
        self.check(traced)

    def test_loose_nodes_stay_and_photos_are_found_from_another_folder(self):
        loose = {"id": 7, "clicks": {"front": [150, 200]}}
        other = self.folder / "there" / "deeper"
        other.mkdir(parents=True)
        status, _, err = axil("trace", self.project("loose.axil", [loose]), *self.masks(), "-o", other / "traced.axil")
        self.assertEqual(status, 0, err)
        traced = json.loads((other / "traced.axil").read_text())
        self.assertEqual([n for n in traced["nodes"] if n["id"] == 7][0]["clicks"], {"front": [150, 200]})
        self.assertEqual(len({n["id"] for n in traced["nodes"]}), len(traced["nodes"]))
        for view in traced["views"]:
            self.assertTrue((other / view["photo"]).is_file(), view["photo"])

    def test_what_was_clicked_as_stems_is_never_replaced(self):
        nodes = [{"id": 1, "clicks": {v: pixel(v, STEMS[0][0]) for v in NOMINAL}}, {"id": 2, "clicks": {v: pixel(v, STEMS[0][1]) for v in NOMINAL}}]
        project = self.project("clicked.axil", nodes, [{"id": 1, "nodes": [1, 2]}])
        before = project.read_bytes()
        status, out, err = axil("trace", project, *self.masks())
        self.assertEqual((status, out), (1, ""))
        self.assertIn("has stems already", err)
        self.assertEqual(project.read_bytes(), before)

    def test_wrong_options_are_one_clear_line(self):
        project = self.project("wrong.axil")
        for arguments, words in [(["--mask", "front"], "VIEW=FILE"), (["--mask", "side=x.png"], "no view 'side'"), (["--mask", f"front={self.folder}/none.png"], "none.png"),
                                 (["--box", "front=1,2,3"], "X0,Y0,X1,Y1"), (["--box", "front=50,60,40,90"], "X0,Y0,X1,Y1"), (["--box", "front=0,0,9999,90"], "300 x 400"),
                                 (["--box", "front=nan,0,20,90"], "X0,Y0,X1,Y1"), (["--box", "front=0,0,4,4"], "box")]:
            status, out, err = axil("trace", project, *arguments)
            self.assertEqual((status, out), (1, ""), arguments)
            self.assertIn(words, err)
            self.assertEqual(err.count("\n"), 1, err)


class Lantana(unittest.TestCase):
    """Leaves, no masks: hardly a draft to keep, but one that comes soon and can be stopped."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="axil_lantana_"))
        for photo in (SOURCE / "samples/lantana").glob("*.jpg"):
            shutil.copy(photo, self.folder)
        project = json.loads((SOURCE / "samples/lantana/lantana.axil").read_text())
        project.update(nodes=[], stems=[], leaves=[])
        self.project = self.folder / "lantana.axil"
        self.project.write_text(json.dumps(project))

    def tearDown(self):
        shutil.rmtree(self.folder)

    def test_ends_within_the_limits(self):
        status, _, err = axil("trace", self.project, "-o", self.folder / "traced.axil")
        self.assertIn(status, (0, 1))
        self.assertNotEqual(err, "")

    def test_stops_when_interrupted(self):
        running = subprocess.Popen([AXIL, "trace", str(self.project)], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(1)
        begun = time.monotonic()
        running.send_signal(signal.SIGINT)
        out, _ = running.communicate(timeout=120)
        self.assertNotEqual(running.returncode, 0)
        self.assertEqual(out, b"")
        print(f"stopped after {time.monotonic() - begun:.1f} s")


class Snap(Drawn):
    def off(self, skeleton):
        """Distances of the nodes from the stems' lines, sorted."""
        result = []
        for node in skeleton["nodes"]:
            p = node["position"]
            result.append(min(min(math.dist(p, between(a, b, k / 400)) for k in range(401)) for a, b in STEMS))
        return sorted(result)

    def test_snapped_clicks_lie_on_the_stems_and_have_radii(self):
        rng, nodes, stems = random.Random(5), [], []
        for a, b in STEMS:
            chain = []
            for k in range(6):
                point = between(a, b, k / 5)
                nodes.append({"id": len(nodes) + 1, "clicks": {v: [c + rng.gauss(0, 2) for c in pixel(v, point)] for v in NOMINAL}})
                chain.append(len(nodes))
            stems.append({"id": len(stems) + 1, "nodes": chain})
        stems[1]["nodes"][0], stems[2]["nodes"][0] = stems[0]["nodes"][2], stems[0]["nodes"][3]
        nodes = [n for n in nodes if n["id"] not in (7, 13)]
        project = self.project("snap.axil", nodes, stems)
        plain, snapped = axil("skeleton", project), axil("skeleton", project, "--snap")
        self.assertEqual((plain[0], snapped[0]), (0, 0), plain[2] + snapped[2])
        before, after = self.off(json.loads(plain[1])), self.off(json.loads(snapped[1]))
        middle = len(before) // 2
        print(f"seed 5: median {before[middle]:.4f} -> {after[middle]:.4f}, most {before[-1]:.4f} -> {after[-1]:.4f} (seen, a pixel is {DISTANCE / FOCAL:.4f})")
        self.assertLess(after[middle], 0.5 * before[middle])
        radii = [n["radius"] for n in json.loads(snapped[1])["nodes"] if n.get("radius")]
        self.assertGreater(len(radii), 10)
        off = sorted(abs(r / (3 * DISTANCE / FOCAL) - 1) for r in radii)
        print(f"radii of stems 6 px wide: {100 * off[len(off) // 2]:.1f} % off in the middle, {100 * off[-1]:.1f} % at most")
        self.assertLess(off[len(off) // 2], 0.1)
        self.assertLess(off[-1], 0.3)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=1)
