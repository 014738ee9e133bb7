#!/usr/bin/python3
"""A plant of many stems in three clicks a stem: where it leaves its parent, its tip, and its tip in a second photo.

three_clicks.py AXIL_STUDIO SAMPLE_FOLDER

Takes a sample with known cameras, forgets its clicks, and lets the studio be driven without a window: base or fork and tip in the front photo, tip in the
right one, zoomed in where the click is. Prints how far the tips lie from those of the sample's own clicks."""

import json
import math
import os
import subprocess
import sys
import tempfile

NEAR_PX = 12  # a leafless tip can be clicked about so well; the photos are 1600 px high
NOTCHES = 9   # of the wheel, before a click and back after it


def click(view, at):
    x, y = at
    return [f"ui wheel {view} {x:.1f} {y:.1f} {NOTCHES}", f"ui click {view} {x:.1f} {y:.1f}", "ui wait", f"ui wheel {view} {x:.1f} {y:.1f} -{NOTCHES}"]


def lines_for(stems, clicks):
    lines = ["ui way stems", "ui wait"]
    for stem in stems:
        base, tip = stem["nodes"][0], stem["nodes"][-1]
        lines += click("front", clicks[base]["front"]) + click("front", clicks[tip]["front"]) + click("right", clicks[tip]["right"])
    return lines + ["ui key ctrl+s", "ui wait"]


def off(stem, clicks, truth):
    tip = clicks[stem["nodes"][-1]]
    return max(math.dist(tip[view], truth[view]) if view in tip else math.inf for view in ("front", "right"))


def main():
    studio, sample = sys.argv[1], sys.argv[2]
    name = os.path.basename(sample)
    with open(os.path.join(sample, name + ".axil"), encoding="utf-8") as file:
        known = json.load(file)
    clicks = {node["id"]: node["clicks"] for node in known["nodes"]}
    bare = dict(known, nodes=[], stems=[], leaves=[], views=[dict(view, photo=os.path.join(sample, view["photo"])) for view in known["views"]])
    with tempfile.TemporaryDirectory() as work:
        project, session = os.path.join(work, "plant.axil"), os.path.join(work, "session.txt")
        with open(project, "w", encoding="utf-8") as file:
            json.dump(bare, file)
        lines = lines_for(known["stems"], clicks)
        with open(session, "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")
        subprocess.run([studio, "--replay", session, "--screenshot", os.path.join(work, "end.png"), project], check=True, timeout=300)
        with open(project, encoding="utf-8") as file:
            made = json.load(file)
    mine = {node["id"]: node["clicks"] for node in made["nodes"]}
    worst = [min(off(stem, mine, clicks[true["nodes"][-1]]) for stem in made["stems"]) for true in known["stems"]]
    used = sum(line.startswith("ui click") for line in lines)
    near = sum(distance <= NEAR_PX for distance in worst)
    print(f"{used} clicks for {len(known['stems'])} stems; {near} tips within {NEAR_PX} px in both photos: " + " ".join(f"{distance:.0f}" for distance in worst))
    assert used <= 3 * len(known["stems"])
    assert near >= 16, "sixteen stems take three clicks each"
    # All nodes along a stem are clicked in both photos, so that it can be measured.
    both = sum({"front", "right"} <= set(mine[node]) for stem in made["stems"] for node in stem["nodes"])
    whole = sum(len(stem["nodes"]) for stem in made["stems"])
    print(f"{both} of {whole} nodes are clicked in both photos")
    assert both >= 0.95 * whole


if __name__ == "__main__":
    main()
