"""Runs tenku for benchmarks and sets out the results. Needs nothing but Python 3."""

import json
import os
import pathlib
import subprocess
import sys

GENERATOR = (pathlib.Path(__file__).resolve().parents[2] / "scenes" / "examples" /
             "generate_cuboids.py")
DONE, REFUSED, TOLERANCE_NOT_REACHED = 0, 2, 3  # exit codes
# The light of every run: a clear sky with a morning sun.
LIGHT = ["--sky", "cie:12", "--sun-altitude", "40", "--sun-azimuth", "135", "--bounces", "0"]


class Refused(Exception):
    """tenku does not take the options or the scene (exit code 2); holds what it says."""


def say(text):
    print(text, file=sys.stderr, flush=True)


def make_townscape(path):
    """The cuboids of the generator as it stands, 300,000 triangles."""
    subprocess.run([sys.executable, "-B", GENERATOR, "--out", path], check=True)


def run_tenku(command):
    """@return  the summary that --json gives
    @throws Refused; SystemExit if tenku fails otherwise"""
    run = subprocess.run([*map(str, command), "--json", "--quiet"], capture_output=True, text=True)
    if run.returncode == REFUSED:
        raise Refused(" ".join(run.stderr.split()) or "no reason given")
    if run.returncode not in (DONE, TOLERANCE_NOT_REACHED):
        line = " ".join(map(str, command))
        raise SystemExit(f"{line}\nended with {run.returncode}: {run.stderr}")
    return json.loads(run.stdout)


def tell_run(name, summary):
    say(f"{name:44} {summary['seconds']:8.2f} s   load {os.getloadavg()[0]:.1f}")


def tell_refusal(name, reason):
    say(f"REFUSED {name}: {reason}")


def plan_seconds(summary, key):
    """Sum of `measured_s` or `predicted_s` over the regions of the plan; None where one has none."""
    seconds = [region[key] for region in summary.get("plan") or []]
    return sum(seconds) if seconds and None not in seconds else None


def number(value, form):
    return "-" if value is None else format(value, form)


def markdown_table(columns, rows):
    """@param columns  names; those of numbers end with a colon and are set to the right"""
    lines = [[c.removesuffix(":") for c in columns],
             ["---:" if c.endswith(":") else "---" for c in columns], *rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)
