"""How often beams and rays ask the scene, by the number of mirrors: mirror_chart.py CHART.svg CURVE.csv, from what
mirror_benchmark --cuboids prints."""

import csv
import pathlib
import sys

from error_time_chart import write_chart


def main():
    chart, curve = sys.argv[1:]
    with open(curve, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    series = [(name, [(float(row["mirrors"]), float(row[key]) / 1000.0, "") for row in rows])
              for name, key in (("beams", "queries_beams"), ("rays", "queries_rays"))]
    write_chart(pathlib.Path(chart), "Cuboids of mirrors, 1024 x 1024 pixels, depth 6",
                ("mirrors", "thousands of scene queries"), series)


if __name__ == "__main__":
    main()
