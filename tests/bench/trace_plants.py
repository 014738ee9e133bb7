#!/usr/bin/env python3
"""How much of a plant `axil trace` drafts by itself, on plants whose true shape is known: recall and precision of branches at level 2.   needs numpy

  trace_plants.py AXIL PLANTS [--cases p01,p02] [--photos bare_persp_plain,bare_handheld_clutter] [--camera known|unknown] [--every 6]
                  [--noise 3] [--seed 1] [--without-masks] [--keep FOLDER]

PLANTS is a folder with to_project.py, score.py and cases/. Cameras that are known need no click; unknown ones are found from clicks of
the noise and seed given, whose stems are taken out before the draft. Scored as `score.py --tol 2` does, unknown cameras with
`--align similarity`. --keep: leave the drafts in a folder.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("axil")
    parser.add_argument("plants", type=pathlib.Path)
    parser.add_argument("--cases", default="p01,p02,p03,p04,p05,p06,p07")
    parser.add_argument("--photos", default="bare_persp_plain,bare_handheld_clutter")
    parser.add_argument("--camera", default="known", choices=["known", "unknown"])
    parser.add_argument("--every", default="6")
    parser.add_argument("--noise", default="3")
    parser.add_argument("--seed", default="1")
    parser.add_argument("--without-masks", dest="masks", action="store_false")
    parser.add_argument("--keep", type=pathlib.Path)
    return parser.parse_args()


def project_without_stems(options, case, photos, folder):
    path = folder / "plant.axil"
    subprocess.run([sys.executable, str(options.plants / "to_project.py"), str(case), "--photos", photos, "--camera", options.camera, "--noise", options.noise,
                    "--seed", options.seed, "--every", options.every, "-o", str(path)], check=True)
    made = json.loads(path.read_text())
    if options.camera == "unknown":  # the cameras are estimated by the clicks; only the draft is judged
        made["stems"] = []
    else:
        made["nodes"], made["stems"] = [], []
    path.write_text(json.dumps(made))
    return path, {node["id"] for node in made["nodes"]}


def branches(skeleton):
    place = {n["id"]: n for n in skeleton["nodes"]}
    return {"branches": [{"id": s["id"], "parent": -1 if s["parent"] is None else s["parent"], "points": [place[n]["position"] for n in s["nodes"]],
                          "radius": [place[n].get("radius", 0) for n in s["nodes"]]} for s in skeleton["stems"]]}


def drafted(options, case, photos, folder):
    """-> recall and precision at level 2, or why there are none"""
    path, clicked = project_without_stems(options, case, photos, folder)
    masks = [part for v in ("front", "right", "top") for part in ("--mask", f"{v}={case / f'{photos}_{v}.mask.png'}")] if options.masks else []
    traced = folder / "traced.axil"
    done = subprocess.run([options.axil, "trace", str(path), *masks, "-o", str(traced)], capture_output=True)
    if done.returncode == 0:
        without_the_persons_clicks(traced, clicked)
        done = subprocess.run([options.axil, "skeleton", str(traced)], capture_output=True)
    if done.returncode != 0:
        return done.stderr.decode("utf-8").strip().splitlines()[-1]
    (folder / "draft.json").write_text(json.dumps(branches(json.loads(done.stdout))))
    align = ["--align", "similarity"] if options.camera == "unknown" else []
    score = [sys.executable, options.plants / "score.py", folder / "draft.json", case / "plant.json", "--tol", "2", "--json", *align]
    return json.loads(subprocess.run(list(map(str, score)), capture_output=True, check=True).stdout)


def without_the_persons_clicks(traced, clicked):
    """A node that belongs to no stem is no part of a plant; the draft's own clicks hold the cameras as well."""
    made = json.loads(traced.read_text())
    made["nodes"] = [n for n in made["nodes"] if n["id"] not in clicked]
    traced.write_text(json.dumps(made))


def main():
    options = arguments()
    print(f"{'plant':>8}{'photos':>26}{'recall':>8}{'precision':>11}", flush=True)
    for wanted in options.cases.split(","):
        case = next(c for c in sorted((options.plants / "cases").iterdir()) if c.name.startswith(wanted))
        for photos in options.photos.split(","):
            if not (case / f"{photos}_front.jpg").exists():
                continue
            with tempfile.TemporaryDirectory(prefix="axil_trace_") as made:
                folder = pathlib.Path(made)
                if options.keep:
                    folder = options.keep / f"{wanted}_{photos}"
                    folder.mkdir(parents=True, exist_ok=True)
                said = drafted(options, case, photos, folder)
            if isinstance(said, str):
                print(f"{wanted:>8}{photos:>26}  {said}", flush=True)
                continue
            enough = said["branch_recall"] >= 0.7 and said["branch_precision"] >= 0.8
            print(f"{wanted:>8}{photos:>26}{said['branch_recall']:>8.2f}{said['branch_precision']:>11.2f}{'' if enough else '  short of 0.7 and 0.8'}", flush=True)


if __name__ == "__main__":
    main()
