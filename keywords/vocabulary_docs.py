#!/usr/bin/env python3
"""Writes docs/keywords.md from the vocabulary's tables, so that the two cannot differ.

  vocabulary_docs.py           writes it
  vocabulary_docs.py --check   fails when it is not what the tables say
"""
import pathlib
import sys

TOP = pathlib.Path(__file__).resolve().parent.parent
TABLES = [
    ("arrangement", "Leaf arrangement", ["leavesPerNode", "divergence_deg", "clustered"]),
    ("leaf_shape", "Shapes", ["shape"]),
    ("leaf_type", "Leaf types", []),
    ("apex", "Tips", []),
    ("base", "Feet", []),
    ("margin", "Margins", []),
    ("attachment", "Attachment", []),
    ("venation", "Veins", []),
    ("surface", "Surfaces", []),
    ("life_form", "Life forms", []),
    ("duration", "Duration", []),
    ("habit", "Habit", []),
    ("inflorescence_type", "Inflorescences", []),
    ("flower_plan", "Flowers", []),
    ("fruit_type", "Fruits", []),
    ("colour", "Colours", []),
    ("organ", "Organs", ["role", "partOf", "size", "countable"]),
    ("unit", "Units", ["metres"]),
    ("dimension", "Dimensions", []),
]
HEAD = """# Keywords: what a description can say

`axil keywords FILE` reads a description in English, Traditional or Simplified Chinese and prints its traits, each with the words it was
read from; `--json` prints them for programs, with the presets that they set. Nothing is guessed: no words, no trait.

- A statement is about the organ named before it ("Leaves opposite, ovate"; 葉對生，卵形) or right after an adjective ("opposite leaves"; 對生的葉).
- A part makes a shape its own: "base cordate", "cordate at the base", 基部心形.
- Sizes need a unit: `3-8 cm long`, `(12-)23-34(-40) × 4.5-5.6 cm` (length × width), 長3-8公分, "up to 20 m tall".
- Counts: "petals 5", "leaflets 5-8 pairs", 小葉8-12對; leaves at a node: "in whorls of 4", "4 leaves per node", 四葉輪生.
- "ovate to lanceolate" is two traits, "ovate-lanceolate" and 卵狀披針形 are one; "rarely", "usually", "narrowly" stay with the trait as its
  qualifier; "not opposite" and 不對生 say nothing.
- Words set in *italics* are everyday words too: they count only where an organ is named in the same sentence. A paragraph in which nothing
  else speaks of a plant yields nothing.

The tables below are made from `keywords/data/*.tsv` by `keywords/vocabulary_docs.py`. A botanist extends them by adding words to a row.
"""


def rows_of(name):
    lines = (TOP / "keywords" / "data" / f"{name}.tsv").read_text(encoding="utf-8").splitlines()
    lines = [line.split("\t") for line in lines if line and not line.startswith("#")]
    return [dict(zip(lines[0], line)) for line in lines[1:]]


def words(cell):
    terms = [] if cell == "-" else [term.strip() for term in cell.split(",")]
    return ", ".join(f"*{term[:-1]}*" if term.endswith("?") else term for term in terms) or " "


def table(name, title, extra):
    rows = rows_of(name)
    lines = [f"\n## {title} ({len(rows)})\n"]
    lines.append("| concept | English | 繁體 | 简体 | " + "".join(f"{column} | " for column in extra) + "meaning |")
    lines.append("|---" * (5 + len(extra)) + "|")
    for row in rows:
        cells = [row["concept"], words(row["english"]), words(row["traditional"]), words(row["simplified"])]
        lines.append("| " + " | ".join(cells + [row[column] for column in extra] + [row["definition"]]) + " |")
    return "\n".join(lines) + "\n"


def main():
    text = HEAD + "".join(table(*entry) for entry in TABLES)
    path = TOP / "docs" / "keywords.md"
    if sys.argv[1:] == ["--check"]:
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            sys.exit("docs/keywords.md is not what keywords/data says; run keywords/vocabulary_docs.py")
        return
    path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
