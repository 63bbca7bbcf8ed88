#!/usr/bin/env python3
"""Times Radiance and tenku side by side and compares both with known values.

    against_radiance.py --tenku tenku --radiance BIN_FOLDER --reference FOLDER --out FOLDER

BIN_FOLDER holds obj2rad, oconv and rtrace, which find their rayinit.cal by RAYPATH. The reference
folder holds a city (city.obj.gz, city_sensors.pts, city_exact_grid.txt) and a room (room.obj,
room_sensors.pts, room_reference.csv), both under the CIE overcast sky of 10,000 lx. The two
programs take turns, so that whatever else the machine does falls on both. The times of a whole
program begin with Radiance's octree made (whole_s, processor_s), or with the model for both
(from_model_s, from_model_processor_s: obj2rad and oconv, timed as often, are Radiance's then).
Writes against_radiance.csv and one chart a scene. Needs nothing but Python 3.
"""

import argparse
import csv
import dataclasses
import gzip
import json
import math
import os
import pathlib
import shutil
import statistics
import subprocess
import tempfile
import time

from error_time_chart import write_chart

PROCESSES = 2
LONG_S = 40.0  # of the processor
HORIZONTAL_LUX = 10000.0
# L(zenith) (1 + 2 sin altitude) / 3 gives 7 pi / 9 L(zenith) on the horizontal plane
# (ISO 15469:2004). Radiance values are lux here: nothing is divided by its 179 lm/W.
SKY = """void brightfunc overcast_function
2 overcast {cal}
0
0
overcast_function glow overcast_glow
0
0
4 1 1 1 0
overcast_glow source sky
0
0
4 0 0 1 180
"""
CAL = f"overcast = {HORIZONTAL_LUX} * 9 / (7 * PI) * (1 + 2 * Dz) / 3;\n"
# Every division sampled where it is needed (-aa 0), no ray cut short for its weight.
RTRACE = ["-h", "-I", "-ov", "-aa", "0", "-as", "0", "-lw", "1e-9", "-lr", "0", "-u+"]


@dataclasses.dataclass
class Scene:
    name: str
    model: str                # OBJ, in the reference folder
    sensors: str
    reflectance: dict         # by material
    radiance: list            # (label, options)
    tenku: dict               # label of the line -> like `radiance`
    is_relative: bool         # error: RMS of relative errors, or RMS by the mean
    title: str
    chart: str                # file name


CITY = Scene(
    "city", "city.obj.gz", "city_sensors.pts", {"ground": 0.2, "wall": 0.5},
    [(f"-ad {n}", ["-ab", "1", "-ad", str(n)]) for n in (64, 256, 1024, 4096)],
    {"tenku": [(f"{t:g} %", ["--bounces", "0", "--tolerance", str(t)])
               for t in (30, 10, 5, 3, 1.6, 0.8)]},
    False, "City, 250,002 triangles, 10,000 sensors, overcast sky, no reflection",
    "against_radiance.svg")
ROOM = Scene(
    "room", "room.obj", "room_sensors.pts", {"floor": 0.2, "wall": 0.5, "ceil": 0.7},
    [(f"-ad {n}", ["-ab", "6", "-ad", str(n)]) for n in (512, 2048, 8192)],
    {"tenku, paths": [(f"{t} %", ["--reflection", "paths", "--bounces", "5", "--tolerance", str(t)])
                      for t in (10, 5, 3)],
     "tenku, radiosity": [(f"{t} %", ["--reflection", "radiosity", "--tolerance", str(t)])
                          for t in (20, 10, 5, 2)]},
    True, "Room with a window, 400 sensors, overcast sky",
    "against_radiance_room.svg")


def read_truth(scene, folder):
    if scene is CITY:
        return [float(row.split()[0]) for row in (folder / "city_exact_grid.txt").open()]
    with open(folder / "room_reference.csv") as file:
        return [float(row["total_lux"]) for row in csv.DictReader(file)]


def errors_pct(values, truth, is_relative):
    """RMS and largest error, percent."""
    assert len(values) == len(truth)
    mean = sum(truth) / len(truth)
    each = [(v - t) / (t if is_relative else mean) for v, t in zip(values, truth)]
    return (100 * math.sqrt(sum(e * e for e in each) / len(each)),
            100 * max(abs(e) for e in each))


class Stopwatch:
    """Runs programs side by side: seconds by the clock, and of the processor in all of them.

    @param jobs  (command, file it reads or None, file it writes or None)"""

    def __init__(self, *jobs):
        start = time.perf_counter()
        children = [self.start(*job) for job in jobs]
        self.cpu_s = 0.0
        for (command, _, _), child in zip(jobs, children):
            _, status, usage = os.wait4(child.pid, 0)
            self.cpu_s += usage.ru_utime + usage.ru_stime
            child.returncode = os.waitstatus_to_exitcode(status)
            if child.returncode not in (0, 3):  # 3: tenku reached its limit of effort first
                raise SystemExit(f"{command[0]} ended with {child.returncode}")
        self.wall_s = time.perf_counter() - start

    @staticmethod
    def start(command, stdin, stdout):
        with open(stdin or os.devnull) as source, open(stdout or os.devnull, "w") as sink:
            return subprocess.Popen(command, stdin=source, stdout=sink, stderr=subprocess.DEVNULL)


class Radiance:
    name = "Radiance"

    def __init__(self, programs, scene, reference, work):
        self.programs, self.work = programs, work
        self.octree = work / f"{scene.name}.oct"
        # rtrace -n gives its processes many sensors at a time, and so a small job to one of them.
        self.sensors = (reference / scene.sensors).read_text().splitlines(keepends=True)
        self.made = []  # preparations, as watches
        self.prepare = lambda: self.make_octree(scene, reference / scene.model)
        self.prepare()

    def make_octree(self, scene, model):
        plain = self.work / f"{scene.name}.obj"
        with (gzip.open if model.suffix == ".gz" else open)(model, "rb") as packed:
            plain.write_bytes(packed.read())
        materials = "".join(f"void plastic {name}\n0\n0\n5 {r} {r} {r} 0 0\n"
                            for name, r in scene.reflectance.items())
        cal = self.work / "overcast.cal"
        cal.write_text(CAL)
        sky = self.work / f"{scene.name}_sky.rad"
        sky.write_text(materials + SKY.format(cal=cal))
        geometry = self.work / f"{scene.name}_geometry.rad"
        self.made.append((Stopwatch(([self.programs / "obj2rad", plain], None, geometry)),
                          Stopwatch(([self.programs / "oconv", "-f", sky, geometry], None,
                                     self.octree))))

    def preparation_s(self, time_of):
        return statistics.median(sum(time_of(watch) for watch in those) for those in self.made)

    def trace(self, options, sensors):
        """Every process takes every so manieth sensor.

        @return  watch, values in the order of the sensors"""
        command = [self.programs / "rtrace", *RTRACE, *options, self.octree]
        jobs = []
        for k in range(PROCESSES):
            points, out = self.work / f"sensors_{k}.pts", self.work / f"radiance_{k}.txt"
            points.write_text("".join(sensors[k::PROCESSES]))
            jobs.append((command, points, out))
        watch = Stopwatch(*jobs)
        values = [0.0] * len(sensors)
        for k, (_, _, out) in enumerate(jobs):
            values[k::PROCESSES] = [float(row.split()[0]) for row in out.open()]
        return watch, values

    def run(self, options):
        load, _ = self.trace(["-ab", "1", "-ad", "1"], self.sensors[:PROCESSES])
        watch, values = self.trace(options, self.sensors)
        return watch, max(watch.wall_s - load.wall_s, 0.001), values


class Tenku:
    def __init__(self, name, program, scene, reference, work):
        self.name = name
        self.work, self.out = work, work / "tenku.csv"
        materials = work / f"{scene.name}.toml"
        materials.write_text("".join(f"[{name}]\nreflectance = {r}\n"
                                     for name, r in scene.reflectance.items()))
        self.command = [program, "illuminance", reference / scene.model, "--sensors",
                        reference / scene.sensors, "--materials", materials, "--sky",
                        "cie-overcast", "--sky-illuminance", f"{HORIZONTAL_LUX:g}", "--threads",
                        str(PROCESSES), "--json", "--out", self.out]

    @staticmethod
    def preparation_s(time_of):
        """Reads the model and builds its tree in every run."""
        return 0.0

    def run(self, options):
        summary = self.work / "tenku.json"
        watch = Stopwatch(([*self.command, *options], None, summary))
        with open(self.out) as file:
            values = [float(row["total_lux"]) for row in csv.DictReader(file)]
        return watch, json.loads(summary.read_text())["seconds"], values


def take_turns(jobs, rounds):
    """Runs all jobs `rounds` times, the two programs by turns; long ones once, as the processor
    time of a long run spreads little.

    @return  job -> its runs, as (watch, stage seconds, values)"""
    runs = {}
    for turn in range(rounds):
        for job, run in jobs:
            if turn > 0 and runs[job][-1][0].cpu_s > LONG_S:
                continue
            runs.setdefault(job, []).append(run(job[2]))
            watch, stage_s, _ = runs[job][-1]
            load = os.getloadavg()[0]
            print(f"{job[0]:17} {job[1]:9} {watch.wall_s:7.2f} s whole, {stage_s:7.2f} s stage, "
                  f"{watch.cpu_s:7.2f} s processor, load {load:.1f}", flush=True)
    return runs


def by_turns(*lists):
    """a0 b0 a1 b1 ...; what is left of the longer ones at its end."""
    most = max(len(one) for one in lists)
    return [item for k in range(most) for one in lists for item in one[k:k + 1]]


def measure(scene, options, work):
    radiance = Radiance(options.radiance, scene, options.reference, work)
    programs = [(radiance, scene.radiance)] + [
        (Tenku(name, options.tenku, scene, options.reference, work), settings)
        for name, settings in scene.tenku.items()]
    jobs = [[((program.name, label, tuple(given)), program.run) for label, given in settings]
            for program, settings in programs]
    jobs = [[job for job in one if options.only in (None, job[0][0])] for one in jobs]
    runs = take_turns(by_turns(*jobs), options.rounds)
    while len(radiance.made) < options.rounds:
        radiance.prepare()
    preparation_s = {program.name: program.preparation_s for program, _ in programs}
    truth = read_truth(scene, options.reference)
    for (program, label, _), those in runs.items():
        error, worst = zip(*(errors_pct(values, truth, scene.is_relative)
                             for _, _, values in those))
        whole_s = statistics.median(watch.wall_s for watch, _, _ in those)
        processor_s = statistics.median(watch.cpu_s for watch, _, _ in those)
        yield {"scene": scene.name, "program": program, "setting": label, "runs": len(those),
               "rms_error_pct": statistics.median(error), "worst_error_pct": max(worst),
               "stage_s": statistics.median(stage for _, stage, _ in those),
               "whole_s": whole_s,
               "whole_s_least": min(watch.wall_s for watch, _, _ in those),
               "whole_s_most": max(watch.wall_s for watch, _, _ in those),
               "processor_s": processor_s,
               "from_model_s": whole_s + preparation_s[program](lambda watch: watch.wall_s),
               "from_model_processor_s":
                   processor_s + preparation_s[program](lambda watch: watch.cpu_s)}


def draw(scene, rows, path):
    """Processor time: on a busy machine the clock tells more of the others than of these two."""
    def points(program, time="processor_s"):
        return [(float(row[time]), float(row["rms_error_pct"]), row["setting"])
                for row in rows if row["program"] == program]
    write_chart(path, scene.title,
                ("processor time of the whole program, in two processes or threads / s",
                 "RMS error / %" if scene.is_relative else "RMS error by the mean / %"),
                [("Radiance, octree made before", points(Radiance.name)),
                 ("Radiance, from the model", points(Radiance.name, "from_model_processor_s")),
                 *((f"{name}, by --tolerance" if name == "tenku" else name, points(name))
                   for name in scene.tenku)])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("tenku", "radiance", "reference", "out"):
        parser.add_argument(f"--{name}", type=lambda p: pathlib.Path(p).resolve(), required=True)
    parser.add_argument("--scenes", default="city,room")
    parser.add_argument("--rounds", type=int, default=5, help="of each setting; those that take over 40 s of the processor run once")
    parser.add_argument("--only", help="program or line of the chart that is timed; default: all")
    parser.add_argument("--beside", type=pathlib.Path,
                        help="against_radiance.csv of another run, whose rows are charted too")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    work = pathlib.Path(tempfile.mkdtemp(prefix="against_radiance_"))
    rows = []
    for scene in (CITY, ROOM):
        if scene.name not in options.scenes.split(","):
            continue
        own = list(measure(scene, options, work))
        if options.beside:
            with options.beside.open() as file:
                own = [row for row in csv.DictReader(file)
                       if row["scene"] == scene.name] + own
        draw(scene, own, options.out / scene.chart)
        rows += own
    with open(options.out / "against_radiance.csv", "w", newline="") as file:
        table = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    shutil.rmtree(work)


if __name__ == "__main__":
    main()
