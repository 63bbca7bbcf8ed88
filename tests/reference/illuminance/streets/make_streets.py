#!/usr/bin/env python3
"""Makes streets.obj, streets.toml and sensors.pts: python3 make_streets.py FOLDER

6 x 6 blocks 8 to 30 m high, streets 10 to 16 m wide, one block with a courtyard. The same bytes at
every run. Needs nothing but Python 3.
"""

import math
import pathlib
import sys

BLOCK_X, STREET_X = (28, 34, 24, 38, 30, 26), (12, 16, 10, 14, 12)
BLOCK_Y, STREET_Y = (26, 32, 36, 24, 30, 34), (14, 10, 16, 12, 10)
HEIGHT = ((12, 22, 9, 18, 27, 15),   # [row, south to north][column, west to east], m
          (20, 8, 30, 14, 11, 24),
          (16, 26, 12, 19, 28, 10),
          (9, 18, 23, 29, 13, 21),
          (25, 14, 17, 8, 22, 30),
          (11, 28, 20, 15, 24, 13))
COURT = (3, 2)         # column and row of the block with a courtyard
COURT_DEPTH = 10       # of the building around it, m
MARGIN = 60            # of the ground around all blocks, m
REFLECTANCE = {"ground": 0.2, "wall": 0.5, "roof": 0.3}
OFF_WALL = 0.02        # of a sensor before a wall, m
SUN_ALTITUDE, SUN_AZIMUTH, SUN_ANGLE = 40.0, 210.0, 0.533  # degrees; the last is the disc's width


def spans(blocks, streets):
    """From and to of each block along one axis."""
    found, at = [], 0
    for size, street in zip(blocks, streets + (0,)):
        found.append((at, at + size))
        at += size + street
    return found


COLUMNS, ROWS = spans(BLOCK_X, STREET_X), spans(BLOCK_Y, STREET_Y)


def block(column, row):
    """x0, y0, x1, y1, height."""
    (x0, x1), (y0, y1) = COLUMNS[column], ROWS[row]
    return x0, y0, x1, y1, HEIGHT[row][column]


def court():
    x0, y0, x1, y1, height = block(*COURT)
    d = COURT_DEPTH
    return x0 + d, y0 + d, x1 - d, y1 - d, height


def level(x0, y0, x1, y1, z):
    return [(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)]


def walls(x0, y0, x1, y1, height):
    """Four walls that face outwards."""
    corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    return [[(*a, 0), (*b, 0), (*b, height), (*a, height)]
            for a, b in zip(corners, corners[1:] + corners[:1])]


def ring_roof(outer, inner):
    x0, y0, x1, y1, z = outer
    u0, v0, u1, v1, _ = inner
    return [level(x0, y0, x1, v0, z), level(x0, v1, x1, y1, z),
            level(x0, v0, u0, v1, z), level(u1, v0, x1, v1, z)]


def surfaces():
    """Material and polygon of every face."""
    yield "ground", level(-MARGIN, -MARGIN, COLUMNS[-1][1] + MARGIN, ROWS[-1][1] + MARGIN, 0)
    for row in range(6):
        for column in range(6):
            here = block(column, row)
            yield from (("wall", face) for face in walls(*here))
            if (column, row) == COURT:
                yield from (("wall", face[::-1]) for face in walls(*court()))
                yield from (("roof", face) for face in ring_roof(here, court()))
            else:
                yield "roof", level(*here)


def boxes():
    """Solids as corners; the block with the courtyard as four."""
    for row in range(6):
        for column in range(6):
            x0, y0, x1, y1, h = block(column, row)
            if (column, row) != COURT:
                yield x0, y0, x1, y1, h
                continue
            u0, v0, u1, v1, _ = court()
            yield from ((x0, y0, x1, v0, h), (x0, v1, x1, y1, h), (x0, v0, u0, v1, h),
                        (u1, v0, x1, v1, h))


def street_sensors():
    """Middle of streets and near their edges, 1.5 m up."""
    for k in range(5):
        (_, x), (next_x, _) = COLUMNS[k], COLUMNS[k + 1]
        (_, y), (next_y, _) = ROWS[k], ROWS[k + 1]
        yield (x + next_x) / 2, (y + next_y) / 2       # a crossing
        middle_y, middle_x = sum(ROWS[k]) / 2, sum(COLUMNS[k]) / 2
        yield (x + next_x) / 2, middle_y + 1           # a street from south to north
        yield x + 1.5, ROWS[k + 1][0] + 5
        yield middle_x - 2, (y + next_y) / 2           # a street from west to east
        yield COLUMNS[k + 1][0] + 7, y + 1


def facade_sensors():
    """On walls of some blocks, at several shares of their height."""
    for column, row in ((1, 1), (2, 1), (1, 3), (4, 2), (3, 4)):
        x0, y0, x1, y1, height = block(column, row)
        x, y = x0 + 0.4 * (x1 - x0), y0 + 0.6 * (y1 - y0)
        sides = ((x, y0 - OFF_WALL, 0, -1), (x1 + OFF_WALL, y, 1, 0), (x, y1 + OFF_WALL, 0, 1),
                 (x0 - OFF_WALL, y, -1, 0))
        for k, (px, py, nx, ny) in enumerate(sides):
            for share in (0.12, 0.5, 0.9) if k % 2 == 0 else (0.3, 0.7):
                yield px, py, round(share * height, 3), nx, ny, 0


def court_sensors():
    x0, y0, x1, y1, height = court()
    x, y = (x0 + x1) / 2, (y0 + y1) / 2
    for px, py in ((x, y), (x0 + 2, y), (x, y1 - 2), (x1 - 1, y0 + 1)):
        yield px, py, 1.5, 0, 0, 1
    for z in (2, 0.5 * height, height - 2):
        yield x + 1, y0 + OFF_WALL, z, 0, 1, 0
        yield x1 - OFF_WALL, y + 1, z, -1, 0, 0
        yield x - 1, y1 - OFF_WALL, z, 0, -1, 0


def sensors():
    yield from ((x, y, 1.5, 0, 0, 1) for x, y in street_sensors())
    yield from facade_sensors()
    yield from court_sensors()


def sun_direction(off=(0.0, 0.0)):
    """Unit vector to a point of the disc, `off` radians from its centre up and sideways."""
    altitude, azimuth = math.radians(SUN_ALTITUDE), math.radians(SUN_AZIMUTH)
    sa, ca, sz, cz = math.sin(altitude), math.cos(altitude), math.sin(azimuth), math.cos(azimuth)
    to = [ca * sz - off[0] * sa * sz - off[1] * cz, ca * cz - off[0] * sa * cz + off[1] * sz,
          sa + off[0] * ca]
    length = math.sqrt(sum(c * c for c in to))
    return [c / length for c in to]


def is_blocked(point, to):
    """Whether a solid stands between the point and the sky (slabs of each box)."""
    for x0, y0, x1, y1, h in boxes():
        near, far = 0.0, math.inf
        for p, d, low, high in zip(point, to, (x0, y0, -1.0), (x1, y1, h)):
            if d == 0.0:
                near, far = (near, far) if low < p < high else (1.0, 0.0)
                continue
            a, b = sorted(((low - p) / d, (high - p) / d))
            near, far = max(near, a), min(far, b)
        if near < far:
            return True
    return False


def sees_part_of_the_sun(sensor):
    radius = 2.0 * math.radians(SUN_ANGLE / 2)  # twice the disc: well clear of the penumbra
    rim = [(radius * math.cos(t), radius * math.sin(t)) for t in
           (2 * math.pi * k / 32 for k in range(32))]
    seen = {is_blocked(sensor[:3], sun_direction(off)) for off in [(0, 0)] + rim}
    return len(seen) > 1


def write_obj(path):
    with open(path, "w") as out:
        out.write("# 6 x 6 blocks and a ground; z up, metres; made by make_streets.py\n")
        last, count = None, 0
        for material, corners in surfaces():
            if material != last:
                out.write(f"usemtl {material}\n")
            last = material
            out.writelines("v {:g} {:g} {:g}\n".format(*corner) for corner in corners)
            out.write("f " + " ".join(str(count + k) for k in range(1, 5)) + "\n")
            count += 4


def main():
    folder = pathlib.Path(sys.argv[1])
    write_obj(folder / "streets.obj")
    (folder / "streets.toml").write_text("".join(
        f"[{name}]\nreflectance = {value}\n" for name, value in REFLECTANCE.items()))
    chosen = [s for s in sensors() if not sees_part_of_the_sun(s)]
    (folder / "sensors.pts").write_text("".join(
        "{:g} {:g} {:g} {} {} {}\n".format(*s) for s in chosen))
    print(len(chosen), "sensors,", len(list(sensors())) - len(chosen), "left out in the penumbra")


if __name__ == "__main__":
    main()
