#!/usr/bin/env python3
"""Checks what townscape.py says of pictures against values worked out by hand from the sources
that picture_difference.py names. Prints one line a check, exit code 1 if any fails."""

import pathlib
import sys
import tempfile

from picture_difference import Exposure, Picture, PictureError, Reference, read_picture

HEADER = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n"
failures = 0


def check(condition, what):
    global failures
    failures += not condition
    print(("ok      " if condition else "FAILED  ") + what)


def read_bytes(data):
    with tempfile.TemporaryDirectory() as made:
        path = pathlib.Path(made) / "p.hdr"
        path.write_bytes(data)
        return read_picture(path)


def is_refused(data):
    try:
        read_bytes(data)
    except PictureError:
        return True
    return False


def check_reading():
    # Exponent 129 makes 2 / 256 = 1 / 128 a step, to which half a one is added; 0 is black.
    flat = read_bytes(HEADER + b"-Y 2 +X 1\n" + bytes([128, 64, 0, 129, 9, 9, 9, 0]))
    check((flat.width, flat.height) == (1, 2), "width and height")
    check(flat.pixels == [(128.5 / 128, 64.5 / 128, 0.5 / 128), (0, 0, 0)], "plain pixels")
    # Red: eight of 128 (a run: 128 + 8); green: three different and five of 7; then 0s and 136s,
    # which leaves the mantissas as they are.
    row = bytes([2, 2, 0, 8, 136, 128, 3, 1, 2, 3, 133, 7, 136, 0, 136, 136])
    packed = read_bytes(HEADER + b"-Y 2 +X 8\n" + 2 * row)
    check(packed.pixels == 2 * [(128.5, g + 0.5, 0.5) for g in (1, 2, 3, 7, 7, 7, 7, 7)],
          "runs of equal bytes")
    check(is_refused(HEADER + b"-Y 2 +X 8\n" + row), "a file that ends too early is refused")
    long_run = bytes([2, 2, 0, 8, 137, 128])
    check(is_refused(HEADER + b"-Y 1 +X 8\n" + long_run), "a run beyond its row is refused")
    check(is_refused(HEADER + b"+Y 1 +X 1\n" + bytes(4)), "rows from below are refused")
    check(is_refused(b"\x89PNG\r\n"), "another format is refused")


def check_screen():
    # Reinhard's curve at 1 with white at 2 is (1 + 1 / 4) / 2 = 0.625, sRGB 0.81237, code 207.2.
    check(Exposure(1.0, 2.0).code(1.0) == 207, "a half of white has code 207")
    # 0.0025 with white at 1 is itself, sRGB 12.92 as much, code 8.2.
    check(Exposure(0.5, 1.0).code(0.005) == 8, "the dark end is straight")
    codes = [Exposure(1.0, 2.0).code(light) for light in (0.0, 2.0, 1e6)]
    check(codes == [0, 255, 255], "black, white, and far above it")


def grey(*values):
    return Picture(len(values), 1, [(v, v, v) for v in values])


def check_differences():
    # The 99th percentile of 99 ones and a 50 is 1: the 50 is clipped, and a half is 127.5 away.
    reference = Reference(grey(*99 * [1.0], 50.0))
    _, linear = reference.differences_from(grey(*98 * [1.0], 0.5, 40.0))
    check(abs(linear.mean - 1.275) < 1e-9 and abs(linear.worst - 127.5) < 1e-9,
          "linear differences, clipped")
    # All of the reference is exposed to 0.28 with white at 1: sRGB 0.56573, code 144.3; what is
    # 1 / 0.28 as bright is white.
    seen, _ = Reference(grey(7.0, 7.0)).differences_from(grey(7.0, 7.0 / 0.28))
    check((seen.mean, seen.worst) == (55.5, 111), "screen differences, at one exposure")


def main():
    check_reading()
    check_screen()
    check_differences()
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
