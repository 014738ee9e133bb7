#!/usr/bin/env python3
"""The grammars of the samples in every dialect, as a user writes them: the text is what the other programs' own parsers take.

An L-Py file is Python with rules in it: once each string of modules stands in quotes, Python's own parser must take the whole. An MTG is read by the columns that the format defines.

  dialects_test.py AXIL SOURCE_FOLDER [TEST ...]
"""
import ast
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

AXIL = str(pathlib.Path(sys.argv[1]).resolve())
SOURCE = pathlib.Path(sys.argv[2]).resolve()
SAMPLES = ["lantana", "aspen"]
KINDS = [("initial",), ("predictive",), ("predictive", "--style", "thesis"), ("structured",), ("structured", "--form", "exact")]


def emitted(sample, dialect, kind, *more):
    done = subprocess.run([AXIL, "emit", SOURCE / "samples" / sample / f"{sample}.axil", "--dialect", dialect, "--kind", *kind, *more], capture_output=True, timeout=120)
    assert done.returncode == 0, (sample, dialect, kind, done.stderr.decode())
    return done.stdout.decode("utf-8")


def modules_of(text):
    """A string of modules -> [(letter, Python source of its arguments)]; None where it is none."""
    modules, at = [], 0
    while at < len(text):
        if text[at].isspace():
            at += 1
            continue
        letter = re.match(r"@[A-Z]\w?|[A-Z]\w*|[A-Za-z]|[\[\]{}+\-&^/\\|$!_;,.%*]", text[at:])
        if not letter:
            return None
        at += letter.end()
        start = at
        if at < len(text) and text[at] == "(":
            depth = 0
            while at < len(text):
                depth += {"(": 1, ")": -1}.get(text[at], 0)
                at += 1
                if depth == 0:
                    break
            if depth:
                return None
        modules.append((letter.group(), text[start:at]))
    return modules


class LPy:
    """Python in which `produce MODULES` calls a function, a rule's head is a function's, and Axiom a value."""

    def __init__(self, test, text):
        self.test, self.lines, self.sections, self.heads = test, [], [], 0
        for line in text.split("\n"):
            self.lines.append(self.python(line))
        self.source = "\n".join(self.lines)

    def string(self, text):
        modules = modules_of(text)
        self.test.assertIsNotNone(modules, f"no string of modules: {text}")
        return "[" + ", ".join(f"({letter!r}, {arguments or '()'})" for letter, arguments in modules) + "]"

    def python(self, line):
        if line.startswith("Axiom:"):
            self.sections.append("Axiom")
            return "AXIOM = " + self.string(line[6:])
        if line.startswith("derivation length:"):
            self.sections.append("derivation length")
            return "STEPS = " + line[18:].strip()
        if line.rstrip() in ("production:", "endlsystem", "interpretation:", "homomorphism:"):
            self.sections.append(line.strip(": "))
            return "pass"
        produced = re.match(r"(\s*(?:(?:if|elif|else).*?:\s+)?)produce\b(.*)", line)
        if produced:
            return f"{produced.group(1)}yield {self.string(produced.group(2))}"
        if "production" in self.sections and line and not line[0].isspace() and not line.startswith("#") and line.rstrip().endswith(":"):
            head = line.rstrip()[:-1]
            modules = modules_of(re.sub(r"<<?|>>?", " ", head))
            self.test.assertTrue(modules, f"no rule's head: {line}")
            for _, arguments in modules:
                if arguments:
                    self.test.assertTrue(all(name.strip().isidentifier() for name in arguments[1:-1].split(",")), f"arguments of a head are names: {line}")
            self.heads += 1
            return f"def rule{self.heads}({', '.join(a[1:-1].strip() for _, a in modules if len(a) > 2)}):"
        return line


class Dialects(unittest.TestCase):
    def test_lpy_is_python_with_rules_in_it(self):
        for sample in SAMPLES:
            for kind in KINDS if sample == "lantana" else KINDS[3:]:
                with self.subTest(sample=sample, kind=kind):
                    program = LPy(self, emitted(sample, "lpy", kind))
                    self.assertEqual(program.sections, ["Axiom", "derivation length", "production", "endlsystem"])
                    self.assertGreater(program.heads, 0)
                    tree = ast.parse(program.source)
                    known = {name for node in ast.walk(tree) if isinstance(node, (ast.FunctionDef, ast.Assign)) for name in
                             ([node.name] if isinstance(node, ast.FunctionDef) else [t.id for t in node.targets if isinstance(t, ast.Name)])}
                    used = {node.func.id for node in ast.walk(tree) if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)}
                    self.assertLessEqual(used - known - set(dir(__import__("math"))), {"seed", "uniform", "gauss", "min", "max", "abs", "int", "range", "float", "round", "global"})

    def test_a_skeleton_file_is_a_plant_as_a_project_is(self):
        with tempfile.TemporaryDirectory() as folder:
            folder, project = pathlib.Path(folder), SOURCE / "samples/aspen/aspen.axil"
            (folder / "aspen.json").write_bytes(subprocess.run([AXIL, "skeleton", project], capture_output=True, check=True).stdout)
            texts = [subprocess.run([AXIL, "emit", plant, "--kind", "structured"], capture_output=True, check=True).stdout for plant in (project, folder / "aspen.json")]
            rules = [[line for line in text.decode().split("\n") if " ->" in line] for text in texts]
            self.assertEqual(len(rules[0]), 4)
            self.assertEqual(len(rules[0]), len(rules[1]))
            wrong = subprocess.run([AXIL, "emit", folder / "none.json"], capture_output=True)
            self.assertEqual(wrong.returncode, 1)
            self.assertIn(b"none.json", wrong.stderr)

    def test_cpfg_comes_with_its_view_and_animation_files(self):
        with tempfile.TemporaryDirectory() as folder:
            for kind in KINDS:
                with self.subTest(kind=kind):
                    out = pathlib.Path(folder) / "plant.l"
                    emitted("lantana", "cpfg", kind, "-o", out)
                    text = out.read_text()
                    self.assertTrue(text.startswith("/*"))
                    self.assertEqual(re.findall(r"(?m)^(Lsystem|derivation length|Axiom|endlsystem)", text), ["Lsystem", "derivation length", "Axiom", "endlsystem"])
                    self.assertTrue(out.with_suffix(".v").read_text().strip())
                    self.assertTrue(out.with_suffix(".a").read_text().strip())
                    again = subprocess.run([AXIL, "check", out], capture_output=True)
                    self.assertEqual((again.returncode, again.stdout), (0, b""))

    def test_mtg_rows_keep_to_the_columns_of_the_format(self):
        for sample in SAMPLES:
            for kind in KINDS[:1] + KINDS[3:4]:
                with self.subTest(sample=sample, kind=kind):
                    lines = [l for l in emitted(sample, "mtg", kind).split("\n") if l.strip() and not l.startswith("#")]
                    order = [l.split(":")[0] for l in lines if re.match(r"(CODE|CLASSES|DESCRIPTION|FEATURES|MTG):", l)]
                    self.assertEqual(order, ["CODE", "CLASSES", "DESCRIPTION", "FEATURES", "MTG"])
                    symbols = dict(l.split()[:2] for l in lines[3:lines.index("DESCRIPTION:")])
                    features = [l.split()[0] for l in lines[lines.index("FEATURES:") + 2:lines.index("MTG:")]]
                    head = lines[lines.index("MTG:") + 1].split("\t")
                    columns = head.index(features[0])
                    self.assertEqual(head[columns:], features)
                    names, last = set(), {}
                    for row in lines[lines.index("MTG:") + 2:]:
                        cells = row.split("\t")
                        self.assertEqual(len(cells), columns + len(features), row)
                        column = next(i for i, cell in enumerate(cells) if cell)
                        code = re.fullmatch(r"(\^?)([/<+])([A-Z])(\d+)", cells[column])
                        self.assertTrue(code and code.group(3) in symbols, row)
                        self.assertNotIn(code.group(0).lstrip("^/<+"), names)
                        names.add(code.group(0).lstrip("^/<+"))
                        # ^ goes on in its own column; what has none is borne by the column before, or begins the plant.
                        self.assertTrue(column in last if code.group(1) else (column - 1 in last or not last), row)
                        last = {c: r for c, r in last.items() if c < column}
                        last[column] = row
                        for value in cells[columns:]:
                            if value:
                                float(value)
                                self.assertNotIn("+", value)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
