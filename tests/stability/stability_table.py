#!/usr/bin/env python3
"""Writes docs/stability.md from a run of the stability matrix.

stability_table.py RUN.txt docs/stability.md, where RUN.txt is what
`test_stability --gtest_filter='*Matrix*'` printed, with TENKU_STABILITY_LONG set or not.
"""

import sys

WORDS = {"right": "right", "told": "told", "refused": "refused", "tested": "right (unit test)",
         "WRONG": "**open**", "none": "-"}

HEAD = """# Stability

Every method against every hazard that it can meet. Generated from a run by `make stability`
(`tests/stability/stability_table.py`); an empty cell fails a test.

- `right`: the program's values lie within their intervals of a closed form or another value from outside.
- `told`: a finding names the place and the cause. `refused`: exit code 2 names the value.
- `right (unit test)`: shown by the test named below. `-`: does not apply, or is not run; the reason is below.
- **open**: known not to hold: what is wrong is said below.
- `not run`: a long cell (`make stability` runs it), or one that this run did not reach.

What to do: where a result comes with `far_from_origin`, cut off the stray object; with `coincident_faces`, keep one of the
faces; with `unlikely_size`, give `--scale`; with `no_light`, move the sensor out of the solid; with `sensor_on_edge`, move it
off by 0.1 mm; with `faces_cross`, cut the faces where they meet, or make the elements small; with `grazing_sun` or
`tolerance_not_reached`, read `error_lux`.
"""


def rows(run):
    """Cells by (method, hazard), and the headings in order."""
    cells, methods, hazards = {}, [], []
    for line in run:
        kind, _, rest = line.partition(" ] ")
        parts = rest.rstrip("\n").split("|", 3)
        if kind == "[ CELL":
            cells[parts[0], parts[1]] = parts[2:]
        elif kind == "[ METHOD":
            methods.append(parts)
        elif kind == "[ HAZARD":
            hazards.append(parts)
    return cells, methods, hazards


def table(cells, methods, hazards):
    yield "| hazard | " + " | ".join(title for _, title in methods) + " |"
    yield "| --- |" + " --- |" * len(methods)
    for hazard, title in hazards:
        words = [WORDS[cells[m, hazard][0]] if (m, hazard) in cells else "not run" for m, _ in methods]
        yield f"| {title} | " + " | ".join(words) + " |"


def details(cells, methods, hazards):
    for hazard, title in hazards:
        by_note = {}
        for method, name in methods:
            if (method, hazard) in cells:
                by_note.setdefault(cells[method, hazard][1], []).append(name)
        yield f"\n**{title[0].upper() + title[1:]}**\n"
        for note, names in by_note.items():
            yield f"- {', '.join(names)}: {note or 'see the table'}"


def main():
    with open(sys.argv[1], encoding="utf-8", errors="replace") as run:
        cells, methods, hazards = rows(run)
    text = "\n".join([HEAD, *table(cells, methods, hazards), "", "## What each cell came to",
                      *details(cells, methods, hazards), ""])
    with open(sys.argv[2], "w", encoding="utf-8") as page:
        page.write(text)


main()
