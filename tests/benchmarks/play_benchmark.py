#!/usr/bin/env python3
"""Plays a store in headless Chromium: frames a second, and the page against the program's frames.

    play_benchmark.py --tenku PROGRAM --out FOLDER STORE.tkpts [--frames 0,15,29]

Writes the page and the program's frames as PNG, draws the same frames in the page with four samples
a pixel, and prints as JSON: points, bytes of the page a point, frames a second (median of five
rounds of eight frames, each frame waited for) as drafts ("0.5"), with one sample and with four
("2"), and for each frame the mean difference of codes (of 255) and the structural similarity of
page and program. Between neighbouring frames of the list it prints how much more the page's differ
than the program's. The browser draws in software: its speed is that of the processor, by the clock.
"""
import argparse
import base64
import json
import pathlib
import statistics
import struct
import subprocess
import sys
import zlib

HERE = pathlib.Path(__file__).resolve().parent
SCRIPT = """tenkuPlayer.then(async (p) => {
  const gl = p.painter.gl, {width, height} = p.painter.canvas, shots = [];
  element("samples").value = "2";
  for (const frame of FRAMES) {
    p.goTo(frame);
    const rgba = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, rgba);
    let text = "";
    for (let i = 0; i < rgba.length; i += 8192)
      text += String.fromCharCode(...rgba.subarray(i, i + 8192));
    shots.push(btoa(text));
  }
  const rates = {};
  for (const samples of ["0.5", "1", "2"]) {
    p.measure(2, samples);
    rates[samples] = [1, 2, 3, 4, 5].map(() => p.measure(8, samples));
  }
  return {width, height, shots, rates, drawn: p.drawn};
})"""


def rows_of_png(path):
    """Rows of an 8-bit RGB picture without interlace."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            width, height = struct.unpack(">II", data[at + 8:at + 16])
            assert data[at + 16:at + 18] == b"\x08\x02", "8-bit RGB"
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += 12 + size
    flat, rows, before = zlib.decompress(packed), [], bytes(3 * width)
    for y in range(height):
        line = flat[y * (3 * width + 1):(y + 1) * (3 * width + 1)]
        row = bytearray(line[1:])
        for x in range(3 * width):
            left, up = (row[x - 3], before[x - 3]) if x >= 3 else (0, 0)
            above = before[x]
            if line[0] == 1:
                row[x] = (row[x] + left) & 255
            elif line[0] == 2:
                row[x] = (row[x] + above) & 255
            elif line[0] == 3:
                row[x] = (row[x] + (left + above) // 2) & 255
            elif line[0] == 4:
                guess = left + above - up
                row[x] = (row[x] + min((left, above, up), key=lambda v: abs(guess - v))) & 255
        rows.append(bytes(row))
        before = row
    return rows


def rows_of_shot(text, width, height):
    rgba = base64.b64decode(text)
    rows = []
    for y in reversed(range(height)):
        line = bytearray(rgba[4 * width * y:4 * width * (y + 1)])
        del line[3::4]
        rows.append(bytes(line))
    return rows


def mean_difference(a, b):
    return statistics.fmean(statistics.fmean(map(lambda u, v: abs(u - v), p, q))
                            for p, q in zip(a, b))


def similarity(a, b):
    """Mean structural similarity of the green channels over windows of 8 by 8 (Wang et al. 2004)."""
    a, b = [r[1::3] for r in a], [r[1::3] for r in b]
    c1, c2, n, found = 2.55 ** 2, 7.65 ** 2, 64, []
    for y in range(0, len(a) - 7, 8):
        for x in range(0, len(a[0]) - 7, 8):
            u = [v for r in a[y:y + 8] for v in r[x:x + 8]]
            w = [v for r in b[y:y + 8] for v in r[x:x + 8]]
            mu, mw = sum(u) / n, sum(w) / n
            vu, vw = sum(v * v for v in u) / n - mu * mu, sum(v * v for v in w) / n - mw * mw
            cov = sum(p * q for p, q in zip(u, w)) / n - mu * mw
            found.append((2 * mu * mw + c1) * (2 * cov + c2) /
                         ((mu * mu + mw * mw + c1) * (vu + vw + c2)))
    return statistics.fmean(found)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("store", type=pathlib.Path)
    parser.add_argument("--tenku", required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--frames", default="0")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    frames = [int(k) for k in options.frames.split(",")]
    page, folder = options.out / "film.html", options.out / "frames"
    play = [options.tenku, "play", str(options.store), "--json", "--quiet", "--out"]
    facts = json.loads(subprocess.run([*play, page], check=True, stdout=subprocess.PIPE).stdout)
    subprocess.run([*play, folder], check=True, stdout=subprocess.DEVNULL)
    said = json.loads(subprocess.run(
        [sys.executable, HERE.parent / "support/drive_page.py", page,
         SCRIPT.replace("FRAMES", json.dumps(frames)), "600"],
        check=True, stdout=subprocess.PIPE).stdout)
    value = said["value"]
    shots = [rows_of_shot(s, value["width"], value["height"]) for s in value["shots"]]
    own = [rows_of_png(folder / f"frame_{k:05}.png") for k in frames]
    print(json.dumps({
        "points": facts["points"], "points_drawn": value["drawn"], "errors": said["errors"],
        "page_bytes_per_point": page.stat().st_size / facts["points"],
        "frames_per_s": {k: statistics.median(v) for k, v in value["rates"].items()},
        "difference": [mean_difference(a, b) for a, b in zip(shots, own)],
        "similarity": [similarity(a, b) for a, b in zip(shots, own)],
        "step_beyond_own": [mean_difference(shots[k], shots[k + 1]) -
                            mean_difference(own[k], own[k + 1]) for k in range(len(own) - 1)],
    }, indent=2))


if __name__ == "__main__":
    main()
