"""Where streets, blocks, the park and the canal basin are, and how high the ground is.

The town's own frame: metres, x along the canal, y away from it, origin in one corner.
"""

import math

SIZE = (342.0, 286.0)
MIDDLE = (171.0, 143.0)
MARGIN = 36.0               # meadow about the town
SURROUNDINGS = 12.0         # height of the land about it, reached at the edge of the meadow
WATER_LEVEL = 12.5
BASIN = (20.0, 38.0, 322.0, 52.0)

# Streets from house front to house front: (from, to, width of a pavement).
X_STREETS = {"road-west": (0.0, 12.0, 3.0), "road-maple": (82.0, 96.0, 3.0),
             "road-main": (166.0, 188.0, 5.0), "road-linden": (258.0, 272.0, 3.0),
             "road-east": (330.0, 342.0, 3.0)}
Y_STREETS = {"road-quay": (60.0, 74.0, 3.0), "road-second": (130.0, 144.0, 3.0),
             "road-third": (204.0, 218.0, 3.0), "road-north": (274.0, 286.0, 3.0)}


def smooth(t):
    t = min(1.0, max(0.0, t))
    return t * t * (3.0 - 2.0 * t)


def height_at(x, y):
    """Height of the ground without curbs: it rises gently from the canal to the north."""
    cx, cy = min(SIZE[0], max(0.0, x)), min(SIZE[1], max(0.0, y))
    core = (14.0 + 4.5 * smooth((cy - 40.0) / (SIZE[1] - 40.0)) + 0.5 * math.sin(cx / 75.0)
            + 0.3 * math.sin(cy / 48.0 + cx / 110.0))
    outside = max(abs(x - cx), abs(y - cy)) / MARGIN
    return core + (SURROUNDINGS - core) * smooth(outside)


def carriageway(streets, value):
    """The street whose carriageway, between the pavements, holds `value`."""
    for name, (start, end, pavement) in streets.items():
        if start + pavement < value < end - pavement:
            return name
    return None


def is_lawn(x, y):
    """The meadow about the town, the bank across the basin, the park."""
    if not (0.0 < x < SIZE[0] and 34.0 < y < SIZE[1]):
        return True
    return 96.0 < x < 166.0 and 218.0 < y < 274.0


def is_in_block(x, y):
    return not any(start < v < end for v, streets in ((x, X_STREETS), (y, Y_STREETS))
                   for start, end, _ in streets.values())


def class_at(x, y):
    """`outside`, `water`, the name of a road, `lawn`, `lot` or `pavement`."""
    if not (-MARGIN < x < SIZE[0] + MARGIN and -MARGIN < y < SIZE[1] + MARGIN):
        return "outside"
    if BASIN[0] < x < BASIN[2] and BASIN[1] < y < BASIN[3]:
        return "water"
    if is_lawn(x, y):
        return "lawn"
    in_streets_x = 3.0 < x < SIZE[0] - 3.0
    in_streets_y = Y_STREETS["road-quay"][0] + 3.0 < y < SIZE[1] - 3.0
    road = None
    if in_streets_x and in_streets_y:
        road = carriageway(X_STREETS, x) or carriageway(Y_STREETS, y)
    if road:
        return road
    return "lot" if y > Y_STREETS["road-quay"][1] and is_in_block(x, y) else "pavement"


def subdivided(values, pitch):
    """The sorted values with equal steps of at most `pitch` between them."""
    values = sorted(values)
    result = values[:1]
    for low, high in zip(values, values[1:]):
        steps = math.ceil((high - low) / pitch - 1e-9)
        result += [low + (high - low) * k / steps for k in range(1, steps + 1)]
    return result


def grid_lines():
    """Lines of the terrain grid in x and y: every edge of the layout, and steps between."""
    xs = {-MARGIN, SIZE[0] + MARGIN, BASIN[0], BASIN[2]}
    ys = {-MARGIN, 0.0, 34.0, SIZE[1] + MARGIN, BASIN[1], BASIN[3]}
    for lines, streets in ((xs, X_STREETS), (ys, Y_STREETS)):
        for start, end, pavement in streets.values():
            lines |= {start, start + pavement, end - pavement, end}
    return subdivided(xs, 20.0), subdivided(ys, 20.0)
