#!/usr/bin/env python3
"""The seven species of samples/species: from words alone to a plant in flower, alike from all three scripts.

  species_test.py AXIL SOURCE_FOLDER
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

AXIL, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SCRIPTS = ("en", "zh-Hant", "zh-Hans")
# What a grammar of each plant must have, by the words that its descriptions use.
EXPECTED = {
    "lantana_camara": ("ovate", "margin crenate", "salverform"),
    "senna_siamea": ("oblong", "type even-pinnate", "petal obovate"),
    "senna_alata": ("oblong", "type even-pinnate", "petal obovate"),
    "pentas_lanceolata": ("apex acuminate", "base attenuate", "salverform"),
    "hypoestes_phyllostachya": ("ovate", "spots", "bilabiate"),
    "rosa": ("margin serrate", "type odd-pinnate", "petal obcordate"),
    "catharanthus_roseus": ("apex mucronate", "base cuneate", "salverform"),
}
faults = []


def run(*arguments):
    done = subprocess.run([AXIL, *arguments], capture_output=True, text=True, encoding="utf-8")
    if done.returncode != 0:
        faults.append(f"axil {' '.join(arguments)} ended with {done.returncode}: {done.stderr.strip()}")
    return done.stdout


def plain(grammar):
    """The grammar without its comments and name: what grows."""
    lines = [line for line in grammar.splitlines() if not line.lstrip().startswith("//")]
    return re.sub(r'(EcoSystem 1.1|Plant) "[^"]*"', r"\1", "\n".join(lines))


with tempfile.TemporaryDirectory() as folder:
    for name, words in EXPECTED.items():
        grammars = {}
        for script in SCRIPTS:
            grammars[script] = run("describe", str(SOURCE / "samples/species" / name / f"{script}.txt"))
        for script in SCRIPTS[1:]:
            if plain(grammars[script]) != plain(grammars["en"]):
                ours, theirs = plain(grammars["en"]).splitlines(), plain(grammars[script]).splitlines()
                first = next((f"{a.strip()}  |  {b.strip()}" for a, b in zip(ours, theirs) if a != b), "their lengths differ")
                faults.append(f"{name}: en and {script} grow different plants: {first}")
        for word in words:
            if word not in grammars["en"]:
                faults.append(f"{name}: the grammar says nothing of '{word}'")
        out = pathlib.Path(folder) / f"{name}.json"
        run("grow", str(SOURCE / "samples/species" / name / "en.txt"), "-o", str(out))
        path = pathlib.Path(folder) / f"{name}.simeco"
        path.write_text(grammars["en"], encoding="utf-8")
        run("check", str(path))
        letters = json.loads(run("derive", str(path), "--counts"))["letters"]
        if letters.get("L", 0) < 20 or letters.get("W", 0) < 1:
            faults.append(f"{name}: {letters.get('L', 0)} leaves and {letters.get('W', 0)} flowers are too few")
        print(f"{name}: {letters.get('L', 0)} leaves, {letters.get('W', 0)} flowers")

print("\n".join(faults) or "all seven species grow, alike from three scripts")
sys.exit(1 if faults else 0)
