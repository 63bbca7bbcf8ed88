"""Error against elements for each mesher: mesh_error_chart.py CURVE.csv CHART.svg TITLE, from what mesh_error prints;
and at how many elements the others are as wrong as bubbles are."""

import csv
import math
import pathlib
import sys

from error_time_chart import write_chart

NAMES = {"uniform": "uniform", "refine": "refine", "bubble": "bubble", "shadow": "bubble, shadow edges"}
ROUNDS = {"refine": "3", "bubble": "2", "shadow": "2"}


def read_curves(path):
    """@return for each mesher [(elements, percent)], rising; single comparisons are left out"""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    curves = {name: [] for name in NAMES}
    for row in rows:
        part = row["case"].split(":")
        if len(part) > 2 and part[3] != ROUNDS[part[0]]:
            continue
        curves[part[0]].append((int(row["elements"]), float(row["rms_pct"])))
    return {name: sorted(points) for name, points in curves.items()}


def elements_at(points, error):
    """Elements at which a curve reaches an error, between its points; nothing beyond them."""
    for (n0, e0), (n1, e1) in zip(points, points[1:]):
        if e0 >= error >= e1:
            share = math.log(e0 / error) / math.log(e0 / e1)
            return n0 * (n1 / n0) ** share
    return None


def main():
    path, chart, title = sys.argv[1:4]
    curves = read_curves(path)
    write_chart(pathlib.Path(chart), title, ("elements", "RMS of illuminance, percent of the mean"),
                [(NAMES[name], [(n, e, "") for n, e in points]) for name, points in curves.items()])
    print("mesh,elements,rms_pct,of_refine_pct,of_uniform_pct")
    for name in ("bubble", "shadow"):
        for elements, error in curves[name]:
            shares = [elements_at(curves[other], error) for other in ("refine", "uniform")]
            words = [f"{100.0 * elements / n:.0f}" if n else "" for n in shares]
            print(f"{name},{elements},{error:.2f},{','.join(words)}")


if __name__ == "__main__":
    main()
