#!/usr/bin/env python3
"""Times fly-throughs against pictures made frame by frame.

    flythrough_benchmark.py --tenku PROGRAM --out FOLDER [--data FOLDER] [--frames PROGRAM]

The first is the case of S. Takada, Y. Dobashi and T. Yamamoto, "A fast method for rendering
townscape images with skylight", section 5: cuboids of 300,000 triangles, 30 frames of 512 x 512,
471 sky elements, every element for every point, no reflection. The path leads 29 m forward over
the roofs from the view of townscape.py. With --data the second: The Hague (41,187 triangles),
10 s at 30 frames/s, 1280 x 720, with all defaults and five bounces, and another hour on its store.

Frames made alone are some of the path, each by `tenku render` with the same options; their mean
times the number of frames is what the film would take. All by processor time (user and system of
the program), which other work on the machine disturbs little, beside clock time. With --frames
(the target flythrough_frames) played frames are compared with direct ones.
"""

import argparse
import json
import pathlib
import resource
import statistics
import subprocess
import time

from tenku_runs import make_townscape

KEY = '[[key]]\ntime_s = {}\neye = [{}, {}, {}]\ntarget = [{}, {}, {}]\n'


class Case:
    def __init__(self, scene, light, how, size, rate, keys):
        self.scene, self.light, self.how = scene, light, how
        self.size, self.rate, self.keys = size, rate, keys

    def path(self):
        return (f'curve = "straight"\nframes_per_second = {self.rate}\n'
                f'size = [{self.size[0]}, {self.size[1]}]\n'
                + "".join(KEY.format(t, *eye, *target) for t, eye, target in self.keys))


def paper_case(out):
    scene = out / "cuboids.obj"
    if not scene.exists():
        make_townscape(scene)
    return Case(scene, ["--sky", "cie:12", "--sun-altitude", "40", "--sun-azimuth", "135"],
                ["--bounces", "0", "--engine", "rays", "--lod", "off", "--elements", "471"],
                (512, 512), 30, [(0, (0, -1900, 65), (0, -1657, 0)),
                                 (1, (0, -1870, 65), (0, -1627, 0))])


def city_case(data):
    return Case(data / "city/cityjson/denhaag_tile01_v10.city.json",
                ["--sky", "cie:12", "--sun-altitude", "45", "--sun-azimuth", "150"], [],
                (1280, 720), 30,
                [(0, (78400, 457750, 45), (78600, 457950, 10)),
                 (5, (78460, 457800, 38), (78640, 458000, 10)),
                 (10, (78510, 457860, 34), (78650, 458080, 10))])


def run(command):
    """@return  summary of --json, processor seconds, clock seconds"""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run([*map(str, command), "--json", "--quiet"], capture_output=True, text=True)
    clock, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in (0, 3):
        raise SystemExit(f"{' '.join(map(str, command))}\nended with {done.returncode}: {done.stderr}")
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return json.loads(done.stdout), spent, clock


def frames_alone(tenku, case, out):
    """Processor seconds of a frame by `render`, mean over the keys of the path."""
    spent = []
    for _, eye, target in case.keys:
        place = ["--eye", ",".join(map(str, eye)), "--target", ",".join(map(str, target)),
                 "--size", f"{case.size[0]}x{case.size[1]}"]
        spent.append(run([tenku, "render", case.scene, *case.light, *case.how, *place,
                          "--out", out / "alone.hdr"])[1])
    return statistics.mean(spent)


def film(tenku, case, out, name):
    path, store = out / f"{name}.toml", out / f"{name}.tkpts"
    path.write_text(case.path())
    told, spent, clock = run([tenku, "flythrough", case.scene, *case.light, *case.how,
                              "--path", path, "--out", store])
    alone = frames_alone(tenku, case, out)
    whole = alone * told["frames"]
    print(f"{name}: {told['frames']} frames, {told['points']} points, "
          f"{told['bytes'] / told['points']:.1f} bytes a point, lit by {told['light']}")
    print(f"  film {spent:.1f} s of processor time ({clock:.1f} s by the clock); frame by frame "
          f"{alone:.1f} s each, {whole:.0f} s in all: {whole / spent:.1f} times")
    return store, spent


def another_hour(tenku, case, store, first):
    light = ["--sky", "cie:12", "--sun-altitude", "30", "--sun-azimuth", "220"]
    _, spent, _ = run([tenku, "flythrough", case.scene, *light, *case.how, "--relight", store])
    print(f"  another hour {spent:.1f} s of processor time: {100 * spent / first:.0f} % of the film")


def compare(frames, case, store, bounces):
    if frames is None:
        return
    _, model, _, altitude, _, azimuth = case.light
    done = subprocess.run([str(frames), str(store), str(case.scene), model, altitude, azimuth, "2",
                           bounces, "3"], check=True, capture_output=True, text=True)
    print("  " + done.stdout.strip().replace("\n", "\n  "))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--tenku", type=pathlib.Path, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--data", type=pathlib.Path)
    parser.add_argument("--frames", type=pathlib.Path)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    case = paper_case(options.out)
    store, first = film(options.tenku, case, options.out, "paper")
    compare(options.frames, case, store, "0")
    another_hour(options.tenku, case, store, first)
    if options.data:
        case = city_case(options.data)
        store, first = film(options.tenku, case, options.out, "city")
        compare(options.frames, case, store, "5")
        another_hour(options.tenku, case, store, first)


if __name__ == "__main__":
    main()
