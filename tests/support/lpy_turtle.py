#!/usr/bin/env python3
"""Runs the part of L-Py's language that emit writes, and prints what its turtle draws; written from L-Py's documentation, not from emit.

  lpy_turtle.py FILE.lpy ...

A line a drawing step: "file N", "F x y z x y z" (a segment from, to), "P x y z x y z ..." (corners of a polygon). Coordinates are L-Py's own: the turtle starts at the
origin with heading (0,0,1), left (0,-1,0) and up (1,0,0).
"""
import math
import re
import sys


def modules_of(text):
    """'A(k,n)[F(2)]' -> [('A', ['k', 'n']), ('[', []), ...]"""
    found, i = [], 0
    while i < len(text):
        if text[i].isspace():
            i += 1
            continue
        name = text[i:i + 2] if text[i] == "@" else text[i]
        i += len(name)
        arguments = []
        if i < len(text) and text[i] == "(":
            depth, start, i = 1, i + 1, i + 1
            while depth:
                if text[i] in "([": depth += 1
                elif text[i] in ")]": depth -= 1
                elif text[i] == "," and depth == 1:
                    arguments.append(text[start:i])
                    start = i + 1
                i += 1
            arguments.append(text[start:i - 1])
        found.append((name, [a.strip() for a in arguments]))
    return found


def made(text):
    if text.strip() in ("", "*"):
        return "[]"
    return "[" + ",".join("(%r,(%s))" % (n, "".join(a + "," for a in args)) for n, args in modules_of(text)) + "]"


class Rule:
    def __init__(self, header, body, scope):
        left, pred, right = "", header, ""
        if " < " in pred: left, pred = pred.split(" < ")
        if " > " in pred: pred, right = pred.split(" > ")
        if left: raise ValueError("left contexts are outside this subset")
        (self.name, formal), = modules_of(pred)
        self.arity = len(formal)
        self.right = [(n, len(a)) for n, a in modules_of(right)]
        formal = formal + [a for _, args in modules_of(right) for a in args]
        lines = ["def rule(%s):" % ", ".join(formal)]
        for line in body:
            match = re.match(r"(\s+)produce(\s.*)?$", line)
            lines.append(match.group(1) + "return " + made(match.group(2) or "") if match else line)
        exec("\n".join(lines), scope)
        self.function = scope["rule"]

    def apply(self, string, i):
        name, arguments = string[i]
        if name != self.name or len(arguments) != self.arity: return None
        values, at = list(arguments), i
        for wanted, arity in self.right:
            at += 1
            while at < len(string) and string[at][0] == "[":
                depth = 1
                while depth:
                    at += 1
                    depth += {"[": 1, "]": -1}.get(string[at][0], 0)
                at += 1
            if at >= len(string) or string[at][0] != wanted or len(string[at][1]) != arity: return None
            values += string[at][1]
        return self.function(*values)


def derived(path):
    lines = open(path).read().split("\n")
    start = next(i for i, l in enumerate(lines) if l.startswith("Axiom:"))
    scope = {}
    exec("\n".join(lines[:start]), scope)
    steps = int(next(l for l in lines if l.startswith("derivation length:")).split(":")[1])
    production = lines.index("production:")
    end = lines.index("endlsystem")
    rules, i = [], production + 1
    while i < end:
        line = lines[i]
        i += 1
        if not line.strip() or line.startswith("#"): continue
        assert not line[0].isspace() and line.rstrip().endswith(":"), line
        header = line.rstrip()[:-1].strip()
        body = []
        while i < end and (not lines[i].strip() or lines[i][0].isspace()):
            if lines[i].strip(): body.append(lines[i])
            i += 1
        rules.append(Rule(header, body, scope))
    by_name = {}
    for rule in rules: by_name.setdefault(rule.name, []).append(rule)
    string = eval(made(lines[start][len("Axiom:"):]), scope)
    for _ in range(steps):
        after, changed = [], False
        for i, module in enumerate(string):
            for rule in by_name.get(module[0], []):
                result = rule.apply(string, i)
                if result is not None:
                    after += result
                    changed = True
                    break
            else:
                after.append(module)
        string = after
        if not changed: break
    return string


def rotated(v, axis, degrees):
    a = math.radians(degrees)
    c, s = math.cos(a), math.sin(a)
    dot = sum(x * y for x, y in zip(axis, v))
    cross = (axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2], axis[0] * v[1] - axis[1] * v[0])
    return tuple(v[k] * c + cross[k] * s + axis[k] * dot * (1 - c) for k in range(3))


def draw(string, out):
    at, h, l, u = (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0), (1.0, 0.0, 0.0)
    saved, polygon = [], None
    for name, args in string:
        x = args[0] if args else 0
        if name in "Ff":
            to = tuple(a + d * x for a, d in zip(at, h))
            if polygon is not None: polygon.append(to)
            elif name == "F": out.append("F %r %r %r %r %r %r" % (at + to))
            at = to
        elif name in "+-":
            # left and right: about up
            angle = x if name == "+" else -x
            h, l = (tuple(p * math.cos(math.radians(angle)) + q * math.sin(math.radians(angle)) for p, q in zip(h, l)),
                    tuple(q * math.cos(math.radians(angle)) - p * math.sin(math.radians(angle)) for p, q in zip(h, l)))
        elif name in "&^":
            angle = x if name == "&" else -x
            h, u = rotated(h, l, angle), rotated(u, l, angle)
        elif name in "/\\":
            angle = x if name == "/" else -x
            l, u = rotated(l, h, angle), rotated(u, h, angle)
        elif name == "[": saved.append((at, h, l, u))
        elif name == "]": at, h, l, u = saved.pop()
        elif name == "{": polygon = []
        elif name == ".": polygon.append(at)
        elif name == "}":
            out.append("P " + " ".join("%r %r %r" % c for c in polygon))
            polygon = None
        elif name == "@M": at = tuple(float(a) for a in args)


for n, path in enumerate(sys.argv[1:]):
    out = ["file %d" % n]
    draw(derived(path), out)
    print("\n".join(out))
