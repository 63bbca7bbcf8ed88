#!/usr/bin/env python3
"""Whether results of shadow maps that leave out geometry, elements and texels stay inside their
intervals, on two real cities: sensors about the middle, tolerances 5, 2 and 1 %, against rays at
0.2 %. left_out.py --tenku PROGRAM --data FOLDER --out FOLDER [--tolerances 5 2 1]

Needs nothing but Python 3. Takes a quarter of an hour on two cores.
"""

import argparse
import csv
import pathlib
import sys

from tenku_runs import LIGHT, markdown_table, run_tenku, tell_run

CITIES = {"Den Haag": "city/cityjson/denhaag_tile01_v10.city.json",
          "Tokyo Minato": "city/large/tokyo_minato_north_lod1.city.json.gz"}
SPACING_M = {"Den Haag": 6.0, "Tokyo Minato": 40.0}
SENSORS = 1500  # the nearest to the middle
TRUTH_PCT = 0.2


def rows_of(path):
    with open(path, newline="") as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def place_sensors(tenku, scene, spacing_m, out):
    """Sensors of the city nearest to the middle of all; what sees no sky is left out."""
    run_tenku([tenku, "illuminance", scene, "--grid", "ground,roofs,walls", "--spacing", spacing_m,
               "--tolerance", "50", *LIGHT, "--out", out / "all.csv"])
    rows = [row for row in rows_of(out / "all.csv") if row["sky_view"] > 0.0]
    middle = [sorted(row[axis] for row in rows)[len(rows) // 2] for axis in "xy"]
    rows.sort(key=lambda row: (row["x"] - middle[0]) ** 2 + (row["y"] - middle[1]) ** 2)
    lines = [" ".join(f"{row[k]!r}" for k in ("x", "y", "z", "nx", "ny", "nz"))
             for row in rows[:SENSORS]]
    (out / "middle.pts").write_text("\n".join(lines) + "\n")


def light(tenku, scene, out, name, options):
    """@return  the rows, the summary"""
    summary = run_tenku([tenku, "illuminance", scene, "--sensors", out / "middle.pts", *LIGHT,
                         *options, "--out", out / f"{name}.csv"])
    tell_run(f"{scene.name}, {name}", summary)
    return rows_of(out / f"{name}.csv"), summary


def row_of(city, tolerance, result, truth):
    rows, summary = result
    inside = sum(abs(a["total_lux"] - b["total_lux"]) <= a["error_lux"] + b["error_lux"]
                 for a, b in zip(rows, truth, strict=True))
    plan = summary["plan"]
    reach = [region["reach_m"] for region in plan]
    return [city, f"{tolerance:g}", str(len(rows)), f"{100.0 * inside / len(rows):.1f}",
            f"{summary['error_mean']:.0f}", str(sum(region["elements"] for region in plan)),
            ", ".join("all" if r is None else f"{r:.0f}" for r in reach),
            f"{max(region['left_out_lux'] for region in plan):.0f}",
            str(summary["out_of_tolerance"]), f"{summary['seconds']:.1f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    for name in ("tenku", "data", "out"):
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True)
    parser.add_argument("--tolerances", type=float, nargs="+", default=[5.0, 2.0, 1.0])
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    rows = []
    for city, file in CITIES.items():
        scene = options.data / file
        place_sensors(options.tenku, scene, SPACING_M[city], options.out)
        truth, _ = light(options.tenku, scene, options.out, "truth",
                         ["--engine", "rays", "--tolerance", TRUTH_PCT, "--seed", "99"])
        for tolerance in options.tolerances:
            result = light(options.tenku, scene, options.out, f"maps{tolerance:g}",
                           ["--engine", "shadow-maps", "--tolerance", tolerance])
            rows.append(row_of(city, tolerance, result, truth))
    columns = ("city", "tolerance %:", "sensors:", "inside %:", "mean interval lx:", "elements:",
               "casters to m:", "left out lx:", "beyond the tolerance:", "seconds:")
    sys.stdout.write(markdown_table(columns, rows))


if __name__ == "__main__":
    main()
