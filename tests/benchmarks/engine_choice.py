"""Whether `--engine auto` takes the faster engine: the second half of townscape.py.

Grids of sensors on three real cities and the townscape of cuboids, each once with rays, with
shadow maps and with what tenku chooses. Needs nothing but Python 3.
"""

import dataclasses

from tenku_runs import (LIGHT, Refused, make_townscape, markdown_table, number, plan_seconds,
                        run_tenku, say, tell_refusal, tell_run)

ENGINES = ("rays", "shadow-maps", "auto")
# Coarse: what is timed is how the same work is done, not how well.
WORK = ["--grid", "ground,roofs,walls", "--elements", "300", "--lod", "off", "--tolerance", "50"]
COLUMNS = ("scene", "sensors:", "spacing m:", "rays s:", "shadow maps s:", "auto s:", "auto took",
           "the faster one", "auto by the faster:", "predicted by measured, rays:",
           "the same, shadow maps:", "the same, auto:")
LEGEND = """
Seconds of the lighting stage, one run each; with * those of the whole program, which told no stage.
"""
# Two engines within this of each other are equally fast: a single run is no better.
EVEN = 1.1


@dataclasses.dataclass
class City:
    name: str
    file: str     # in the data folder; none for the townscape
    up: str
    spacings: dict  # number of sensors, about -> metres (found by trying)


CITIES = [
    City("Den Haag", "city/cityjson/denhaag_tile01_v10.city.json", "z",
         {10_000: 21.5, 100_000: 9.0, 1_000_000: 1.7}),
    City("Tokyo Minato", "city/large/tokyo_minato_north_lod1.city.json.gz", "z",
         {10_000: 256.0, 100_000: 79.0, 1_000_000: 39.0}),
    City("Linz", "city/large/linz_centre_lod2.obj.gz", "y",
         {10_000: 377.0, 100_000: 80.0, 1_000_000: 29.0}),
    City("cuboids", "", "z", {10_000: 230.0, 100_000: 57.5, 1_000_000: 18.7}),
]


def add_options(parser, path):
    group = parser.add_argument_group("choice of the engine")
    group.add_argument("--engines-benchmark", action="store_true",
                       help="times the engines and tenku's choice of them instead")
    group.add_argument("--data", type=path, help="folder of the cities; without it cuboids only")
    group.add_argument("--most-sensors", type=int, default=1_000_000, metavar="N",
                       help="leaves out what has more (10,000, 100,000 and 1,000,000 there are)")


@dataclasses.dataclass
class Run:
    summary: dict

    def seconds(self):
        """Of the lighting stage, or of everything."""
        stage = plan_seconds(self.summary, "measured_s")
        return self.summary["seconds"] if stage is None else stage

    def seconds_text(self):
        return f"{self.seconds():.2f}" + ("" if self.summary.get("plan") else "*")

    def prediction(self):
        """Predicted by measured time."""
        predicted = plan_seconds(self.summary, "predicted_s")
        return predicted / self.seconds() if predicted is not None and self.seconds() > 0 else None

    def engines(self):
        return sorted({region["engine"] for region in self.summary.get("plan", [])})


def was_faster(runs):
    """Whether the engine that auto took was the faster one when forced, in words."""
    rays, maps, auto = (runs.get(engine) for engine in ENGINES)
    if rays is None or maps is None or auto is None or not auto.engines():
        return "-"
    if len(auto.engines()) > 1:
        return "both in use"
    ratio = rays.seconds() / maps.seconds()
    if 1.0 / EVEN < ratio < EVEN:
        return "even"
    return "yes" if auto.engines() == ["shadow-maps" if ratio > 1.0 else "rays"] else "no"


def excess(runs):
    """Time of auto by that of the faster engine."""
    forced = [runs[engine].seconds() for engine in ENGINES[:2] if engine in runs]
    if len(forced) < 2 or "auto" not in runs or not min(forced) > 0.0:
        return None
    return runs["auto"].seconds() / min(forced)


def row_of(city, spacing_m, runs):
    sensors = next((str(run.summary["sensors"]) for run in runs.values()), "-")
    took = " and ".join(runs["auto"].engines()) if "auto" in runs else ""
    return [city.name, sensors, f"{spacing_m:g}",
            *(runs[e].seconds_text() if e in runs else "refused" for e in ENGINES), took or "-",
            was_faster(runs), number(excess(runs), ".2f"),
            *(number(runs[e].prediction() if e in runs else None, ".2f") for e in ENGINES)]


def run_engines(city, scene, spacing_m, options):
    """@return  engine -> Run, without those that are refused"""
    runs = {}
    for engine in ENGINES:
        name = f"{city.name}, {spacing_m:g} m, {engine}"
        try:
            summary = run_tenku([options.tenku, "illuminance", scene, "--up", city.up, *WORK,
                                 "--spacing", spacing_m, *LIGHT, "--engine", engine, *options.more,
                                 "--out", options.out / "engines.csv"])
        except Refused as refusal:
            tell_refusal(name, refusal)
            continue
        tell_run(name, summary)
        runs[engine] = Run(summary)
    return runs


def scene_of(city, options):
    """The file of a city; None if there is none."""
    if city.file:
        scene = options.data / city.file if options.data else None
        return scene if scene and scene.exists() else None
    if options.scene is None:
        make_townscape(options.out / "townscape.obj")
    return options.scene or options.out / "townscape.obj"


def compare_engines(options):
    """@return  whether tenku took all options"""
    rows, all_taken = [], True
    for city in CITIES:
        scene = scene_of(city, options)
        if scene is None:
            say(f"left out {city.name}: there is no {city.file} in the folder of --data")
            continue
        for sensors, spacing_m in city.spacings.items():
            if sensors > options.most_sensors:
                continue
            runs = run_engines(city, scene, spacing_m, options)
            all_taken = all_taken and len(runs) == len(ENGINES)
            rows.append(row_of(city, spacing_m, runs))
    text = markdown_table(COLUMNS, rows) + LEGEND
    (options.out / "engines.md").write_text(text)
    print(text)
    return all_taken
