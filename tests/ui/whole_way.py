#!/usr/bin/python3
"""From an empty window to an exported grammar, by hand: the real window under a virtual display, driven by mouse and keys alone.

whole_way.py AXIL_STUDIO SAMPLE_FOLDER [PICTURES]

Chooses three photos that no camera is known of, shows where the plant meets the ground and one length, clicks three stems of the sample in all three,
exports, and looks at what was written. Exits with 77 (skipped) without Xvfb or xdotool. With PICTURES a screenshot of every step is left there. A hand that
is too quick for a busy machine tries once more, slower."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import time

WIDTH, HEIGHT = 1440, 900
LEFT, RIGHT, TOP, STATUS, BELOW, BETWEEN = 296, 268, 46, 30, 72, 5  # the window's parts, as ui/shell.cpp lays them out at scale 1


class Hand:
    def __init__(self, studio, work, pictures, pause):
        self.pictures, self.pause = pictures, pause
        self.display = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", f"{WIDTH}x{HEIGHT}x24"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        number = self.display.stdout.readline().decode().strip()
        self.env = dict(os.environ, DISPLAY=f":{number}", XDG_STATE_HOME=os.path.join(work, "state"))
        self.window = subprocess.Popen([studio], env=self.env, cwd=work)
        self.id = self.run("xdotool", "search", "--sync", "--onlyvisible", "--name", "Axil Studio").split()[0]
        time.sleep(2)
        self.run("xdotool", "windowmove", self.id, "0", "0")
        self.run("xdotool", "windowfocus", self.id)
        self.step = 0

    def run(self, *words):
        return subprocess.run(words, env=self.env, check=True, capture_output=True, timeout=60).stdout.decode()

    def click(self, x, y, button="1"):
        self.run("xdotool", "mousemove", "--window", self.id, str(round(x)), str(round(y)))
        time.sleep(self.pause)
        self.run("xdotool", "mousedown", button)
        time.sleep(self.pause)
        self.run("xdotool", "mouseup", button)
        time.sleep(self.pause)

    def key(self, *keys):
        for key in keys:
            self.run("xdotool", "keydown", key)
        time.sleep(2 * self.pause)
        for key in reversed(keys):
            self.run("xdotool", "keyup", key)
        time.sleep(2 * self.pause)

    def type(self, text):
        self.run("xdotool", "type", "--delay", "30", text)
        time.sleep(0.3)

    def palette(self, words):
        self.key("ctrl", "k")
        self.type(words)
        self.key("Return")
        time.sleep(0.3)

    def look(self, name):
        self.step += 1
        if self.pictures:
            self.run("import", "-window", "root", os.path.join(self.pictures, f"{self.step:02d}_{name}.png"))

    def end(self):
        self.window.kill()
        self.display.kill()


def on_screen(point, size):
    """Where a photo's px is while its pane is alone: the photo fills 96 % of the pane, in its middle."""
    x, y = LEFT + BETWEEN, TOP
    width, height = WIDTH - LEFT - RIGHT - 2 * BETWEEN, HEIGHT - TOP - STATUS - BELOW - BETWEEN
    zoom = 0.96 * min(width / size[0], height / size[1])
    return x + width / 2 + (point[0] - size[0] / 2) * zoom, y + height / 2 + (point[1] - size[1] / 2) * zoom


def choose_photo(hand, row, path):
    hand.click(190, 372 + 40 * row)  # the row's button under Photos
    time.sleep(0.6)
    middle, top = WIDTH / 2, (HEIGHT - 520) / 2
    hand.click(middle + 60, top + 66)  # the folder's field
    hand.key("ctrl", "a")
    hand.type(os.path.dirname(path))
    hand.key("Return")
    hand.click(middle - 150, top + 520 - 34)  # the name's field
    hand.key("ctrl", "a")
    hand.type(os.path.basename(path))
    hand.key("Return")
    time.sleep(1.0)


def click_stems(hand, project, size):
    """Every stem in the front photo first, then its nodes in the other two."""
    hand.key("w")  # node by node: stems are not followed to the mouse
    clicks = {node["id"]: node["clicks"] for node in project["nodes"]}
    at = lambda node, view: on_screen(clicks[node][view], size)
    for index, stem in enumerate(project["stems"]):
        nodes = stem["nodes"]
        hand.key("1")
        hand.key("Escape")
        hand.click(*at(nodes[0], "front"))  # the base, or the node where the branch leaves
        for node in nodes[1:]:
            hand.click(*at(node, "front"))
        hand.key("1")
        new = nodes if index == 0 else nodes[1:]
        for number, view in (("2", "right"), ("3", "top")):
            hand.key("1")
            hand.key("Escape")
            hand.click(*at(new[0], "front"))
            hand.key(number)
            for node in new:
                hand.run("xdotool", "keydown", "shift")
                hand.click(*at(node, view))
                hand.run("xdotool", "keyup", "shift")
            hand.key(number)


def whole_way(studio, sample, pictures, pause):
    with open(os.path.join(sample, "lantana.axil"), encoding="utf-8") as file:
        project = json.load(file)
    project["stems"] = project["stems"][:3]
    size = project["views"][0]["size_px"]
    clicks = {node["id"]: node["clicks"] for node in project["nodes"]}
    base, above = clicks[project["stems"][0]["nodes"][0]], clicks[project["stems"][0]["nodes"][2]]
    work = tempfile.mkdtemp()
    for view in ("front", "right", "top"):
        shutil.copy(os.path.join(sample, f"{view}.jpg"), work)
    begun = time.time()
    hand = Hand(studio, work, pictures, pause)
    try:
        hand.look("empty")
        hand.palette("Photos")
        for row, view in enumerate(("front", "right", "top")):
            choose_photo(hand, row, os.path.join(work, f"{view}.jpg"))
        hand.look("photos")
        hand.click(80, 622)  # Set the base
        for number, view in (("1", "front"), ("2", "right"), ("3", "top")):
            hand.key(number)
            hand.click(*on_screen(base[view], size))
            hand.key(number)
        hand.click(220, 622)  # Known length: a tenth of the unit, from the base upwards
        hand.key("1")
        hand.click(*on_screen(base["front"], size))
        hand.click(*on_screen(above["front"], size))
        hand.key("1")
        hand.look("calibrated")
        hand.key("alt", "3")
        click_stems(hand, project, size)
        time.sleep(2)
        hand.look("stems")
        hand.key("alt", "5")
        time.sleep(1)
        hand.look("grammar")
        hand.key("ctrl", "e")
        out = os.path.join(work, "plant-out")
        for _ in range(240):
            if os.path.exists(os.path.join(out, "report.json")):
                break
            time.sleep(0.5)
        hand.look("exported")
        look_at(out, project, time.time() - begun)
    finally:
        hand.end()
        shutil.rmtree(work, ignore_errors=True)


def look_at(out, project, seconds):
    """What was exported is the plant that was clicked."""
    with open(os.path.join(out, "initial.simeco"), encoding="utf-8") as file:
        grammar = file.read()
    with open(os.path.join(out, "report.json"), encoding="utf-8") as file:
        report = json.load(file)
    wanted = sum(len(stem["nodes"]) - 1 for stem in project["stems"])
    print(f"{report['segments']} segments from {report['stems']} stems in {seconds:.0f} s; worst reprojection {report['worst_reprojection_px']:.2f} px")
    assert report["stems"] == len(project["stems"]), report
    assert report["segments"] == wanted, report
    assert report["worst_reprojection_px"] < 5, report
    assert grammar.count("Stage") >= wanted


def main():
    if not shutil.which("Xvfb") or not shutil.which("xdotool"):
        return 77
    studio, sample = os.path.realpath(sys.argv[1]), os.path.realpath(sys.argv[2])
    pictures = sys.argv[3] if len(sys.argv) > 3 else None
    try:
        whole_way(studio, sample, pictures, 0.08)
    except (AssertionError, OSError, subprocess.SubprocessError) as error:
        print(f"once more, slower: {error!r}")
        whole_way(studio, sample, pictures, 0.3)
    return 0


if __name__ == "__main__":
    sys.exit(main())
