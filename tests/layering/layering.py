#!/usr/bin/env python3
"""Reads every #include line of the rooms and fails on an arrow that docs/architecture.md does not draw.

  layering.py SOURCE_FOLDER
"""
import pathlib
import re
import sys

ARROWS = {
    "base": [],
    "organs": ["base"],
    "keywords": ["organs"],
    "skeleton3d": ["base"],
    "quantify": ["skeleton3d", "keywords"],
    "simeco": ["base"],
    "emit": ["quantify", "keywords", "simeco"],
    "render": ["simeco", "skeleton3d", "organs"],
    "document": ["emit", "render"],
    "ui": ["document"],
    "app": ["document", "ui"],
}

# A package and the only rooms whose files may include it.
PACKAGES = {
    r"opencv2/": {"skeleton3d", "render"},
    r"ceres/": {"skeleton3d"},
    r"CGAL/": {"skeleton3d", "quantify"},
    r"Eigen/": {"skeleton3d", "quantify"},
    r"vtk\w+\.h|vtk_glew\.h": {"render"},
    r"EGL/": {"render"},
    r"tiny_gltf\.h|tinygltf": {"render"},
    r"GLFW/|imgui": {"ui"},
    r"CLI/": {"app"},
    r"nlohmann/": {"keywords", "skeleton3d", "simeco", "render", "document", "app"},
}


def reachable(room):
    """The rooms that `room` may include: its arrows, and what those may include in turn."""
    seen, todo = {room}, [room]
    while todo:
        for target in ARROWS[todo.pop()]:
            if target not in seen:
                seen.add(target)
                todo.append(target)
    return seen


def faults_of(path, room, top):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
        if not match:
            continue
        name = match.group(1)
        target = name.split("/")[0]
        where = f"{path.relative_to(top)}:{number}"
        if target in ARROWS and target not in reachable(room):
            yield f"{where}: {room} may not include {name}"
        for pattern, homes in PACKAGES.items():
            if re.match(pattern, name) and room not in homes:
                yield f"{where}: {name} belongs to {', '.join(sorted(homes))}, not to {room}"
            if re.match(pattern, name) and path.suffix == ".hpp" and "_interop" not in path.name and "nlohmann/json_fwd" not in name:
                yield f"{where}: {name} in a header; packages stay in .cpp files and private *_interop.hpp"


def main():
    top = pathlib.Path(sys.argv[1])
    files = [(p, room) for room in ARROWS for p in sorted((top / room).rglob("*")) if p.suffix in (".hpp", ".cpp")]
    if not files:
        sys.exit(f"layering: no source files under {top}")
    faults = [fault for path, room in files for fault in faults_of(path, room, top)]
    print("\n".join(faults) or f"layering: {len(files)} files, no arrow that is not drawn")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
