#!/usr/bin/env python3
"""How exact `axil skeleton` is on plants whose true shape is known: a table, one row a plant and one for all of them.   needs numpy

  measure_plants.py AXIL PLANTS [--cases p01,p02] [--photos bare_persp_plain] [--camera known|unknown] [--noise 3] [--wrong 0.05]
                    [--every 6] [--seeds 1,2,3] [--no-snap] [--each]

PLANTS is a folder with to_project.py, score_nodes.py and cases/. Every project is made by to_project.py and measured by the command
as a user would. Errors are in percent of the plant's height, after the best similarity where cameras are unknown (as score_nodes.py has
them). Radii: of nodes whose stem is at least six pixels wide. 68 and 95: how many coordinates lie within one and 1.96 of their sigma
(turned about the origin as fits best where cameras are unknown). found: wrong clicks that were named; right: of those named, how many are wrong.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

WRONG_PX = 15  # a right click of 3 px noise is never so far off, a wrong one always


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("axil")
    parser.add_argument("plants", type=pathlib.Path)
    parser.add_argument("--cases", default="p01,p02,p03,p04,p05,p06,p07")
    parser.add_argument("--photos", default="bare_persp_plain")
    parser.add_argument("--camera", default="known", choices=["known", "unknown"])
    parser.add_argument("--noise", default="3")
    parser.add_argument("--wrong", default="0")
    parser.add_argument("--every", default="6")
    parser.add_argument("--seeds", default="1")
    parser.add_argument("--no-snap", dest="snap", action="store_false")
    parser.add_argument("--each", action="store_true", help="a row for every project too")
    return parser.parse_args()


def similarity(a, b):
    """The best s, R, t with s R a + t near b."""
    am, bm = a.mean(0), b.mean(0)
    u, d, vt = np.linalg.svd((b - bm).T @ (a - am) / len(a))
    flip = np.diag([1, 1, np.sign(np.linalg.det(u @ vt))])
    r = u @ flip @ vt
    s = (d * np.diag(flip)).sum() / ((a - am) ** 2).sum() * len(a)
    return s, r, bm - s * r @ am


def turn_about_origin(a, b, weight):
    u, _, vt = np.linalg.svd((b * weight).T @ a)
    return u @ np.diag([1, 1, np.sign(np.linalg.det(u @ vt))]) @ vt


def project(camera, points):
    x = points @ np.array(camera["R"]).T + np.array(camera["t"])
    k = np.array(camera["K"])
    if camera["type"] == "perspective":
        x = x / x[:, 2:]
    return np.stack([k[0, 0] * x[:, 0] + k[0, 2], k[1, 1] * x[:, 1] + k[1, 2]], 1)


def pixels_wide(camera, points, radius):
    if camera["type"] != "perspective":
        return 2 * radius * camera["K"][0][0]
    return 2 * radius * camera["K"][0][0] / (points @ np.array(camera["R"]).T + np.array(camera["t"]))[:, 2]


class Lines:
    """The true centre lines."""

    def __init__(self, curves):
        self.p = np.concatenate([np.array(c[:-1], float) for c in curves])
        self.q = np.concatenate([np.diff(np.array(c, float), axis=0) for c in curves])
        self.qq = np.maximum((self.q * self.q).sum(1), 1e-30)

    def off(self, x):
        f = np.clip(((x - self.p) * self.q).sum(1) / self.qq, 0, 1)
        return np.linalg.norm(self.p + self.q * f[:, None] - x, axis=1).min()


def measured(options, case, seed, folder):
    """-> what one project says, or the reason why it says nothing"""
    path = folder / "plant.axil"
    make = [sys.executable, options.plants / "to_project.py", case, "--photos", options.photos, "--camera", options.camera, "--noise", options.noise,
            "--seed", seed, "--every", options.every, "--wrong", options.wrong, "-o", path]
    subprocess.run(list(map(str, make)), check=True)
    done = subprocess.run([options.axil, "skeleton", str(path)] + (["--snap"] if options.snap else []), capture_output=True)
    if done.returncode != 0:
        return done.stderr.decode("utf-8").strip()
    return judged(options, case, json.loads(done.stdout), json.loads(path.read_text()), json.loads(path.with_suffix(".truth.json").read_text()))


def judged(options, case, skeleton, made, truth):
    cameras = json.loads((case / "cameras.json").read_text())["cameras"]
    own = {v["name"]: cameras[options.photos.split("_")[1] + "_" + v["name"]] for v in made["views"]}
    nodes = [n for n in skeleton["nodes"] if str(n["id"]) in truth["nodes"]]
    at = np.array([n["position"] for n in nodes], float)
    sigma = np.array([n["sigma"] for n in nodes], float)
    want = np.array([truth["nodes"][str(n["id"])] for n in nodes], float)
    radius = np.array([truth["radius"][str(n["id"])] for n in nodes], float)
    found = np.array([n.get("radius") or np.nan for n in nodes], float)
    scale, fitted, turned = 1.0, at, at
    if options.camera == "unknown":
        scale, r, t = similarity(at, want)
        fitted = scale * at @ r.T + t
        turned = at @ turn_about_origin(at, want, 1 / np.mean(sigma**2, 1, keepdims=True)).T
    percent = 100 / truth["height"]
    lines = Lines(truth["curves"])
    wide = np.median([pixels_wide(c, want, radius) for c in own.values()], 0) >= 6
    off = np.abs(turned - want) / sigma
    bad = {(n["id"], v) for n in made["nodes"] for v, px in n["clicks"].items()
           if np.hypot(*(project(own[v], np.array([truth["nodes"][str(n["id"])]]))[0] - px)) > WRONG_PX}
    named = {(s["node"], s["view"]) for s in skeleton.get("suspect_clicks", []) if s.get("chance", 1) >= 0.5}
    return {"node": np.linalg.norm(fitted - want, axis=1) * percent, "line": np.array([lines.off(x) for x in fitted]) * percent,
            "radius": 100 * np.abs(found * scale / radius - 1)[wide & ~np.isnan(found)], "off": off[sigma > 0], "size": [100 * abs(scale - 1)],
            "missing": len(truth["nodes"]) - len(nodes), "bad": len(bad), "named": len(named), "hit": len(bad & named), "nan": not np.isfinite(at).all()}


HEAD = ("plant", "nodes", "lack", "node 50", "95", "line 50", "95", "radius 50", "size", "68", "95", "wrong", "found", "right")


def row(name, results):
    def share(part, whole):
        return f"{100 * part / whole:.0f}" if whole else "-"

    def middle(values, q, digits=3):
        return f"{np.percentile(values, q):.{digits}f}" if len(values) else "-"

    all_of = {key: np.concatenate([r[key] for r in results]) for key in ("node", "line", "radius", "off", "size")}
    bad, named, hit = (sum(r[key] for r in results) for key in ("bad", "named", "hit"))
    cells = (name, len(all_of["node"]), sum(r["missing"] for r in results), middle(all_of["node"], 50), middle(all_of["node"], 95), middle(all_of["line"], 50),
             middle(all_of["line"], 95), middle(all_of["radius"], 50, 1), middle(all_of["size"], 100, 2), share((all_of["off"] < 1).sum(), all_of["off"].size),
             share((all_of["off"] < 1.96).sum(), all_of["off"].size), bad, share(hit, bad), share(hit, named))
    print("".join(f"{str(c):>{14 if i == 0 else 10}}" for i, c in enumerate(cells)), flush=True)


def main():
    options = arguments()
    print("".join(f"{c:>{14 if i == 0 else 10}}" for i, c in enumerate(HEAD)), flush=True)
    everything, worst = [], []
    for wanted in options.cases.split(","):
        case = next(c for c in sorted((options.plants / "cases").iterdir()) if c.name.startswith(wanted))
        own = []
        for seed in options.seeds.split(","):
            with tempfile.TemporaryDirectory(prefix="axil_plants_") as folder:
                result = measured(options, case, seed, pathlib.Path(folder))
            if isinstance(result, str):
                print(f"{wanted} seed {seed}: {result}", flush=True)
                continue
            if options.each:
                row(f"{wanted} seed {seed}", [result])
            own.append(result)
        if own:
            row(wanted, own)
        everything += own
        worst += [(float(np.median(r["node"])), float(np.percentile(r["node"], 95))) for r in own]
    if everything:
        row("all", everything)
        print(f"of {len(worst)} projects: median of the nodes at most {max(w[0] for w in worst):.3f}, 95th percentile at most {max(w[1] for w in worst):.3f}; "
              f"not a number: {sum(r['nan'] for r in everything)}")


if __name__ == "__main__":
    main()
