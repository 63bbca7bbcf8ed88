#!/usr/bin/env python3
"""Times the level of detail on a townscape, and the choice of the engine on real cities.

    townscape.py --tenku PROGRAM --out FOLDER [--runs 5] [--mu X]
    townscape.py --tenku PROGRAM --out FOLDER --engines-benchmark --data FOLDER [--most-sensors N]

The first repeats the experiment of S. Takada, Y. Dobashi and T. Yamamoto, "A fast method for
rendering townscape images with skylight", section 5: cuboids of 300,000 triangles, 512 x 512
pixels, 471 sky elements; every element for every point, against levels of detail. Each engine's
pictures are compared with its own of `--lod off`. All methods take turns, the median counts.

The view is that from a roof 65 m high, above every building so that none stands in it, a
hundred metres inside the southern edge: looking north and 15 degrees down, with the nearest
buildings across a street, the farthest at 4 km, and sky in the upper quarter.

Only one picture a method and turn is made, and timed: F.hdr. What a viewer sees of it is
calculated here, by one exposure (that of the reference) and tenku's own tone curve. RGBE keeps
luminance in steps of 0.4 to 0.8 %; differences below that come out right on the mean of many
pixels only.

Writes townscape.md, or engines.md for the second (engine_choice.py). Options that this version
of tenku refuses are told, their rows say so, and the exit code is 2.
"""

import argparse
import dataclasses
import pathlib
import shlex
import statistics
import sys

import engine_choice
from picture_difference import Reference, read_picture
from tenku_runs import (LIGHT, REFUSED, Refused, make_townscape, markdown_table, number,
                        plan_seconds, run_tenku, say, tell_refusal, tell_run)

VIEW = ["--eye", "0,-1900,65", "--target", "0,-1657,0", "--fov", "60", "--size", "512x512"]
ELEMENTS = "471"
ENGINES, LODS = ("rays", "shadow-maps"), ("off", "paper", "budget", "plain")
COLUMNS = ("method", "seconds:", "least - most:", "lighting s:", "ratio to off:", "depth maps:",
           "elements:", "mean difference (a):", "mean difference (b):", "worst pixel (a):",
           "worst pixel (b):")
LEGEND = """
Seconds: the whole of `tenku render`, reading the scene included, median of {runs}; lighting: its
lighting stage, where it tells. Ratio: seconds of `off` (the engine's first row) by those of the
method. Differences from the picture of that row, in 1/255: (a) of 8-bit screen codes, (b) of
luminance whose 99th percentile is 255, clipped; over all pixels, the quarter of them that shows
sky included.
"""


@dataclasses.dataclass
class Method:
    engine: str
    lod: str
    picture: pathlib.Path
    summaries: list = dataclasses.field(default_factory=list)
    refusal: str = ""

    @property
    def name(self):
        return f"{self.engine}, {self.lod}"

    def options(self, mu):
        if self.lod == "plain":
            return ["--engine", self.engine]
        fineness = ["--mu", mu] if self.lod == "paper" and mu is not None else []
        return ["--engine", self.engine, "--lod", self.lod, *fineness]

    def median_s(self):
        return statistics.median(s["seconds"] for s in self.summaries) if self.summaries else None

    def lighting_s(self):
        times = [plan_seconds(s, "measured_s") for s in self.summaries]
        return statistics.median(times) if times and None not in times else None


def render(method, options, scene):
    command = [options.tenku, "render", scene, *VIEW, *LIGHT, "--elements", ELEMENTS,
               *method.options(options.mu), *options.more, "--out", method.picture]
    try:
        method.summaries.append(run_tenku(command))
        tell_run(method.name, method.summaries[-1])
    except Refused as refusal:
        method.refusal = str(refusal)
        tell_refusal(method.name, method.refusal)


def compared(method, reference):
    """The last four columns."""
    if reference is None:
        return 4 * ["-"]
    seen, linear = reference.differences_from(read_picture(method.picture))
    return [f"{seen.mean:.3f}", f"{linear.mean:.3f}", f"{seen.worst:.0f}", f"{linear.worst:.0f}"]


def row_of(method, base_s, reference):
    if method.refusal:
        return [method.name, "refused", *(len(COLUMNS) - 2) * ["-"]]
    times, last = [s["seconds"] for s in method.summaries], method.summaries[-1]
    ratio = base_s / method.median_s() if base_s else None
    return [method.name, f"{method.median_s():.2f}", f"{min(times):.2f} - {max(times):.2f}",
            number(method.lighting_s(), ".2f"), number(ratio, ".2f"), str(last["depth_maps"]),
            str(last["elements"]), *compared(method, reference)]


def rows_of_engine(methods):
    """@param methods  of one engine; the first is the reference of the others"""
    first = methods[0]
    reference = None if first.refusal else Reference(read_picture(first.picture))
    return [row_of(method, first.median_s(), reference) for method in methods]


def compare_methods(options):
    """@return  whether tenku took all options"""
    scene = options.scene or options.out / "townscape.obj"
    if options.scene is None:
        make_townscape(scene)
    methods = [[Method(engine, lod, options.out / f"{engine}_{lod}.hdr") for lod in options.lods]
               for engine in options.engines]
    every = [method for those in methods for method in those]
    for turn in range(options.runs):
        say(f"turn {turn + 1} of {options.runs}")
        for method in every:
            if not method.refusal:
                render(method, options, scene)
    rows = [row for those in methods for row in rows_of_engine(those)]
    text = markdown_table(COLUMNS, rows) + LEGEND.format(runs=options.runs)
    (options.out / "townscape.md").write_text(text)
    print(text)
    return not any(method.refusal for method in every)


def choices(known):
    def parse(text):
        words = text.split(",")
        for word in words:
            if word not in known:
                raise argparse.ArgumentTypeError(f"'{word}' is none of {', '.join(known)}")
        return words
    return parse


def positive(text):
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError(f"{text} is below 1")
    return value


def parsed_options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])

    def path(text):
        return pathlib.Path(text).resolve()

    parser.add_argument("--tenku", type=path, required=True, help="the program")
    parser.add_argument("--out", type=path, required=True, help="folder for table and pictures")
    parser.add_argument("--more", type=shlex.split, default=[],
                        help="options for every run of tenku, in one word: --more='--threads 2'")
    parser.add_argument("--scene", type=path, help="instead of 300,000 triangles made anew")
    levels = parser.add_argument_group("levels of detail")
    levels.add_argument("--runs", type=positive, default=5, help="of each method (default 5)")
    levels.add_argument("--mu", help="threshold of --lod paper (default: tenku's)")
    levels.add_argument("--engines", type=choices(ENGINES), default=list(ENGINES))
    levels.add_argument("--lods", type=choices(LODS), default=["off", "paper", "budget"],
                        help="the first is the reference; plain: without --lod")
    engine_choice.add_options(parser, path)
    return parser.parse_args()


def main():
    options = parsed_options()
    options.out.mkdir(parents=True, exist_ok=True)
    benchmark = engine_choice.compare_engines if options.engines_benchmark else compare_methods
    return 0 if benchmark(options) else REFUSED


if __name__ == "__main__":
    sys.exit(main())
