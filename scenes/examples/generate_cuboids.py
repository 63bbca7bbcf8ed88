#!/usr/bin/env python3
"""Makes a large town of randomly placed cuboids: generate_cuboids.py --out FILE.obj [--triangles N]

The scene on which S. Takada, Y. Dobashi and T. Yamamoto, "A fast method for rendering townscape
images with skylight", section 5, try their method: randomly placed cuboids of about 300,000
polygons. They say no more of it, so sizes and heights are chosen here: 23 m of ground to a
building, 36 % of it built, heights of 4 to 60 m of which half are below 10 m.

A cuboid has 10 triangles, four walls and a roof: its floor would lie on the ground, two surfaces
in one place, and nothing sees it. N is reached but for what is left of a cuboid, 9 at most; two of
the triangles are the ground. The same options give the same bytes. Needs nothing but Python 3.
"""

import argparse
import math
import pathlib
import random

PLOT_M = 23.0             # side of a building's plot, where --side says nothing else
SIDES = (0.45, 0.75)      # of a building, as a share of the plot's: 0.6 squared is built
TURN_DEG = 20.0           # at most, to either side; the largest then still fits the plot
MARGIN = 0.01             # of the plot, left free all round
LOWEST_M, HIGHEST_M, DECAY_M = 4.0, 60.0, 8.0  # heights fall off exponentially
TRIANGLES_EACH, GROUND_TRIANGLES = 10, 2

# EPSG:6680 of 43.06 N 141.35 E, where the sample town is; the middle of the ground is there.
HEADER = """# Townscape of {buildings} cuboids, {triangles} triangles, seed {seed}
# x = Easting + 73308.302, y = Northing + 104033.316, z = height; EPSG:6680
"""
GROUND = """o ground
usemtl ground
v {low:.3f} {low:.3f} 0
v {high:.3f} {low:.3f} 0
v {high:.3f} {high:.3f} 0
v {low:.3f} {high:.3f} 0
f 1 2 3
f 1 3 4
"""
# Relative to the eight vertices just written: -8 to -5 the base, -4 to -1 the roof, each
# counter-clockwise from above.
FACES = """usemtl wall
f -8 -7 -3
f -8 -3 -4
f -7 -6 -2
f -7 -2 -3
f -6 -5 -1
f -6 -1 -2
f -5 -8 -4
f -5 -4 -1
usemtl roof
f -4 -3 -2
f -4 -2 -1
"""


def height_m(share):
    """Height below which `share` of the buildings stay: a truncated exponential distribution."""
    whole = -math.expm1((LOWEST_M - HIGHEST_M) / DECAY_M)
    return LOWEST_M - DECAY_M * math.log1p(-share * whole)


def cuboid(chance, plot_x, plot_y, plot_m):
    """Corners (x, y), counter-clockwise, and height of a cuboid inside the plot with that corner.

    @param chance  gives a number in [0, 1) a call
    """
    width, depth = (plot_m * (SIDES[0] + (SIDES[1] - SIDES[0]) * chance()) for _ in range(2))
    turn = math.radians(TURN_DEG) * (2.0 * chance() - 1.0)
    ux, uy = math.cos(turn), math.sin(turn)
    reach_x = (width * ux + depth * abs(uy)) / 2.0
    reach_y = (width * abs(uy) + depth * ux) / 2.0
    x, y = (corner + plot_m / 2.0 +
            (plot_m * (0.5 - MARGIN) - reach) * (2.0 * chance() - 1.0)
            for corner, reach in ((plot_x, reach_x), (plot_y, reach_y)))
    half = [(s * width / 2.0, t * depth / 2.0) for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return [(x + a * ux - b * uy, y + a * uy + b * ux) for a, b in half], height_m(chance())


def building_text(number, corners, height):
    base = "".join(f"v {x:.3f} {y:.3f} 0\n" for x, y in corners)
    top = "".join(f"v {x:.3f} {y:.3f} {height:.3f}\n" for x, y in corners)
    return f"o building_{number:06d}\n{base}{top}{FACES}"


def chosen_plots(chance, plots, wanted):
    """`wanted` of the numbers 0 .. plots - 1, each set of them as likely as any, in order."""
    for plot in range(plots):
        if chance() * (plots - plot) < wanted:
            wanted -= 1
            yield plot


def town_text(triangles, seed, side_m=None):
    """The OBJ file; `side_m` is that of the square of ground, metres.

    Every building has a plot of its own in a square grid; the few plots too many stay empty.
    """
    buildings = (triangles - GROUND_TRIANGLES) // TRIANGLES_EACH
    across = math.isqrt(buildings - 1) + 1
    side_m = side_m or PLOT_M * across
    chance, plot_m, low = random.Random(seed).random, side_m / across, -side_m / 2.0
    parts = [HEADER.format(buildings=buildings, seed=seed,
                           triangles=TRIANGLES_EACH * buildings + GROUND_TRIANGLES),
             GROUND.format(low=low, high=-low)]
    for number, plot in enumerate(chosen_plots(chance, across * across, buildings), 1):
        row, column = divmod(plot, across)
        corners, height = cuboid(chance, low + column * plot_m, low + row * plot_m, plot_m)
        parts.append(building_text(number, corners, height))
    return "".join(parts)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--triangles", type=int, default=300_000, help="at least 12")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--side", type=float, metavar="M",
                        help=f"of the square of ground, metres (default: {PLOT_M:g} m a plot)")
    parser.add_argument("--out", type=pathlib.Path, required=True, metavar="FILE.obj")
    options = parser.parse_args()
    if options.triangles < TRIANGLES_EACH + GROUND_TRIANGLES:
        parser.error(f"--triangles {options.triangles}: a cuboid and the ground have 12")
    if options.side is not None and not 0.0 < options.side < math.inf:
        parser.error(f"--side {options.side}: must be positive")
    options.out.write_bytes(town_text(options.triangles, options.seed, options.side).encode())


if __name__ == "__main__":
    main()
