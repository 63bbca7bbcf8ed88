"""Error against elements for each mesher: mesh_error_chart.py CHART.svg TITLE CURVE.csv..., from what mesh_error prints;
and in parts of how many elements of the others bubbles are as wrong. Of each mesher the best runs count."""

import csv
import math
import pathlib
import sys

from error_time_chart import write_chart

NAMES = {"uniform": "uniform", "refine": "refine", "bubble": "bubble", "shadow": "bubble, shadow edges"}


def best(points):
    """Those than which none has fewer elements and less error."""
    kept = []
    for elements, error in sorted(points):
        if not kept or error < kept[-1][1]:
            kept.append((elements, error))
    return kept


def read_curves(paths):
    """@return for each mesher that ran [(elements, percent)], rising in elements, falling in error"""
    curves = {name: [] for name in NAMES}
    for path in paths:
        with open(path, encoding="utf-8") as file:
            for row in csv.DictReader(line for line in file if not line.startswith("#")):
                curves[row["case"].split(":")[0]].append((int(row["elements"]), float(row["rms_pct"])))
    return {name: best(points) for name, points in curves.items() if points}


def elements_at(points, error):
    """Elements at which a curve reaches an error, between its points; nothing beyond them."""
    for (n0, e0), (n1, e1) in zip(points, points[1:]):
        if e0 >= error >= e1:
            share = math.log(e0 / error) / math.log(e0 / e1)
            return n0 * (n1 / n0) ** share
    return None


def main():
    chart, title = sys.argv[1:3]
    curves = read_curves(sys.argv[3:])
    write_chart(pathlib.Path(chart), title, ("elements", "RMS of illuminance, percent of the mean"),
                [(NAMES[name], [(n, e, "") for n, e in points]) for name, points in curves.items()])
    print("mesh,elements,rms_pct,of_refine_pct,of_uniform_pct")
    for name in ("bubble", "shadow"):
        for elements, error in curves.get(name, []):
            shares = [elements_at(curves[other], error) for other in ("refine", "uniform")]
            words = [f"{100.0 * elements / n:.0f}" if n else "" for n in shares]
            print(f"{name},{elements},{error:.2f},{','.join(words)}")


if __name__ == "__main__":
    main()
