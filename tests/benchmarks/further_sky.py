#!/usr/bin/env python3
"""What a further sky costs on kept form factors: processor time of tenku radiosity with one sky,
with another after it, and with ten, in the room with a window (room.obj, room_sensors.pts of
against_radiance.py). The three take turns; medians of five. Beside it what the runs with ten say
themselves of each sky: a ratio within one process, which the load of a machine moves less.
further_sky.py --tenku PROGRAM --reference FOLDER --out FOLDER [--sun] [--tolerance 2]

--sun gives the further skies a sun. Needs nothing but Python 3.
"""

import argparse
import pathlib
import resource
import statistics

from tenku_runs import run_tenku, say

REFLECTANCE = {"floor": 0.2, "wall": 0.5, "ceil": 0.7}
FURTHER = [1, 3, 5, 7, 8, 9, 11, 12, 13, 14]  # CIE general skies
COLUMNS = "sky,sun_altitude_deg,sun_azimuth_deg,sky_illuminance_lx,sun_illuminance_lx\n"


def write_inputs(out, has_sun):
    (out / "room.toml").write_text("".join(f"[{name}]\nreflectance = {r}\n"
                                           for name, r in REFLECTANCE.items()))
    first = "cie-overcast,,,10000,0\n"
    sun_lux = 60000 if has_sun else 0
    more = [f"cie:{kind},{30 + kind},{100 + 10 * kind},{9000 + 500 * kind},{sun_lux}\n"
            for kind in FURTHER]
    for count, name in ((0, "one"), (1, "two"), (len(FURTHER), "all")):
        (out / f"{name}.csv").write_text(COLUMNS + first + "".join(more[:count]))


def processor_seconds(options, skies):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    summary = run_tenku([options.tenku, "radiosity", options.reference / "room.obj", "--sensors",
                         options.reference / "room_sensors.pts", "--materials",
                         options.out / "room.toml", "--tolerance", options.tolerance, "--skies",
                         options.out / skies, "--out", options.out / "lux.csv"])
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, summary


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("tenku", "reference", "out"):
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True)
    parser.add_argument("--tolerance", default="2")
    parser.add_argument("--sun", action="store_true")
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    write_inputs(options.out, options.sun)
    times = {"one": [], "two": [], "all": []}
    shares = []
    for _ in range(options.rounds):
        for name, seconds in times.items():
            spent, summary = processor_seconds(options, name + ".csv")
            seconds.append(spent)
        of_sky = [sky["processor_s"] for sky in summary["skies"]]
        shares.append([seconds / of_sky[0] for seconds in of_sky[1:]])
        say(", ".join(f"{name} {seconds[-1]:.2f} s" for name, seconds in times.items()))
    one, two, all_skies = (statistics.median(times[name]) for name in ("one", "two", "all"))
    each = (all_skies - two) / (len(FURTHER) - 1)
    print(f"{summary['elements']} elements: one sky {one:.2f} s of the processor; what other skies "
          f"need {two - one - each:.2f} s, once; each of them {each:.3f} s, "
          f"{100 * each / one:.1f} % of the first")
    medians = [statistics.median(share) for share in zip(*shares)]
    print(f"within a run, in percent of the first sky: mean {100 * statistics.mean(medians):.2f}; by "
          "sky " + ", ".join(f"{100 * share:.2f}" for share in medians))
    print("clock, by sky: " + ", ".join(f"{sky['seconds']:.2f}" for sky in summary["skies"]))


if __name__ == "__main__":
    main()
