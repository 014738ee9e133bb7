#!/usr/bin/env python3
"""`axil skeleton --report` and `axil calibrate` as a user runs them: photographs without calibration, and what goes wrong with them.

  measuring_test.py AXIL SOURCE_FOLDER [TEST ...]
"""
import json
import math
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

AXIL = str(pathlib.Path(sys.argv[1]).resolve())
SOURCE = pathlib.Path(sys.argv[2]).resolve()
HAND = SOURCE.parent / "shared/data/plants/real/arabidopsis/measures.json"
SIZE = (1200, 1600)
NOMINAL = {"front": ((1, 0, 0), (0, -1, 0), (0, 0, -1)), "right": ((0, 0, -1), (0, -1, 0), (-1, 0, 0)), "top": ((1, 0, 0), (0, 0, 1), (0, -1, 0))}


def axil(*arguments):
    """-> (exit status, stdout, stderr)"""
    done = subprocess.run([AXIL, *map(str, arguments)], capture_output=True, timeout=120)
    return done.returncode, done.stdout.decode("utf-8"), done.stderr.decode("utf-8")


def turned(rows, axis, degrees):
    """The rotation `rows`, followed by a turn of the camera about its own `axis` (0 to 2)."""
    c, s, a, b = math.cos(math.radians(degrees)), math.sin(math.radians(degrees)), (axis + 1) % 3, (axis + 2) % 3
    rows = [list(row) for row in rows]
    rows[a], rows[b] = [c * u - s * v for u, v in zip(rows[a], rows[b])], [s * u + c * v for u, v in zip(rows[a], rows[b])]
    return rows


class Camera:
    def __init__(self, rng, name):
        self.rows = NOMINAL[name]
        for axis in range(3):
            self.rows = turned(self.rows, axis, rng.gauss(0, 2))
        self.at = [rng.uniform(-20, 20), rng.uniform(-20, 20)]
        self.focal, self.distance = 2200, rng.uniform(1.0, 1.4)

    def __call__(self, point):
        point = (point[0], point[1] - 0.2, point[2])
        x, y, z = (sum(r * p for r, p in zip(row, point)) for row in self.rows)
        return [SIZE[k] / 2 + self.at[k] + self.focal * v / (z + self.distance) for k, v in enumerate((x, y))]


def tree(rng):
    """-> points, stems of point numbers"""
    points, stems = [(0.0, 0.04 * i, 0.002 * i * i * 0.1) for i in range(11)], [list(range(11))]
    for base in (3, 5, 6, 8, 9):
        turn, stem = rng.uniform(0, 2 * math.pi), [base]
        for k in range(1, 5):
            stem.append(len(points))
            points.append((points[base][0] + 0.03 * k * math.cos(turn), points[base][1] + 0.02 * k, points[base][2] + 0.03 * k * math.sin(turn)))
        stems.append(stem)
    return points, stems


def project(seed=1, noise=0.5, names=("front", "right", "top"), shot=None):
    """A handheld project, as it is written by hand. `shot`: from where each view was really taken."""
    rng = random.Random(seed)
    points, stems = tree(rng)
    nodes = [{"id": i, "clicks": {}} for i in range(len(points))]
    views = []
    for name in names:
        camera = Camera(rng, (shot or {}).get(name, name))

        def seen(point):
            return [u + rng.gauss(0, noise) for u in camera(point)]

        views.append({"name": name, "size_px": list(SIZE), "camera": {"model": "unknown", "focal_px": [2200, 2200]}, "origin_px": seen((0, 0, 0)),
                      "scale": {"from_px": seen((-0.1, 0, 0.05)), "to_px": seen((-0.1, 0.2, 0.05)), "length": 0.2}})
        for node, point in zip(nodes, points):
            node["clicks"][name] = seen(point)
    return {"axil": 1, "name": "plant", "unit": "m", "seed": 1, "description": "", "views": views, "nodes": nodes,
            "stems": [{"id": i, "nodes": stem} for i, stem in enumerate(stems)], "leaves": []}


def bitmap(width, height, colour=(90, 120, 90)):
    row = bytes(colour) * width + b"\0" * (-3 * width % 4)
    data = row * height
    return b"BM" + struct.pack("<IHHIIiiHHIIiiII", 54 + len(data), 0, 0, 54, 40, width, height, 1, 24, 0, len(data), 2835, 2835, 0, 0) + data


def numbers(value):
    if isinstance(value, dict):
        for one in value.values():
            yield from numbers(one)
    elif isinstance(value, list):
        for one in value:
            yield from numbers(one)
    elif isinstance(value, float):
        yield value


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="axil_measuring_"))

    def tearDown(self):
        shutil.rmtree(self.folder)

    def measure(self, made, *arguments):
        path = self.folder / "plant.axil"
        path.write_text(json.dumps(made))
        return axil("skeleton", path, *arguments)

    def refused(self, made, *words):
        status, out, err = self.measure(made)
        self.assertEqual((status, out), (1, ""), err)
        for word in words:
            self.assertIn(word, err)

    def skeleton(self, made, *arguments):
        status, out, err = self.measure(made, *arguments)
        self.assertEqual(status, 0, err)
        skeleton = json.loads(out)
        self.assertTrue(all(math.isfinite(n) for n in numbers(skeleton)))
        return skeleton, err

    def span(self, skeleton):
        at = {node["id"]: node["position"] for node in skeleton["nodes"]}
        return math.dist(at[0], at[10])


class Skeleton(Case):
    def test_handheld_photos_give_size_and_shape(self):
        skeleton, err = self.skeleton(project())
        self.assertAlmostEqual(self.span(skeleton), math.dist((0, 0, 0), (0, 0.4, 0.02)), delta=0.004)
        self.assertNotIn("suspect", err)
        self.assertNotIn("suspect_clicks", skeleton)

    def test_the_report_has_a_line_and_a_picture_a_view(self):
        made = project()
        photo = self.folder / "front.bmp"
        photo.write_bytes(bitmap(*SIZE))
        made["views"][0]["photo"] = "front.bmp"
        self.skeleton(made, "--report", self.folder / "deep/report")
        for view in ("front", "right", "top"):
            self.assertTrue((self.folder / f"deep/report/residuals_{view}.png").read_bytes().startswith(b"\x89PNG"))
        text = (self.folder / "deep/report/report.txt").read_text()
        for words in ("view front:", "px rms", "turned by", "clicks scatter by", "size known to +-"):
            self.assertIn(words, text)
        self.assertNotIn("nan", text.lower())

    def test_a_report_where_no_folder_can_be_is_refused(self):
        (self.folder / "file").write_text("x")
        status, out, err = self.measure(project(), "--report", self.folder / "file/report")
        self.assertEqual((status, out), (1, ""))
        self.assertIn("file/report", err)

    def test_wrong_clicks_are_named_and_do_no_harm(self):
        made = project(seed=3)
        made["nodes"][14]["clicks"]["right"][0] += 45
        made["nodes"][14]["clicks"]["right"][1] -= 30
        made["nodes"][22]["clicks"]["top"][1] += 60
        skeleton, err = self.skeleton(made, "--report", self.folder / "report")
        named = {(click["node"], click["view"]) for click in skeleton["suspect_clicks"]}
        self.assertLessEqual({(14, "right"), (22, "top")}, named)
        self.assertIn("suspect click: node 14 in view right", err)
        self.assertIn("suspect: node 14 in view right", (self.folder / "report/report.txt").read_text())
        true = tree(random.Random(3))[0]
        at = {node["id"]: node["position"] for node in skeleton["nodes"]}
        self.assertAlmostEqual(math.dist(at[14], at[5]), math.dist(true[14], true[5]), delta=0.004)

    def test_a_wrong_click_in_known_cameras_is_named_and_left_out(self):
        rng, made = random.Random(2), project()
        points, _ = tree(random.Random(1))
        for view in made["views"]:
            camera = Camera(rng, view["name"])
            low = [-0.2 * row[1] for row in camera.rows]
            view["camera"] = {"model": "perspective", "focal_px": [camera.focal] * 2, "centre_px": [SIZE[k] / 2 + camera.at[k] for k in (0, 1)],
                              "rotation": [list(row) for row in camera.rows], "translation": [low[0], low[1], low[2] + camera.distance]}
            del view["scale"]
            for node, point in zip(made["nodes"], points):
                node["clicks"][view["name"]] = [u + rng.gauss(0, 0.5) for u in camera(point)]
        made["nodes"][7]["clicks"]["right"][0] += 60
        skeleton, err = self.skeleton(made)
        self.assertIn("suspect click: node 7 in view right", err)
        self.assertEqual([(one["node"], one["view"]) for one in skeleton["suspect_clicks"]], [(7, "right")])
        at = {node["id"]: node["position"] for node in skeleton["nodes"]}
        self.assertLess(math.dist(at[7], points[7]), 0.002)

    def test_photos_without_a_focal_length_do(self):
        made = project()
        for view in made["views"]:
            del view["camera"]["focal_px"]
        skeleton, _ = self.skeleton(made)
        self.assertAlmostEqual(self.span(skeleton), 0.4005, delta=0.012)

    def test_exchanged_mirrored_and_turned_views_are_named(self):
        exchanged = project(shot={"front": "right", "right": "front"})
        self.refused(exchanged, "it seems that", "exchanged")
        mirrored = project()
        for p in [node["clicks"]["right"] for node in mirrored["nodes"]] + [mirrored["views"][1]["origin_px"], mirrored["views"][1]["scale"]["from_px"], mirrored["views"][1]["scale"]["to_px"]]:
            p[0] = SIZE[0] - p[0]
        self.refused(mirrored, "it seems that", "'right' is mirrored")
        rotated = project()
        rotated["views"][2]["size_px"] = [SIZE[1], SIZE[0]]
        for p in [node["clicks"]["top"] for node in rotated["nodes"]] + [rotated["views"][2]["origin_px"], rotated["views"][2]["scale"]["from_px"], rotated["views"][2]["scale"]["to_px"]]:
            p[0], p[1] = SIZE[1] - p[1], p[0]
        self.refused(rotated, "it seems that", "'top' is turned by 90 degrees")

    def test_two_views_from_one_side_are_named(self):
        status, _, err = self.measure(project(shot={"right": "front"}))
        self.assertIn("'right' is taken from the side called 'front'", err)

    def test_no_common_nodes_are_refused(self):
        made = project()
        for i, node in enumerate(made["nodes"]):
            keep = ("front", "right", "top")[i % 3]
            node["clicks"] = {keep: node["clicks"][keep]}
        self.refused(made, "shares 0 clicked nodes")

    def test_lengths_that_say_nothing_are_refused(self):
        for change, words in (({"length": 0}, "length"), ({"length": -1}, "length"), ({"to_px": None}, "scale")):
            made = project()
            for view in made["views"]:
                view["scale"].update(change)
            self.refused(made, words)
        made = project()
        for view in made["views"]:
            view["scale"]["to_px"] = view["scale"]["from_px"]
        self.refused(made, "to_px is the same point as from_px")
        for view in made["views"]:
            del view["scale"]
        self.refused(made, "no length is known")
        made = project()
        for view in made["views"]:
            del view["origin_px"]
        self.refused(made, "origin")

    def test_a_plant_cut_off_is_said(self):
        made = project()
        for node in made["nodes"][24:27]:
            node["clicks"]["front"][1] = 0.5
        _, err = self.skeleton(made)
        self.assertIn("view 'front' cuts the plant off", err)

    def test_photos_of_one_grey_or_far_out_of_focus_keep_every_click_and_say_so(self):
        made = project()
        for view in made["views"]:
            view["photo"] = view["name"] + ".bmp"
        unsnapped = [view | {"photo": ""} for view in made["views"]]
        bare, _ = self.skeleton(made | {"views": unsnapped})
        far_out = bytes(120 + x * 60 // SIZE[0] for x in range(SIZE[0]) for _ in range(3))  # nothing is left but a slope of light
        for name in NOMINAL:
            (self.folder / f"{name}.bmp").write_bytes(bitmap(*SIZE)[:54] + (far_out if name == "right" else b"\x7a" * (3 * SIZE[0])) * SIZE[1])
        skeleton, err = self.skeleton(made, "--snap")
        self.assertIn(f"0 of {3 * len(made['nodes'])} clicks were snapped", err)
        for node, other in zip(skeleton["nodes"], bare["nodes"]):
            self.assertLess(math.dist(node["position"], other["position"]), 1e-4)

    def test_a_node_of_one_view_waits(self):
        made = project()
        del made["nodes"][14]["clicks"]["right"], made["nodes"][14]["clicks"]["top"]
        skeleton, _ = self.skeleton(made)
        self.assertEqual(skeleton["incomplete"], [{"id": 14, "views": ["front"]}])

    def test_whatever_is_clicked_no_number_is_none(self):
        print("seeds 1 to 24")
        answered = 0
        for seed in range(1, 25):
            rng = random.Random(seed)
            made = project(seed, noise=rng.choice([0, 0.5, 3, 3, 20]), names=rng.choice([("front", "right", "top"), ("front", "right"), ("front", "top")]))
            for node in made["nodes"]:
                for view in list(node["clicks"]):
                    if rng.random() < 0.01 * (seed % 10):
                        node["clicks"][view] = [rng.uniform(0, SIZE[0]), rng.uniform(0, SIZE[1])]
                    elif rng.random() < 0.1:
                        del node["clicks"][view]
            for view in made["views"]:
                if rng.random() < 0.1:
                    view["scale"]["from_px"] = [rng.uniform(0, SIZE[0]), rng.uniform(0, SIZE[1])]
                if rng.random() < 0.1:
                    view["origin_px"] = [rng.uniform(0, SIZE[0]), rng.uniform(0, SIZE[1])]
                if rng.random() < 0.1:
                    view["camera"]["focal_px"] = [rng.choice([1, 50, 2000, 1e7])] * 2
            with self.subTest(seed=seed):
                drawn = ["--report", self.folder / "report"] if seed % 4 == 0 else []
                status, out, err = self.measure(made, *drawn)
                self.assertIn(status, (0, 1), err)
                self.assertNotRegex(out + err, r"(?i)\bnan\b|\binf\b|e\+\d\d\d")
                self.assertEqual(status == 0, out != "")
                if status == 0:
                    answered += 1
                    self.assertTrue(all(math.isfinite(n) for n in numbers(json.loads(out))))
                if status == 0 and drawn:
                    self.assertNotRegex((self.folder / "report/report.txt").read_text(), r"(?i)\bnan\b|\binf\b")
        print(f"{answered} of 24 answered")
        self.assertGreater(answered, 5)


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def across(vector, along):
    """What of `vector` is perpendicular to `along`."""
    share = sum(x * y for x, y in zip(vector, along)) / sum(y * y for y in along)
    return [x - share * y for x, y in zip(vector, along)]


def turn_about(along, a, b):
    """The angle in degrees from `a` to `b` about `along`."""
    a, b, length = across(a, along), across(b, along), math.hypot(*along)
    cross = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return math.degrees(math.atan2(sum(x * y for x, y in zip(cross, along)) / length, sum(x * y for x, y in zip(a, b))))


class Arabidopsis(Case):
    """26 siliques clicked in two photographs of a real plant: node 2 i is where silique i + 5 leaves its stem, node 2 i + 1 its tip."""

    def test_two_photographs_without_calibration_agree_with_the_hand(self):
        if not HAND.exists():
            self.skipTest("the hand's measures are not here")
        status, out, err = axil("skeleton", SOURCE / "tests/golden/arabidopsis/arabidopsis.axil")
        self.assertEqual(status, 0, err)
        at = {node["id"]: node["position"] for node in json.loads(out)["nodes"]}
        placed = [i for i in range(26) if 2 * i in at and 2 * i + 1 in at]
        self.assertGreaterEqual(len(placed), 20)
        hand = json.loads(HAND.read_text())
        turns, ours, theirs = [], [], []
        for before, here in zip(placed, placed[1:]):
            if here != before + 1:
                continue
            low, high = max(j for j in placed if j <= max(here - 2, placed[0])), min(j for j in placed if j >= min(here + 2, placed[-1]))
            turn = turn_about(minus(at[2 * high], at[2 * low]), minus(at[2 * before + 1], at[2 * before]), minus(at[2 * here + 1], at[2 * here]))
            turns.append((here, turn, math.degrees(hand["angles"][here + 3 + 0])))
            ours.append(math.dist(at[2 * here], at[2 * before]))
            theirs.append(hand["internodes"][here + 3])
        apart = min((sorted(abs(math.remainder(sense * turn - want, 360)) for _, turn, want in turns) for sense in (1, -1)), key=lambda d: d[len(d) // 2])
        scale = sum(a * b for a, b in zip(ours, theirs)) / sum(a * a for a in ours)
        mean = [sum(values) / len(values) for values in (ours, theirs)]
        sxy, sxx, syy = (sum((a[i] - x) * (b[i] - y) for i in range(len(ours))) for a, x, b, y in ((ours, mean[0], theirs, mean[1]), (ours, mean[0], ours, mean[0]), (theirs, mean[1], theirs, mean[1])))
        off = sum(abs(scale * a - b) for a, b in zip(ours, theirs)) / len(ours)
        correlation = sxy / math.sqrt(sxx * syy)
        print(f"{len(placed)} siliques: divergence differs by {apart[len(apart) // 2]:.1f} degrees (median); internodes: correlation {correlation:.3f}, mean difference {off:.2f} mm; scale {scale:.1f}")
        self.assertLessEqual(apart[len(apart) // 2], 10)
        self.assertGreaterEqual(correlation, 0.95)
        self.assertLessEqual(off, 2)


class Calibrate(Case):
    def test_says_what_is_wrong_with_its_photos(self):
        plain = self.folder / "plain.bmp"
        plain.write_bytes(bitmap(320, 240))
        for arguments, words in (([], "PHOTO"), ([self.folder / "none.jpg"], "none.jpg"), ([plain, plain, plain], "board"), (["--corners", "9y6", plain], "9x6"), (["--corners", "2x2", plain], "3 x 3"),
                                 ([self.folder], str(self.folder.name))):
            with self.subTest(arguments=arguments):
                status, out, err = axil("calibrate", *arguments)
                self.assertNotEqual(status, 0)
                self.assertEqual(out, "")
                self.assertIn(words, err)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
