#!/usr/bin/env python3
"""Hangs flat glass panels before the walls of buildings of a CityJSON file.

generate_panels.py IN.city.json OUT.city.json [--panels 500] [--width 1.5] [--height 1.5]
                   [--gap 0.1] [--off 0.05]

The walls of the highest buildings are covered first, widest wall first, with panels in rows and
columns. Each panel is an object of its own, `glass_1`, `glass_2` ..., a window; give
them a mirror by a materials file that names the surface type:

    [window]
    mirror = 0.2
"""

import argparse
import json
import math


def minus(a, b):
    return [a[k] - b[k] for k in range(3)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def length(a):
    return math.sqrt(sum(x * x for x in a))


def vertices_of(city):
    transform = city.get("transform", {"scale": [1, 1, 1], "translate": [0, 0, 0]})
    return [[v[k] * transform["scale"][k] + transform["translate"][k] for k in range(3)]
            for v in city["vertices"]]


def rings_of(geometry):
    """Outer rings of all surfaces."""
    if geometry["type"] == "Solid":
        return [surface[0] for shell in geometry["boundaries"] for surface in shell]
    if geometry["type"] in ("MultiSurface", "CompositeSurface"):
        return [surface[0] for surface in geometry["boundaries"]]
    return []


def walls_of(city, points):
    """Upright rectangles: lower left corner, way along, width, height, outer normal."""
    for thing in city["CityObjects"].values():
        if not thing["type"].startswith("Building"):
            continue
        for geometry in thing.get("geometry", []):
            for ring in rings_of(geometry):
                corners = [points[v] for v in ring]
                if len(corners) != 4:
                    continue
                normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[1]))
                size = length(normal)
                if size < 1.0 or abs(normal[2]) > 0.01 * size:
                    continue
                normal = [normal[0] / size, normal[1] / size, 0.0]
                along = [-normal[1], normal[0], 0.0]
                reach = [sum(p[k] * along[k] for k in range(2)) for p in corners]
                low, high = min(p[2] for p in corners), max(p[2] for p in corners)
                wide, tall = max(reach) - min(reach), high - low
                if abs(wide * tall - size) > 0.05 * size:
                    continue  # not a rectangle
                start = corners[reach.index(min(reach))]
                yield {"start": [start[0], start[1], low], "along": along, "width": wide,
                       "height": tall, "normal": normal}


def panels_on(wall, args):
    columns = int((wall["width"] - args.gap) / (args.width + args.gap))
    rows = int((wall["height"] - args.gap) / (args.height + args.gap))
    for row in range(rows):
        for column in range(columns):
            x0 = args.gap + column * (args.width + args.gap)
            z0 = args.gap + row * (args.height + args.gap)
            yield [[wall["start"][k] + args.off * wall["normal"][k] + x * wall["along"][k]
                    + (z if k == 2 else 0.0) for k in range(3)]
                   for x, z in ((x0, z0), (x0 + args.width, z0),
                                (x0 + args.width, z0 + args.height), (x0, z0 + args.height))]


def add_panels(city, panels):
    transform = city.setdefault("transform", {"scale": [0.001] * 3, "translate": [0, 0, 0]})
    for number, panel in enumerate(panels, 1):
        first = len(city["vertices"])
        city["vertices"] += [[round((p[k] - transform["translate"][k]) / transform["scale"][k])
                              for k in range(3)] for p in panel]
        city["CityObjects"][f"glass_{number}"] = {
            "type": "GenericCityObject",
            "geometry": [{"type": "MultiSurface", "lod": "2",
                          "boundaries": [[[first, first + 1, first + 2, first + 3]]],
                          "semantics": {"surfaces": [{"type": "Window"}], "values": [0]}}]}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("input")
    parser.add_argument("output")
    parser.add_argument("--panels", type=int, default=500)
    parser.add_argument("--width", type=float, default=1.5)
    parser.add_argument("--height", type=float, default=1.5)
    parser.add_argument("--gap", type=float, default=0.1)
    parser.add_argument("--off", type=float, default=0.05)
    args = parser.parse_args()
    with open(args.input, encoding="utf-8") as file:
        city = json.load(file)
    walls = sorted(walls_of(city, vertices_of(city)),
                   key=lambda w: (-round(w["start"][2] + w["height"], 1), -w["width"]))
    panels = [panel for wall in walls for panel in panels_on(wall, args)][:args.panels]
    if len(panels) < args.panels:
        raise SystemExit(f"the walls have room for {len(panels)} panels, not for {args.panels}")
    add_panels(city, panels)
    with open(args.output, "w", encoding="utf-8") as file:
        json.dump(city, file)


if __name__ == "__main__":
    main()
