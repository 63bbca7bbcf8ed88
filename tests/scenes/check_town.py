#!/usr/bin/env python3
"""Checks the committed sample town: the generator makes the same bytes again, solids are closed
and face outwards, faces are planar, the ground has no gap, sizes are as promised.

check_town.py EXAMPLES_FOLDER; prints one line a check, exit code 1 if any fails. Reads the
CityJSON on its own: it shares no code with the generator.
"""

import collections
import json
import math
import pathlib
import subprocess
import sys
import tempfile

PLANAR_M = 0.002  # coordinates are whole millimetres: half a diagonal of that grid, doubled
failures = 0


def check(condition, what):
    global failures
    failures += not condition
    print(("ok      " if condition else "FAILED  ") + what)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def newell(ring):
    """Vector area of a closed ring."""
    total = (0.0, 0.0, 0.0)
    for a, b in zip(ring, ring[1:] + ring[:1]):
        c = cross(minus(a, ring[0]), minus(b, ring[0]))
        total = (total[0] + c[0] / 2, total[1] + c[1] / 2, total[2] + c[2] / 2)
    return total


def triangles_in(surface):
    return sum(len(ring) for ring in surface) - 2 + 2 * (len(surface) - 1)


def unit_normal(rings):
    n = newell(rings[0])
    length = math.sqrt(dot(n, n))
    return None if length < 1e-6 else tuple(c / length for c in n)


def faults_of_surface(rings):
    """What is wrong with one surface, its rings as points."""
    n = unit_normal(rings)
    if n is None:
        return ["no area"]
    found = []
    off = max(abs(dot(minus(p, rings[0][0]), n)) for ring in rings for p in ring)
    if off > PLANAR_M:
        found.append(f"not planar by {off:.4f} m")
    if any(dot(newell(ring), n) >= 0 for ring in rings[1:]):
        found.append("an inner ring turns the same way as the outer")
    if dot(newell(rings[0]), n) + sum(dot(newell(r), n) for r in rings[1:]) <= 0:
        found.append("inner rings cover the outer")
    if any(len(set(ring)) < len(ring) or len(ring) < 3 for ring in rings):
        found.append("a vertex twice in a ring")
    return found


def open_edges(surfaces):
    """Directed edges that have not exactly one opposite."""
    edges = collections.Counter()
    for surface in surfaces:
        for ring in surface:
            edges.update(zip(ring, ring[1:] + ring[:1]))
    return [e for e, n in edges.items() if n != 1 or edges[(e[1], e[0])] != 1]


def volume(surfaces, points):
    total = 0.0
    for surface in surfaces:
        for ring in surface:
            total += dot(points[ring[0]], newell([points[i] for i in ring])) / 3
    return total


class Town:
    def __init__(self, path):
        self.bytes = path.read_bytes()
        self.data = json.loads(self.bytes)
        scale = self.data["transform"]["scale"]
        self.points = [tuple(c * s for c, s in zip(v, scale)) for v in self.data["vertices"]]
        self.objects = self.data["CityObjects"]
        self.templates = self.data["geometry-templates"]

    def geometries(self):
        for name, thing in self.objects.items():
            for geometry in thing["geometry"]:
                yield name, thing["type"], geometry


def surfaces_of(geometry):
    return geometry["boundaries"][0] if geometry["type"] == "Solid" else geometry["boundaries"]


def check_regeneration(folder):
    with tempfile.TemporaryDirectory() as made:
        for seed, same in (("1", True), ("2", False)):
            out = pathlib.Path(made) / "town.city.json"
            subprocess.run([sys.executable, "-B", str(folder / "generate_town.py"), "--seed", seed,
                            "--out", str(out)], check=True)
            equal = out.read_bytes() == (folder / "sapporo_town.city.json").read_bytes()
            check(equal == same, f"seed {seed} makes {'the committed' if same else 'other'} bytes")


def check_faces(town):
    faults, solids, windows = [], 0, 0
    for name, kind, geometry in town.geometries():
        if geometry["type"] == "GeometryInstance":
            continue
        surfaces = surfaces_of(geometry)
        for number, surface in enumerate(surfaces):
            rings = [[town.points[i] for i in ring] for ring in surface]
            faults += [f"{name} face {number}: {f}" for f in faults_of_surface(rings)]
        if geometry["type"] == "Solid":
            solids += 1
            if open_edges(surfaces):
                faults.append(f"{name} lod {geometry['lod']}: {len(open_edges(surfaces))} open "
                              "edges")
            if not volume(surfaces, town.points) > 0:
                faults.append(f"{name} lod {geometry['lod']}: inside out")
        windows += count_windows(geometry, faults, name)
    for fault in faults[:10]:
        print("        " + fault)
    check(not faults, f"{solids} solids are closed, face outwards and are planar within 2 mm")
    check(windows > 1000, f"{windows} windows")


def count_windows(geometry, faults, name):
    if "semantics" not in geometry:
        return 0
    values = geometry["semantics"]["values"]
    values = values[0] if geometry["type"] == "Solid" else values
    types = [s["type"] for s in geometry["semantics"]["surfaces"]]
    if len(values) != len(surfaces_of(geometry)):
        faults.append(f"{name}: one semantic value a face is missing")
    return sum(types[v] == "Window" for v in values)


def check_ground(town):
    """Terrain and roads together: one surface without a gap, none of it facing down."""
    surfaces = [s for _, kind, g in town.geometries() if kind in ("TINRelief", "Road")
                for s in g["boundaries"]]
    down = [s for s in surfaces if newell([town.points[i] for i in s[0]])[2] < -1e-6]
    check(not down, "no ground faces down")
    edges = collections.Counter(e for s in surfaces for e in zip(s[0], s[0][1:] + s[0][:1]))
    check(max(edges.values()) == 1, "no ground edge is used twice in one direction")
    lone = [(town.points[a], town.points[b]) for a, b in edges if (b, a) not in edges]
    water = next(g for _, kind, g in town.geometries() if kind == "WaterBody")
    level = town.points[water["boundaries"][0][0][0]][2]
    rim = [e for e in lone if e[0][2] > level and e[1][2] > level]
    border = [e for e in lone if abs(e[0][2] - 12.0) < 1e-6 and abs(e[1][2] - 12.0) < 1e-6]
    # What is left open: the border of the land, at its height, and the bottom of the basin.
    steps = [e for e in rim if e not in border]
    check(not [e for e in steps if math.dist(e[0][:2], e[1][:2]) > 0.001],
          f"{len(surfaces)} ground triangles leave no gap")


def check_trees(town):
    templates = town.templates["templates"]
    points = [tuple(p) for p in town.templates["vertices-templates"]]
    for number, template in enumerate(templates):
        surfaces = template["boundaries"]
        check(not open_edges(surfaces) and volume(surfaces, points) > 0,
              f"tree {number} is closed: {len(surfaces)} triangles")
    instances = [g for _, _, g in town.geometries() if g["type"] == "GeometryInstance"]
    check(all(0 <= g["template"] < len(templates) and len(g["boundaries"]) == 1
              and len(g["transformationMatrix"]) == 16 for g in instances),
          f"{len(instances)} trees have a template, a place and a matrix")
    return sum(len(templates[g["template"]]["boundaries"]) for g in instances)


def check_objects(town):
    for name, thing in town.objects.items():
        for child in thing.get("children", []):
            if name not in town.objects[child].get("parents", []):
                check(False, f"{child} does not name its parent {name}")
    both = [name for name, thing in town.objects.items() if thing["type"] in
            ("Building", "BuildingPart") and thing["geometry"]
            and {g["lod"] for g in thing["geometry"]} != {"1", "2"}]
    check(not both, "every building has LOD1 and LOD2")
    kinds = collections.Counter(thing["type"] for thing in town.objects.values())
    for kind in ("Building", "BuildingPart", "BuildingInstallation", "Bridge", "Road", "TINRelief",
                 "WaterBody", "SolitaryVegetationObject"):
        check(kinds[kind] > 0, f"{kinds[kind]} x {kind}")
    holes = max(len(s) for _, kind, g in town.geometries() if "boundaries" in g
                and g["type"] == "Solid" for s in surfaces_of(g))
    check(holes > 10, f"a wall with {holes - 1} inner rings")


def check_place(town):
    check(town.data["version"] == "2.0", "CityJSON 2.0")
    check(town.data["metadata"]["referenceSystem"].endswith("/EPSG/0/6680"), "EPSG:6680")
    # What PROJ 9.1 gives for 43.06 N 141.35 E; the generator's figures come from the formulas.
    east, north, _ = town.data["transform"]["translate"]
    check(math.dist((east, north), (-73308.302, -104033.316)) < 0.002, "at 43.06 N 141.35 E")
    check(len(town.bytes) < 3_000_000, f"{len(town.bytes)} bytes")


def main():
    folder = pathlib.Path(sys.argv[1])
    town = Town(folder / "sapporo_town.city.json")
    check_regeneration(folder)
    check_place(town)
    check_objects(town)
    check_faces(town)
    check_ground(town)
    trees = check_trees(town)
    best = trees
    for _, kind, geometry in town.geometries():
        if "boundaries" in geometry and not (kind.startswith("Building")
                                             and geometry["lod"] == "1") \
                and geometry["type"] != "GeometryInstance":
            best += sum(triangles_in(s) for s in surfaces_of(geometry))
    check(18_000 <= best <= 24_000, f"{best} triangles at the highest LOD, {trees} of them trees")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
