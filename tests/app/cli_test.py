#!/usr/bin/env python3
"""Runs `axil` as a user would, on the samples and on everything a file can get wrong.

  cli_test.py AXIL SOURCE_FOLDER [TEST ...]
"""
import copy
import filecmp
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

AXIL = str(pathlib.Path(sys.argv[1]).resolve())
SOURCE = pathlib.Path(sys.argv[2]).resolve()
SAMPLES = sorted(SOURCE.glob("samples/*/*.axil"))
ASPEN = SOURCE / "samples/aspen/aspen.axil"
SHARED = SOURCE.parent / "shared"

GRAMMAR = """EcoSystem 1.0 "g" {
    Plant "p" {
        Direction = vector(0.000000, 1.000000, 0.000000);
        DeriveTime = 2.000000;
        Apex {}
        Stem {
            Stage 1 { GrowRate = 0.100000; GrowTime = 1.000000; BroadenRate = 0.500000; }
            Stage 2 { GrowRate = 0.200000; GrowTime = 1.000000; BroadenRate = 0.500000; }
        }
        Leaf { Stage 1 { Model = "ovate.i"; GrowRate = 0.100000; GrowTime = 1.000000; } }
        Root {}
        Fruit {}
        Flower {}
        Grow {
            w = A(0);
            A(0) -> S(1) A(1);
            A(1) -> [rotr(0.700000)rotu(0.000000)L(1)] rotr(0.100000)rotu(1.000000)S(2);
        }
    }
}
"""


def axil(*arguments, text=None, cwd=None):
    """-> (exit status, stdout, stderr)"""
    done = subprocess.run([AXIL, *map(str, arguments)], input=text, capture_output=True, cwd=cwd, timeout=300)
    return done.returncode, done.stdout.decode("utf-8"), done.stderr.decode("utf-8")


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="axil_cli_"))

    def tearDown(self):
        os.chmod(self.folder, 0o755)
        shutil.rmtree(self.folder)

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8"))
        return path

    def refused(self, *arguments, says, text=None):
        """One clear message, exit 1, nothing on stdout, nothing written."""
        before = sorted(p.name for p in self.folder.rglob("*"))
        status, out, err = axil(*arguments, text=text)
        self.assertEqual(status, 1, f"{arguments}: {out}{err}")
        self.assertEqual(out, "")
        for word in [says] if isinstance(says, str) else says:
            self.assertIn(word, err)
        self.assertNotIn("bug", err)
        self.assertEqual(before, sorted(p.name for p in self.folder.rglob("*")), "something was written")
        return err


class Usage(Case):
    def test_help_of_every_command_has_an_example(self):
        for command in ("keywords", "skeleton", "quantify", "emit", "check", "derive", "grow", "build"):
            status, out, _ = axil(command, "--help")
            self.assertEqual(status, 0)
            self.assertIn(f"axil {command}", out)

    def test_bad_usage_is_2(self):
        for arguments in ([], ["nosuch"], ["derive"], ["emit", ASPEN, "--kind", "nosuch"], ["derive", "x", "--steps", "-1"], ["grow", "x"]):
            self.assertEqual(axil(*arguments)[0], 2, arguments)

    def test_completion_knows_every_command(self):
        for shell in ("bash", "zsh", "fish"):
            status, out, _ = axil("completion", shell)
            self.assertEqual(status, 0)
            self.assertIn("quantify", out)
            self.assertIn("decimals", out)

    def test_bash_completion_completes(self):
        script = self.write("axil.bash", axil("completion", "bash")[1])
        probe = f"source {script}; COMP_WORDS=(axil der); COMP_CWORD=1; _axil; echo ${{COMPREPLY[@]}}; COMP_WORDS=(axil emit --k); COMP_CWORD=2; _axil; echo ${{COMPREPLY[@]}}"
        out = subprocess.run(["bash", "-c", probe], capture_output=True, text=True).stdout.split()
        self.assertEqual(out, ["derive", "--kind"])


class Keywords(Case):
    def test_traits_quote_their_words(self):
        text = "Shrub. Leaves opposite, ovate, 3-8 cm long."
        status, out, _ = axil("keywords", "-", "--json", text=text.encode())
        self.assertEqual(status, 0)
        traits = json.loads(out)["traits"]
        self.assertTrue(any(t["value"] == "ovate" for t in traits if "value" in t), out)
        for trait in traits:
            self.assertEqual(text[trait["start"]:trait["end"]], trait["text"])

    def test_chinese_places_count_characters(self):
        text = "灌木。葉對生，卵形。"
        status, out, _ = axil("keywords", "-", "--json", text=text.encode())
        self.assertEqual(status, 0)
        values = {t["property"]: t["value"] for t in json.loads(out)["traits"] if "value" in t}
        self.assertEqual(values.get("arrangement"), "opposite")
        for trait in json.loads(out)["traits"]:
            self.assertEqual(text[trait["start"]:trait["end"]], trait["text"])

    def test_missing_and_binary_files(self):
        self.refused("keywords", self.folder / "none.txt", says="none.txt")
        self.refused("keywords", self.write("b.txt", b"\x00\x01\x02\xff"), says="text")


class Projects(Case):
    """What a project file can get wrong."""

    def setUp(self):
        super().setUp()
        for photo in ("front", "right", "top"):
            shutil.copy(ASPEN.parent / f"{photo}.jpg", self.folder)
        self.project = json.loads(ASPEN.read_text(encoding="utf-8"))

    def changed(self, change):
        project = copy.deepcopy(self.project)
        change(project)
        return self.write("p.axil", json.dumps(project))

    def refuse(self, change, *says):
        path = self.changed(change)
        self.refused("skeleton", path, says=list(says))
        self.refused("build", path, "-o", self.folder / "out", says=list(says))

    def test_the_sample_itself_is_well(self):
        self.assertEqual(axil("skeleton", self.changed(lambda p: None))[0], 0)

    def test_missing_photo(self):
        self.refuse(lambda p: p["views"][0].update(photo="gone.jpg"), "gone.jpg")

    def test_photo_that_is_no_photo(self):
        self.write("text.jpg", "not a photo")
        self.refuse(lambda p: p["views"][0].update(photo="text.jpg"), "text.jpg")

    def test_truncated_photo(self):
        self.write("cut.jpg", (ASPEN.parent / "front.jpg").read_bytes()[:9000])
        self.refuse(lambda p: p["views"][0].update(photo="cut.jpg"), "cut.jpg")

    def test_photo_of_another_size(self):
        self.refuse(lambda p: p["views"][0].update(size_px=[1600, 1200]), "1600", "front")

    def test_wrong_types_and_versions(self):
        self.refuse(lambda p: p.update(axil=2), "newer")
        self.refuse(lambda p: p["nodes"][0].update(id="x"), "nodes[0].id")
        self.refuse(lambda p: p.update(nodes={}), "nodes")

    def test_nan(self):
        path = self.write("p.axil", ASPEN.read_text(encoding="utf-8").replace('"seed": 1', '"seed": NaN'))
        self.refused("skeleton", path, says="JSON")

    def test_node_clicked_once(self):
        def change(p): p["nodes"][4]["clicks"] = {"front": p["nodes"][4]["clicks"]["front"]}
        node = self.project["nodes"][4]["id"]
        status, out, err = axil("skeleton", self.changed(change))
        self.assertEqual(status, 0, err)
        self.assertIn(f"node {node} waits", err)
        self.assertEqual([waiting["id"] for waiting in json.loads(out)["incomplete"]], [node])

    def test_click_outside_the_photo(self):
        self.refuse(lambda p: p["nodes"][4]["clicks"].update(front=[5000, 10]), f"node {self.project['nodes'][4]['id']}", "front")

    def test_rays_that_do_not_meet(self):
        def change(p): p["nodes"][4]["clicks"]["front"][1] += 400
        status, _, err = axil("skeleton", self.changed(change))
        self.assertEqual(status, 0, err)
        self.assertIn(f"suspect click: node {self.project['nodes'][4]['id']} in view front", err)
        self.assertEqual(err.count("suspect click"), 1, err)  # the two others agree and stay

    def test_unknown_node(self):
        self.refuse(lambda p: p["stems"][1]["nodes"].append(9999), "9999")

    def test_unknown_view(self):
        self.refuse(lambda p: p["nodes"][4]["clicks"].update(back=[5, 5]), "back")

    def test_stem_of_one_node(self):
        self.refuse(lambda p: p["stems"].append({"id": 99, "nodes": [1]}), "stem 99")

    def test_zero_length_segment(self):
        def change(p):
            p["nodes"].append({"id": 900, "clicks": p["nodes"][-1]["clicks"]})
            p["stems"].append({"id": 99, "nodes": [p["nodes"][-2]["id"], 900]})
        self.refuse(change, "900")

    def test_cycle(self):
        self.refuse(lambda p: p["stems"][1]["nodes"].append(p["stems"][0]["nodes"][0]), "stem")

    def test_two_roots(self):
        def change(p):
            ids = [n["id"] for n in p["nodes"]][:2]
            p["nodes"] += [{"id": 901, "clicks": {v: [c[0] + 30, c[1]] for v, c in p["nodes"][0]["clicks"].items()}},
                           {"id": 902, "clicks": {v: [c[0] + 30, c[1]] for v, c in p["nodes"][5]["clicks"].items()}}]
            for n in p["nodes"][-2:]: n["clicks"] = {v: c for v, c in n["clicks"].items() if v != "right"}
            p["stems"].append({"id": 99, "nodes": [901, 902]})
        self.refuse(change, "stem")

    def test_leaves_on_an_unknown_stem(self):
        self.refuse(lambda p: p["leaves"].append({"stem": 77, "nodes": 2}), "77")

    def test_unknown_arrangement(self):
        self.refuse(lambda p: p["leaves"][0].update(arrangement="upside-down"), "upside-down")

    def test_truncations_never_crash(self):
        text = ASPEN.read_bytes()
        for k in range(1, 12):
            self.refused("skeleton", self.write("p.axil", text[: len(text) * k // 12]), says="axil")

    def test_unwritable_output(self):
        self.write("file", "x")
        self.refused("build", self.changed(lambda p: None), "-o", self.folder / "file", says="file")
        if os.geteuid() != 0:
            locked = self.folder / "locked"
            locked.mkdir()
            os.chmod(locked, 0o555)
            self.refused("build", self.changed(lambda p: None), "-o", locked, says="locked")

    def test_a_project_without_anything(self):
        self.refused("skeleton", self.write("p.axil", '{"axil": 1}'), says="stem")


    def test_broken_json_says_what_and_where(self):
        err = self.refused("skeleton", self.write("p.axil", '{\n"axil": 1, "name": NaN}'), says=["line 2", "invalid literal"])
        self.assertNotIn("json.exception", err)


def small_project(**more):
    """A stem of one segment, 0.3 high, seen by two orthographic cameras."""
    turned = {"front": [[1, 0, 0], [0, -1, 0], [0, 0, -1]], "right": [[0, 0, -1], [0, -1, 0], [-1, 0, 0]]}
    views = [{"name": name, "camera": {"model": "orthographic", "scale_px_per_unit": 1000, "centre_px": [300, 400], "rotation": rotation, "translation": [0, 0, 2]}}
             for name, rotation in turned.items()]
    nodes = [{"id": n, "clicks": {name: [300, 400 - height] for name in turned}} for n, height in ((1, 0), (2, 300))]
    return json.dumps({"axil": 1, "name": "small", "views": views, "nodes": nodes, "stems": [{"id": 1, "nodes": [1, 2]}], **more})


class Building(Case):
    def built(self, **more):
        """-> the report of the small project's build"""
        status, _, err = axil("build", self.write("p.axil", small_project(**more)), "-o", self.folder / "out", "--frames", 2)
        self.assertEqual(status, 0, err)
        report = json.loads((self.folder / "out/report.json").read_text())
        for note in report["notes"]:
            self.assertIn(note, err)
        return report

    def test_the_grammar_of_a_single_segment_is_silent(self):
        self.built()
        self.assertEqual(axil("check", self.folder / "out/initial.simeco"), (0, "", ""))

    def test_what_is_not_known_is_noted(self):
        notes = "\n".join(self.built(unit="inch", leaves=[{"stem": 1, "nodes": 2, "arrangement": "opposite", "shape": "squarish"}])["notes"])
        self.assertIn("'inch'", notes)
        self.assertIn('"squarish"', notes)
        self.assertNotIn("unit", "\n".join(self.built(unit="cm")["notes"]))

    def test_a_build_that_is_stopped_leaves_nothing(self):
        for stop in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(stop=stop.name):
                out = self.folder / stop.name
                out.mkdir()
                running = subprocess.Popen([AXIL, "build", ASPEN, "-o", out / "plant", "--frames", "1000"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                while running.poll() is None and not list(out.iterdir()):
                    time.sleep(0.01)
                running.send_signal(stop)
                running.communicate(timeout=120)
                self.assertEqual(running.returncode, 1)
                self.assertEqual(list(out.iterdir()), [])


class Grammars(Case):
    def test_a_good_grammar_is_silent(self):
        self.assertEqual(axil("check", self.write("g.simeco", GRAMMAR)), (0, "", ""))

    def test_all_errors_come_at_once_with_their_places(self):
        text = GRAMMAR.replace("A(0) -> S(1) A(1);", "A(0) -> S(1) Q(1)").replace("[rotr", "rotr")
        path = self.write("g.simeco", text)
        status, out, _ = axil("check", path)
        self.assertEqual(status, 1)
        lines = out.splitlines()
        self.assertGreaterEqual(len(lines), 2, out)
        for line in lines:
            self.assertRegex(line, rf"^{path}:\d+:\d+: (error|warning): ")

    def test_a_broken_grammar_cannot_be_derived_or_grown(self):
        path = self.write("g.simeco", GRAMMAR[:-20])
        self.refused("derive", path, says="error")
        self.refused("grow", path, "-o", self.folder / "x.png", says="error")

    def test_unknown_stage(self):
        path = self.write("g.simeco", GRAMMAR.replace("[rotr(0.700000)rotu(0.000000)L(1)]", "[rotr(0.700000)L(9)]"))
        status, out, _ = axil("check", path)
        self.assertEqual(status, 1)
        self.assertIn("L(9)", out)

    def test_division_by_zero(self):
        text = GRAMMAR.replace("1.0 \"g\"", "1.1 \"g\"").replace("A(0) -> S(1) A(1);", "A(i) -> S(1) B(1/i);")
        self.refused("derive", self.write("g.simeco", text), says="error")

    def test_constants_that_are_no_number(self):
        for argument in ("log(0)", "1e200*1e200"):
            text = GRAMMAR.replace("1.0 \"g\"", "1.1 \"g\"").replace("A(0) -> S(1) A(1);", f"A(0) -> S({argument});")
            self.refused("derive", self.write("g.simeco", text), says=["not a finite number", "A(0)"])

    def test_one_plant_of_several(self):
        body = GRAMMAR[GRAMMAR.index("    Plant"):GRAMMAR.rindex("}")]
        second = body.replace('"p"', '"榕"').replace("A(0) -> S(1) A(1);", "A(0) -> S(2);").replace("vector(0.000000, 1.000000", "vector(1.000000, 1.000000")
        path = self.write("g.simeco", GRAMMAR[:GRAMMAR.rindex("}")] + second + "}\n")
        status, out, err = axil("derive", path)
        self.assertEqual((status, out.count("S(1)")), (0, 1))
        self.assertIn("--plant", err)
        self.assertEqual(axil("derive", path, "--plant", "榕")[:2], (0, "S(2)\n"))
        self.refused("derive", path, "--plant", "oak", says=["oak", "榕"])
        self.refused("grow", path, "--plant", "oak", "-o", self.folder / "x.json", says=["oak", "榕"])
        self.assertEqual(axil("grow", path, "--plant", "榕", "-o", self.folder / "x.json")[0], 0)
        self.assertEqual(len(json.loads((self.folder / "x.json").read_text())["nodes"]), 2)

    def test_growth_without_end_names_its_rule(self):
        text = GRAMMAR.replace("A(0) -> S(1) A(1);", "A(0) -> A(0) [A(0)] A(0);")
        err = self.refused("derive", self.write("g.simeco", text), says=["A(0)", "limit"])
        self.assertIn("A(0) -> A(0)", err)

    def test_big5_is_understood_and_binary_refused(self):
        big5 = GRAMMAR.replace('"p"', '"馬櫻丹"').encode("big5")
        self.assertEqual(axil("check", self.write("g.simeco", big5))[0], 0)
        self.refused("derive", self.write("b.simeco", bytes(range(256))), says="text")

    def test_counts(self):
        status, out, _ = axil("derive", self.write("g.simeco", GRAMMAR), "--counts")
        self.assertEqual(status, 0)
        self.assertEqual(json.loads(out), {"steps": [2, 9], "letters": {"[": 1, "]": 1, "rotr": 2, "rotu": 2, "S": 2, "L": 1}})

    def test_stats(self):
        stats = json.loads(axil("derive", self.write("g.simeco", GRAMMAR), "--stats")[1])
        self.assertEqual(stats["modules"], 9)
        self.assertLessEqual({"modules", "derive_seconds", "peak_bytes", "threads"}, stats.keys())

    def test_grow_writes_every_kind_and_the_same_bytes_twice(self):
        path = self.write("g.simeco", GRAMMAR)
        for ending in ("json", "glb", "obj", "ply", "png"):
            for name in ("a", "b"):
                status, _, err = axil("grow", path, "-o", self.folder / name / f"plant.{ending}")
                self.assertEqual(status, 0, err)
            self.assertTrue(filecmp.cmp(self.folder / "a" / f"plant.{ending}", self.folder / "b" / f"plant.{ending}", shallow=False), ending)

    def test_grow_frames(self):
        path = self.write("g.simeco", GRAMMAR)
        self.assertEqual(axil("grow", path, "--frames", 3, "--width", 64, "--height", 64, "-o", self.folder / "pictures")[0], 0)
        self.assertEqual(len(list((self.folder / "pictures").glob("*.png"))), 3)
        for ending in ("mp4", "webm"):
            status, _, err = axil("grow", path, "--frames", 3, "--width", 64, "--height", 64, "-o", self.folder / f"growth.{ending}")
            self.assertEqual(status, 0, err)
            self.assertGreater((self.folder / f"growth.{ending}").stat().st_size, 500)

    def test_grow_refuses_an_ending_it_does_not_know(self):
        self.refused("grow", self.write("g.simeco", GRAMMAR), "-o", self.folder / "plant.stl", says=".stl")

    def test_limits_are_options(self):
        err = self.refused("derive", self.write("g.simeco", GRAMMAR), "--max-modules", 5, says="more than 5 modules")
        self.assertIn("A(1)", err)

    def test_the_unit_reaches_the_mesh(self):
        path = self.write("g.simeco", GRAMMAR)
        for unit in ("m", "cm"):
            self.assertEqual(axil("grow", path, "--unit", unit, "-o", self.folder / f"{unit}.glb")[0], 0)
        self.assertFalse(filecmp.cmp(self.folder / "m.glb", self.folder / "cm.glb", shallow=False))

    def test_lengths_at_a_moment(self):
        path = self.write("g.simeco", GRAMMAR)
        self.assertEqual(axil("grow", path, "--time", 2.5, "-o", self.folder / "young.json")[0], 0)
        heights = [n["position"][1] for n in json.loads((self.folder / "young.json").read_text())["nodes"]]
        self.assertAlmostEqual(max(heights), 0.05, places=9)


class Samples(Case):
    def test_every_sample_builds_the_same_bytes_twice_and_regrows_its_skeleton(self):
        self.assertGreaterEqual(len(SAMPLES), 2)
        for sample in SAMPLES:
            with self.subTest(sample=sample.name):
                for name in ("a", "b"):
                    status, _, err = axil("build", sample, "-o", self.folder / sample.stem / name)
                    self.assertEqual(status, 0, err)
                first, second = (self.folder / sample.stem / name for name in ("a", "b"))
                files = sorted(str(p.relative_to(first)) for p in first.rglob("*") if p.is_file())
                for needed in ("skeleton.json", "stems.csv", "initial.simeco", "predictive.simeco", "structured.simeco", "plant.glb", "report.json"):
                    self.assertIn(needed, files)
                for file in files:
                    self.assertTrue(filecmp.cmp(first / file, second / file, shallow=False), file)
                report = json.loads((first / "report.json").read_text())
                self.assertLess(report["worst_regrown"], 2e-5 * report["height"])
                for grammar in ("initial", "predictive", "structured"):
                    self.assertEqual(axil("check", first / f"{grammar}.simeco"), (0, "", ""), grammar)

    def test_data_goes_to_stdout(self):
        self.assertEqual(json.loads(axil("skeleton", ASPEN)[1])["axil_skeleton"], 1)
        self.assertTrue(axil("quantify", ASPEN)[1].startswith("segment,stem,parent,level,kind,length,radius,rotr,rotu,rx,ry,rz,dx,dy,dz,leaves\n"))
        for kind in ("initial", "predictive", "structured"):
            self.assertTrue(axil("emit", ASPEN, "--kind", kind)[1].startswith(("EcoSystem", "//", "/*")), kind)

    def test_every_dialect_prints(self):
        for dialect in ("simeco", "cpfg", "lpy", "mtg"):
            status, out, err = axil("emit", ASPEN, "--kind", "initial", "--dialect", dialect)
            self.assertEqual(status, 0, err)
            self.assertGreater(len(out), 1000)


class Lantana(Case):
    """The thesis' own grammar; it stays outside the project."""

    def setUp(self):
        super().setUp()
        self.grammar = SHARED / "data/lantana.simeco"
        if not self.grammar.exists():
            self.skipTest(f"needs {self.grammar}, which is not here")

    def test_counts_are_the_thesis_own(self):
        self.assertEqual(axil("check", self.grammar), (0, "", ""))
        counts = json.loads(axil("derive", self.grammar, "--counts")[1])
        self.assertEqual(counts["steps"], [1, 2, 4, 5, 7, 20, 63, 133, 178, 188])
        self.assertEqual(counts["letters"]["S"], 40)
        self.assertEqual(counts["letters"]["L"], 24)

    def test_it_grows_24_leaves(self):
        self.assertEqual(axil("grow", self.grammar, "-o", self.folder / "plant.json")[0], 0)
        self.assertEqual(len(json.loads((self.folder / "plant.json").read_text())["leaves"]), 24)


class RealMaize(Case):
    """A real plant with calibrated cameras, clicked by hand; its photos stay outside the project."""

    def test_the_whole_chain(self):
        project = SOURCE / "tests/golden/maize_plant_1/maize_plant_1.axil"
        if not (SHARED / "data/plants/real/maize_plant_1").exists():
            self.skipTest("needs ../shared/data/plants/real/maize_plant_1, which is not here")
        status, _, err = axil("build", project, "-o", self.folder / "out")
        self.assertEqual(status, 0, err)
        report = json.loads((self.folder / "out/report.json").read_text())
        self.assertGreaterEqual(report["stems"], 8)
        self.assertLess(report["worst_reprojection_px"], 15)
        self.assertLess(report["worst_regrown"], 2e-5 * report["height"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=1)
