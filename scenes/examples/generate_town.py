#!/usr/bin/env python3
"""Makes the sample town, sapporo_town.city.json: python3 generate_town.py [--seed N] [--out FILE]

An invented town quarter on real coordinates: EPSG:6680 (JGD2011 / Japan Plane Rectangular CS XII),
coordinates in the file as easting, northing, height above sea level. The middle of the town is at
43.06 N 141.35 E, which the Gauss-Krueger formulas (K. Kawase, Bulletin of the Geospatial
Information Authority of Japan 59, 2011) put at 73308.302 m west and 104033.316 m south of the
origin of zone XII. The same seed gives the same bytes. Needs nothing but Python 3.
"""

import argparse
import math
import pathlib
import random

import town_geometry as tg
from town_layout import (MIDDLE, X_STREETS, Y_STREETS, class_at, grid_lines, height_at, BASIN,
                         WATER_LEVEL)

ORIGIN = (-73308.302, -104033.316)  # EPSG:6680, of the middle of the town
TURN_DEG = 9.0                      # the street grid, counter-clockwise from true east
CURB, STOREY = 0.12, 3.2


class Town:
    def __init__(self, seed):
        self.random = random.Random(seed)
        self.city = tg.CityJson(ORIGIN, TURN_DEG)
        self.trees = 0
        for template in tg.tree_templates():
            self.city.add_template(template)

    def between(self, low, high):
        return low + (high - low) * self.random.random()

    def local(self, faces):
        """Faces about the middle of the town."""
        return [(s, [[(x - MIDDLE[0], y - MIDDLE[1], z) for x, y, z in ring] for ring in rings])
                for s, rings in faces]

    # ---- ground -------------------------------------------------------------------------------

    def add_ground(self):
        xs, ys = grid_lines()
        terrain, roads = {}, {}
        for i in range(len(xs) - 1):
            for j in range(len(ys) - 1):
                self.add_cell(xs[i:i + 2], ys[j:j + 2], terrain, roads)
                self.add_step((xs[i], ys[j]), (xs[i], ys[j + 1]), terrain)
                self.add_step((xs[i + 1], ys[j]), (xs[i], ys[j]), terrain)
        for name, faces in sorted(terrain.items()):
            self.city.add("terrain-" + name, "TINRelief",
                          [self.city.geometry("CompositeSurface", "1", self.local(faces))])
        for name, faces in sorted(roads.items()):
            self.city.add(name, "Road",
                          [self.city.geometry("MultiSurface", "1", self.local(faces))])
        x0, y0, x1, y1 = BASIN
        basin = [("WaterSurface", [tg.at([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], WATER_LEVEL)])]
        self.city.add("basin", "WaterBody",
                      [self.city.geometry("MultiSurface", "1", self.local(basin))])

    def add_cell(self, x, y, terrain, roads):
        kind = class_at((x[0] + x[1]) / 2, (y[0] + y[1]) / 2)
        if kind == "water":
            return
        drop = CURB if kind.startswith("road") else 0.0
        a, b, c, d = [(px, py, height_at(px, py) - drop)
                      for px, py in ((x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1]))]
        if drop:
            roads.setdefault(kind, []).extend([("TrafficArea", [[a, b, c]]),
                                               ("TrafficArea", [[a, c, d]])])
        else:
            terrain.setdefault(kind, []).extend([(None, [[a, b, c]]), (None, [[a, c, d]])])

    def add_step(self, p, q, terrain):
        """The curb or quay between the cells right and left of the grid edge p -> q, if any."""
        (px, py), (qx, qy) = p, q
        nx, ny = (qy - py), (px - qx)  # to the right, as long as the edge
        k = 0.01 / math.hypot(nx, ny)
        mx, my = (px + qx) / 2, (py + qy) / 2
        right, left = class_at(mx + k * nx, my + k * ny), class_at(mx - k * nx, my - k * ny)

        def level(kind, x, y):
            if kind == "water":
                return WATER_LEVEL - 0.3
            return height_at(x, y) - (CURB if kind.startswith("road") else 0.0)

        if "outside" in (right, left) or abs(level(right, *p) - level(left, *p)) < 0.01:
            return
        if level(right, *p) > level(left, *p):
            p, q, right, left = q, p, left, right  # now the lower side is on the right
        a, b = (*p, level(right, *p)), (*q, level(right, *q))
        c, d = (*q, level(left, *q)), (*p, level(left, *p))
        terrain.setdefault("pavement", []).extend([(None, [[a, b, c]]), (None, [[a, c, d]])])

    # ---- buildings ----------------------------------------------------------------------------

    def add_building(self, name, faces, lod1, attributes, kind="Building", parent=None):
        geometry = [self.city.geometry("Solid", "1", self.local(lod1)),
                    self.city.geometry("Solid", "2", self.local(faces))]
        self.city.add(name, kind, geometry, attributes, parent)

    def levels(self, footprint):
        """Bottom of the solid, below the lowest ground, and the floor, above the highest."""
        heights = [height_at(x, y) for x, y in footprint]
        return min(heights) - 0.5, max(heights) + 0.15

    def add_house(self, name, footprint, storeys, roof, front=2, sides=0):
        """A house with its door in the first wall; `sides`: windows a storey in the side walls."""
        bottom, floor = self.levels(footprint)
        eaves = floor + 2.9 * storeys + self.between(0.0, 0.5)
        width, depth = math.dist(*footprint[:2]), math.dist(*footprint[1:3])
        ridge = eaves + math.tan(math.radians(self.between(34, 42))) * depth / 2
        openings = [[], [], [], []]
        for storey in range(storeys):
            sill = floor + 2.9 * storey + 0.9
            for i, count in enumerate((front, sides, front - 1, sides)):
                length = depth if i % 2 else width
                glass = 1.9 if i == 2 else 1.15
                row = tg.window_row(length, count, glass, sill, sill + 1.4) if count else []
                if storey == 0 and i == 0:
                    row[0] = ("Door", row[0][1], floor + 0.05, row[0][1] + 1.05, floor + 2.15)
                openings[i] += row
        make = tg.gabled if roof == "gabled" else tg.hipped
        faces = make(footprint, bottom, eaves, ridge, openings)
        lod1 = tg.block(footprint, bottom, (eaves + ridge) / 2)
        self.add_building(name, faces, lod1, {"function": "residential", "roofType": roof,
                                              "storeysAboveGround": storeys,
                                              "measuredHeight": round(ridge - floor, 2)})
        if roof == "gabled" and self.random.random() < 0.6:
            self.add_chimney(name, footprint, eaves, ridge)

    def add_chimney(self, parent, footprint, eaves, ridge):
        u = tg.unit(*footprint[:2])
        corner = tg.add(tg.add(footprint[0], u, self.between(0.6, 1.2)), tg.left_of(u),
                        math.dist(*footprint[1:3]) / 2 + 0.4)
        stack = tg.block(tg.rectangle(corner, u, 0.7, 0.7), eaves + 0.3, ridge + 0.9)
        stack = [("RoofSurface" if s == "RoofSurface" else "WallSurface", r) for s, r in stack]
        self.city.add(parent + "-chimney", "BuildingInstallation",
                      [self.city.geometry("Solid", "2", self.local(stack))], None, parent)

    def add_row(self, name, start, u, count, width, depth):
        """Terraced houses, from `start` along u, their doors to the right of u."""
        for i in range(count):
            footprint = tg.rectangle(tg.add(start, u, i * width), u, width, depth)
            self.add_house(f"{name}-{i + 1}", footprint, 2 + (self.random.random() < 0.25),
                           "gabled")

    def add_villa(self, name, corner, front_u, width, depth):
        footprint = tg.rectangle(corner, front_u, width, depth)
        roof = "hipped" if self.random.random() < 0.6 else "gabled"
        self.add_house(name, footprint, 2, roof, front=3, sides=1)

    def add_offices(self, name, footprint, storeys, window=None, storey=3.6, attributes=None):
        """Flat roof with a parapet, a plant room on it; ribbon windows, or of the width `window`."""
        bottom, floor = self.levels(footprint)
        roof = floor + storey * storeys + 0.3
        openings = []
        for p, q in zip(footprint, footprint[1:] + footprint[:1]):
            length = math.dist(p, q)
            count = round((length - 1.2) / (window + 2.2)) if window else 1
            rows = [tg.window_row(length, count, window or length - 1.6, floor + k * storey + 0.9,
                                  floor + k * storey + 2.8, 0.6) for k in range(storeys)]
            openings.append([w for row in rows for w in row])
        faces = tg.flat_with_parapet(footprint, bottom, roof, 0.9, openings)
        self.add_building(name, faces, tg.block(footprint, bottom, roof),
                          attributes or {"function": "offices", "roofType": "flat",
                                         "storeysAboveGround": storeys,
                                         "measuredHeight": round(roof + 0.9 - floor, 2)})
        u = tg.unit(*footprint[:2])
        corner = tg.add(tg.add(footprint[0], u, 4.0), tg.left_of(u), 3.5)
        self.add_plant_room(name, tg.rectangle(corner, u, 6.0, 4.0), roof)

    def add_plant_room(self, parent, footprint, roof):
        faces = tg.block(footprint, roof - 0.1, roof + 2.6)
        faces = [("WallSurface" if s == "GroundSurface" else s, r) for s, r in faces]
        self.city.add(parent + "-plant", "BuildingInstallation",
                      [self.city.geometry("Solid", "2", self.local(faces))], None, parent)

    def add_courtyard_block(self, name, corner, width, depth, wing):
        outer = tg.rectangle(corner, (1.0, 0.0), width, depth)
        inner = tg.inset(outer, wing)
        bottom, floor = self.levels(outer)
        eaves, storeys = floor + 4 * STOREY + 0.4, 4
        ridge = eaves + 0.6 * wing / 2
        sides = []
        for ring in (outer, inner):
            for p, q in zip(ring, ring[1:] + ring[:1]):
                length = math.dist(p, q)
                rows = [tg.window_row(length, int(length // 5.6), 1.6, floor + k * STOREY + 0.8,
                                      floor + k * STOREY + 2.5) for k in range(storeys)]
                sides.append([w for row in rows for w in row])
        faces = tg.perimeter_block(outer, inner, bottom, eaves, ridge, sides[:4], sides[4:])
        lod1 = tg.block(outer, bottom, (eaves + ridge) / 2, [inner])
        self.add_building(name, faces, lod1, {"function": "residential", "roofType": "ring",
                                              "storeysAboveGround": storeys,
                                              "measuredHeight": round(ridge - floor, 2)})

    def add_tower(self, name, podium, shaft, storeys):
        bottom, floor = self.levels(podium)
        self.city.add(name, "Building", [], {"function": "offices", "storeysAboveGround": storeys})
        base_top = floor + 9.0
        openings = []
        for p, q in zip(podium, podium[1:] + podium[:1]):
            length = math.dist(p, q)
            openings.append(tg.window_row(length, int(length // 6), 4.8, floor + 0.4, floor + 4.2)
                            + tg.window_row(length, int(length // 6), 4.8, floor + 5.2,
                                            floor + 8.0))
        self.add_building(name + "-podium",
                          tg.flat_with_parapet(podium, bottom, base_top, 0.9, openings),
                          tg.block(podium, bottom, base_top), {"storeysAboveGround": 2},
                          "BuildingPart", name)
        top = base_top + 3.9 * (storeys - 2)
        openings = []
        for p, q in zip(shaft, shaft[1:] + shaft[:1]):
            length = math.dist(p, q)
            count = max(1, int(length // 5))
            rows = [tg.window_row(length, count, (length - 0.5) / count - 0.22,
                                  base_top + k * 3.9 + 0.5, base_top + k * 3.9 + 3.7, 0.25)
                    for k in range(storeys - 2)]
            openings.append([w for row in rows for w in row])
        self.add_building(name + "-shaft",
                          tg.flat_with_parapet(shaft, base_top - 0.3, top, 1.4, openings),
                          tg.block(shaft, base_top - 0.3, top),
                          {"storeysAboveGround": storeys - 2,
                           "measuredHeight": round(top + 1.4 - floor, 2)}, "BuildingPart", name)
        centre = [sum(p[i] for p in shaft) / len(shaft) for i in (0, 1)]
        self.add_plant_room(name + "-shaft",
                            tg.rectangle((centre[0] - 5, centre[1] - 4), (1.0, 0.0), 10, 8), top)

    def add_clock_hall(self, name, corner):
        """A timber hall with a clock tower, as Sapporo has one."""
        u = (1.0, 0.0)
        hall = tg.rectangle(corner, u, 22.0, 11.0)
        tower = tg.rectangle(tg.add(tg.add(corner, u, 9.2), (0.0, 1.0), -1.6), u, 3.6, 3.6)
        bottom, floor = self.levels(hall + tower)
        self.city.add(name, "Building", [], {"function": "assembly"})
        rows = [tg.window_row(22.0, 7, 1.2, floor + z, floor + z + 2.0) for z in (0.9, 4.3)]
        # No windows in the hall where the tower stands before it.
        front = [w for row in rows for w in row if not 7.5 < w[1] < 13.5]
        ends = tg.window_row(11.0, 3, 1.2, floor + 0.9, floor + 2.9)
        faces = tg.gabled(hall, bottom, floor + 7.2, floor + 11.4,
                          [front, ends, [w for row in rows for w in row], ends])
        self.add_building(name + "-hall", faces, tg.block(hall, bottom, floor + 9.3),
                          {"roofType": "gabled"}, "BuildingPart", name)
        door = [("Door", 1.0, floor + 0.05, 2.6, floor + 2.6)]
        light = [("Window", 1.2, floor + 13.4, 2.4, floor + 14.6)]
        faces = tg.hipped(tower, bottom, floor + 15.4, floor + 19.0,
                          [door + light, light, light, light])
        self.add_building(name + "-tower", faces, tg.block(tower, bottom, floor + 16.6),
                          {"roofType": "pyramid"}, "BuildingPart", name)

    # ---- bridge and trees ---------------------------------------------------------------------

    def add_footbridge(self, x, width, y0, y1, rise):
        ends = [height_at(x, y) + 0.04 for y in (y0, y1)]
        stations = []
        for k in range(11):
            t = k / 10
            stations.append((y0 + t * (y1 - y0),
                             ends[0] + t * (ends[1] - ends[0]) + rise * 4 * t * (1 - t)))
        faces = tg.arched_bridge(x - width / 2, width, stations)
        self.city.add("footbridge", "Bridge",
                      [self.city.geometry("Solid", "2", self.local(faces))],
                      {"function": "footbridge"})

    def add_tree(self, x, y, kind=None, size=1.0):
        kind = kind if kind is not None else (0, 0, 1, 2)[int(4 * self.random.random())]
        height = size * self.between(*((7, 10), (8, 11), (9, 14))[kind])
        radius = height * self.between(*((0.32, 0.42), (0.22, 0.28), (0.2, 0.26))[kind])
        self.trees += 1
        foot = (x - MIDDLE[0], y - MIDDLE[1], height_at(x, y))
        self.city.add(f"tree-{self.trees}", "SolitaryVegetationObject",
                      [self.city.instance(kind, foot, radius, height, self.between(0, 6.28))],
                      {"species": ("maple", "linden", "spruce")[kind]})

    def add_tree_row(self, start, end, spacing, kind, size=0.85):
        length = math.dist(start, end)
        for k in range(int(length // spacing) + 1):
            self.add_tree(*tg.add(start, tg.unit(start, end), k * spacing), kind, size)

    def scatter_trees(self, box, count, distance, kind=None):
        """Trees at least `distance` apart; gives up quietly where there is no more room."""
        x0, y0, x1, y1 = box
        placed = []
        for _ in range(40 * count):
            p = (self.between(x0, x1), self.between(y0, y1))
            if len(placed) < count and all(math.dist(p, q) >= distance for q in placed):
                placed.append(p)
                self.add_tree(*p, kind)

    # ---- the plan of the town -----------------------------------------------------------------

    def build(self):
        self.add_ground()
        east, west = (1.0, 0.0), (-1.0, 0.0)
        for name, x0, count in (("canal-row-w", 14.0, 9), ("canal-row-m", 98.0, 9)):
            self.add_row(name + "-s", (x0 + 1.0, 77.0), east, count, 7.0, 10.0)
            self.add_row(name + "-n", (x0 + 64.0, 127.0), west, count, 7.0, 10.0)
            self.scatter_trees((x0 + 4, 94, x0 + 60, 110), 6, 9.0)
        for name, y0, y1 in (("canal-row-e", 77.0, 127.0), ("east-row", 148.0, 200.0)):
            self.add_row(name + "-s", (275.0, y0), east, 7, 7.4, 10.0)
            self.add_row(name + "-n", (326.8, y1), west, 7, 7.4, 10.0)
            self.scatter_trees((278, y0 + 16, 324, y1 - 16), 5, 9.0)
        for row, (y_south, y_north) in enumerate(((148.0, 200.0), (222.0, 270.0))):
            for k in range(4):
                shift = self.between(-1.0, 1.0)
                self.add_villa(f"villa-{row}-s{k + 1}", (16.0 + 17.0 * k + shift, y_south), east,
                               11.5, 9.0)
                self.add_villa(f"villa-{row}-n{k + 1}", (27.5 + 17.0 * k + shift, y_north), west,
                               11.5, 9.0)
            self.scatter_trees((16, y_south + 13, 78, y_north - 13), 7, 8.0)
        self.build_centre()
        self.build_green()

    def build_centre(self):
        east = (1.0, 0.0)
        flats = {"function": "residential", "roofType": "flat", "storeysAboveGround": 5}
        self.add_offices("flats-w", tg.rectangle((192, 80), east, 14, 44), 5, 2.4, 3.1, flats)
        self.add_offices("flats-e", tg.rectangle((240, 80), east, 14, 44), 5, 2.4, 3.1, flats)
        self.add_courtyard_block("courtyard-block", (101.0, 149.0), 60.0, 50.0, 11.0)
        l_shape = [(192, 148), (254, 148), (254, 164), (208, 164), (208, 198), (192, 198)]
        self.add_offices("offices-l", l_shape, 6)
        self.add_offices("offices-slab", tg.rectangle((224, 180), east, 30, 16), 8)
        self.add_offices("offices-east", tg.rectangle((278, 224), east, 40, 16), 5)
        podium = tg.rectangle((194, 224), east, 58, 44)
        shaft = [(208, 235), (212, 231), (234, 231), (238, 235), (238, 257), (234, 261),
                 (212, 261), (208, 257)]
        self.add_tower("glass-tower", podium, shaft, 18)
        self.add_clock_hall("clock-hall", (120.0, 246.0))

    def build_green(self):
        self.add_footbridge(177.0, 3.6, 33.0, 57.0, 1.1)
        self.add_tree_row((168.5, 80.0), (168.5, 268.0), 18.0, 1)
        self.add_tree_row((185.5, 80.0), (185.5, 268.0), 18.0, 1)
        self.add_tree_row((18.0, 58.5), (165.0, 58.5), 16.0, 0, 0.7)
        self.add_tree_row((190.0, 58.5), (326.0, 58.5), 16.0, 0, 0.7)
        self.scatter_trees((0, -6, 168, 30), 18, 10.0)
        self.scatter_trees((186, -6, 342, 30), 17, 10.0)
        self.scatter_trees((114, 163, 148, 185), 5, 8.0, 0)
        self.scatter_trees((98, 222, 164, 240), 9, 8.0)
        self.scatter_trees((98, 262, 164, 271), 6, 8.0)
        self.scatter_trees((276, 246, 328, 270), 9, 9.0)
        self.scatter_trees((210, 84, 236, 122), 6, 8.0, 0)
        for box in ((-30, -20, -8, 300), (350, -20, 372, 300), (10, 294, 330, 314)):
            self.scatter_trees(box, 6, 14.0)


METADATA = {
    "identifier": "sapporo_town",
    "referenceDate": "2026-01-01",
    "referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/6680",
    "title": "An invented town on the coordinates of Sapporo",
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=1)
    here = pathlib.Path(__file__).resolve().parent
    parser.add_argument("--out", type=pathlib.Path, default=here / "sapporo_town.city.json")
    options = parser.parse_args()
    town = Town(options.seed)
    town.build()
    options.out.write_bytes(town.city.text(METADATA).encode())


if __name__ == "__main__":
    main()
