#!/usr/bin/env python3
"""Checks the townscape of cuboids: as many triangles as asked, nothing overlaps, closed towards the
sky and facing outwards, as high and as dense as promised, the same bytes for the same seed, and
tenku reads it without a finding.

check_cuboids.py EXAMPLES_FOLDER [TENKU]; prints one line a check, exit code 1 if any fails. What
needs the program is skipped where it is not built. Reads the OBJ on its own: it shares no code
with the generator.
"""

import collections
import itertools
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

failures = 0


def check(condition, what):
    global failures
    failures += not condition
    print(("ok      " if condition else "FAILED  ") + what)


def generate(generator, out, *options):
    subprocess.run([sys.executable, "-B", generator, "--out", out, *options], check=True)
    return out.read_bytes()


def read_objects(text):
    """@return  object -> [(material, three points)]"""
    points, objects, name, material = [], collections.defaultdict(list), None, None
    for line in text.decode().splitlines():
        keyword, *words = line.split()
        if keyword == "v":
            points.append(tuple(float(word) for word in words))
        elif keyword == "o":
            name = words[0]
        elif keyword == "usemtl":
            material = words[0]
        elif keyword == "f":
            at = [int(word) for word in words]
            objects[name].append((material, [points[i - 1 if i > 0 else i] for i in at]))
    return objects


def signed_volume(triangles):
    """Enclosed volume; a floor at height 0 may be missing, as it adds nothing."""
    return sum(x0 * (y1 * z2 - z1 * y2) + y0 * (z1 * x2 - x1 * z2) + z0 * (x1 * y2 - y1 * x2)
               for _, ((x0, y0, z0), (x1, y1, z1), (x2, y2, z2)) in triangles) / 6.0


class Building:
    def __init__(self, triangles):
        corners = {p[:2] for _, points in triangles for p in points}
        self.height = max(p[2] for _, points in triangles for p in points)
        middle = tuple(sum(c[axis] for c in corners) / len(corners) for axis in (0, 1))
        roof = [[p[:2] for p in points] for material, points in triangles if material == "roof"]
        # The roof's two triangles share the diagonal a - c of the footprint a, b, c, d.
        self.footprint = [*roof[0], roof[1][2]]
        self.area = sum(ax * by - bx * ay for (ax, ay), (bx, by) in self.edges()) / 2.0
        self.volume = signed_volume([(m, [(x - middle[0], y - middle[1], z) for x, y, z in points])
                                     for m, points in triangles])
        self.materials = collections.Counter(material for material, _ in triangles)
        self.is_box = corners == set(self.footprint) and len(corners) == 4

    def edges(self):
        return zip(self.footprint, self.footprint[1:] + self.footprint[:1])


def are_apart(a, b):
    """Whether a side of one of two convex footprints separates them."""
    for one, other in ((a, b), (b, a)):
        for (px, py), (qx, qy) in one.edges():  # counter-clockwise: outside is on the right
            if all((qx - px) * (y - py) - (qy - py) * (x - px) < 0.0 for x, y in other.footprint):
                return True
    return False


def check_bytes(generator, folder):
    """@return  a small town"""
    town = generate(generator, folder / "town.obj", "--triangles", "2002", "--seed", "7")
    again = generate(generator, folder / "again.obj", "--triangles", "2002", "--seed", "7")
    other = generate(generator, folder / "other.obj", "--triangles", "2002", "--seed", "8")
    check(town == again, "the same seed makes the same bytes")
    check(town != other, "another seed makes others")
    for asked, expected in ((2002, 2002), (2011, 2002), (12, 12), (300_000, 299_992)):
        text = generate(generator, folder / "count.obj", "--triangles", str(asked))
        count = text.count(b"\nf ")
        check(count == expected, f"{asked} triangles asked, {count} made")
    return town


def check_shapes(objects):
    ground = objects.pop("ground")
    check([m for m, _ in ground] == 2 * ["ground"], "the ground is one quadrangle")
    check(list(objects) == [f"building_{n:06d}" for n in range(1, 201)], "200 buildings, numbered")
    buildings = [Building(triangles) for triangles in objects.values()]
    check(all(b.is_box and b.materials == {"wall": 8, "roof": 2} for b in buildings),
          "each has four walls and a roof")
    # Coordinates are whole millimetres of tens of metres: volumes agree within rounding.
    check(all(abs(b.volume / (b.area * b.height) - 1.0) < 1e-9 for b in buildings),
          "all faces look outwards")
    check(all(are_apart(a, b) for a, b in itertools.combinations(buildings, 2)), "none overlap")
    return ground, buildings


def check_town(ground, buildings):
    low, high = (pick(c for _, points in ground for p in points for c in p[:2])
                 for pick in (min, max))
    check(all(low < c < high for b in buildings for p in b.footprint for c in p),
          "all stand on the ground")
    share = sum(b.area for b in buildings) / (high - low) ** 2
    check(0.30 <= share <= 0.40, f"{100 * share:.1f} % of the ground is built")
    heights = [b.height for b in buildings]
    check(4.0 <= min(heights) and max(heights) <= 60.0 and statistics.median(heights) < 12.0
          and max(heights) > 25.0, "most are low, of 4 to 60 m")


def check_program(program, town):
    if program is None or not program.exists():
        print("skipped the program, which is not built")
        return
    run = subprocess.run([program, "inspect", town, "--json", "--quiet"], capture_output=True)
    check(run.returncode == 0, "tenku inspect reads it")
    seen = json.loads(run.stdout or "{}")
    check(seen.get("findings") == [], "without a finding")
    check(seen.get("crs") == "EPSG:6680", "in EPSG:6680")
    place = seen.get("place") or {}
    # What the header promises, by PROJ 9.1: millimetres are 1e-8 degrees, the local origin is
    # whole metres.
    check(abs(place.get("latitude", 0) - 43.06) < 1e-5
          and abs(place.get("longitude", 0) - 141.35) < 1e-5, "at 43.06 N 141.35 E")
    check(seen.get("surface_types") == {"ground": 2, "wall": 1600, "roof": 400},
          "with the types of its surfaces")


def main():
    generator = pathlib.Path(sys.argv[1]) / "generate_cuboids.py"
    program = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(made)
        objects = read_objects(check_bytes(generator, folder))
        check_town(*check_shapes(objects))
        check_program(program, folder / "town.obj")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
