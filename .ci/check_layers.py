#!/usr/bin/env python3
"""Fails if a module includes a header of a module below it, or a package where it may not be.

The order is that of add_subdirectory in the top CMakeLists.txt: the flow of the light. Headers
include the standard library and our own headers only; Embree, TBB, OpenImageIO, VTK, EGL and
OSMesa are each named in one source file. check_layers.py [ROOT]
"""

import pathlib
import re
import sys

NOT_MODULES = {"tests", "cmake"}
ONLY_IN = {"embree": "src/visibility/ray_visibility.cpp", "tbb/": "src/core/parallel.cpp",
           "oneapi/tbb": "src/core/parallel.cpp", "OpenImageIO/": "src/pictures/oiio_codec.cpp",
           "vtk": "src/output/vtk_codec.cpp", "EGL/": "src/visibility/gl_context.cpp",
           "GL/osmesa": "src/visibility/gl_context.cpp"}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def modules(root):
    """Folder and include prefix of each module, in order."""
    text = (root / "CMakeLists.txt").read_text()
    folders = re.findall(r"^\s*add_subdirectory\(([\w/]+)\)", text, re.MULTILINE)
    return [(f, f.removeprefix("src/")) for f in folders if f.split("/")[0] not in NOT_MODULES]


def faults_of_file(path, root, own, order):
    name = path.relative_to(root).as_posix()
    private = "Private to this module." in path.read_text(errors="replace")
    for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        kind, target = match.groups()
        where, module = f"{name}:{number}", target.split("/")[0]
        if kind == '"' and module not in order:
            yield f'{where}: "{target}" does not start at a module'
        elif kind == '"' and order[module] > order[own]:
            yield f'{where}: {own} may not use {module}, which stands below it'
        elif kind == "<" and path.suffix == ".h" and re.search(r"[/.]", target) and not private:
            yield f"{where}: a header may include only the standard library and ours: <{target}>"
        for package, place in ONLY_IN.items():
            if kind == "<" and target.startswith(package) and name != place:
                yield f"{where}: <{target}> may be named in {place} alone"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
    listed = modules(root)
    order = {prefix: rank for rank, (_, prefix) in enumerate(listed)}
    faults, files = [], 0
    for folder, prefix in listed:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                files += 1
                faults += faults_of_file(path, root, prefix, order)
    print("\n".join(faults) if faults else f"{files} files keep to the order of the modules")
    return 1 if faults or not files else 0


if __name__ == "__main__":
    sys.exit(main())
