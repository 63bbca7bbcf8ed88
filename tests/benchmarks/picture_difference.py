"""Reads Radiance pictures and tells how far two of them are apart. Needs nothing but Python 3.

Sources: G. Ward, "Real Pixels", Graphics Gems II, 1991 (the shared exponent); the Radiance
reference manual, "Picture file format" (header, run-length encoding); E. Reinhard et al.,
"Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002, equations 1, 2 and 4;
IEC 61966-2-1:1999 (sRGB).
"""

import dataclasses
import math
import statistics

# As tenku makes a PNG of a view: the geometric mean of the luminance becomes this, and this
# percentile of it white on the curve.
KEY, WHITE_PERCENTILE = 0.28, 99.5
LINEAR_WHITE_PERCENTILE = 99.0  # what is made white where differences are linear


class PictureError(Exception):
    """A file that is not such a picture; says which and why."""


@dataclasses.dataclass
class Picture:
    width: int
    height: int
    pixels: list  # of (r, g, b), linear, in rows from the top


def read_header(data, path):
    """@return  width, height, index of the first byte after the header"""
    end = data.find(b"\n\n")
    if not data.startswith((b"#?RADIANCE", b"#?RGBE")) or end < 0:
        raise PictureError(f"{path}: not a Radiance picture")
    if b"FORMAT=32-bit_rle_rgbe" not in data[:end]:
        raise PictureError(f"{path}: colours are not RGBE")
    resolution = data[end + 2:data.index(b"\n", end + 2)]
    words = resolution.split()
    if len(words) != 4 or words[0] != b"-Y" or words[2] != b"+X":
        raise PictureError(f"{path}: rows are not from the top, '{resolution.decode()}'")
    return int(words[3]), int(words[1]), end + 2 + len(resolution) + 1


def read_runs(data, at, width):
    """One of the four components of a scanline.

    @return  its bytes, index of the byte after them"""
    component = bytearray()
    while len(component) < width:
        count = data[at]
        if count > 128:
            component += data[at + 1:at + 2] * (count - 128)
            at += 2
        else:
            component += data[at + 1:at + 1 + count]
            at += 1 + count
    if len(component) != width:
        raise ValueError("a run goes beyond the end of its row")
    return component, at


def read_scanline(data, at, width):
    """@return  red, green, blue, exponent (each `width` bytes), index of the byte after them"""
    is_encoded = 8 <= width < 32768 and data[at:at + 2] == b"\2\2" and data[at + 2] < 128
    if not is_encoded:
        flat = data[at:at + 4 * width]
        return [flat[k::4] for k in range(4)], at + 4 * width
    at += 4
    components = []
    for _ in range(4):
        component, at = read_runs(data, at, width)
        components.append(component)
    return components, at


def read_picture(path):
    """Values as stored: what the header's EXPOSURE says is left alone.

    @throws PictureError  for anything but RGBE with rows from the top"""
    data = path.read_bytes()
    width, height, at = read_header(data, path)
    # A value is (mantissa + 1/2) / 256 * 2^(exponent - 128); exponent 0 is black.
    scale = [0.0] + [math.ldexp(1.0, e - 136) for e in range(1, 256)]
    pixels = []
    try:
        for _ in range(height):
            components, at = read_scanline(data, at, width)
            row = [((r + 0.5) * scale[e], (g + 0.5) * scale[e], (b + 0.5) * scale[e])
                   for r, g, b, e in zip(*components)]
            if len(row) != width:
                raise ValueError("the file ends too early")
            pixels += row
    except (IndexError, ValueError) as error:
        raise PictureError(f"{path}: {error}") from error
    return Picture(width, height, pixels)


def luminance(pixel):
    """Of linear Rec. 709 channels."""
    r, g, b = pixel
    return 0.2126 * r + 0.7152 * g + 0.0722 * b


def percentile(ordered, percent):
    return ordered[round(percent / 100.0 * (len(ordered) - 1))]


@dataclasses.dataclass
class Exposure:
    """How light becomes 8-bit sRGB codes on Reinhard's curve."""

    factor: float = 1.0
    white: float = 1.0  # exposed light that is the brightest code, at least 1

    @classmethod
    def of(cls, picture):
        lit = sorted(y for y in map(luminance, picture.pixels) if y > 0.0)
        if not lit:
            return cls()
        factor = KEY / math.exp(statistics.fmean(map(math.log, lit)))
        return cls(factor, max(1.0, factor * percentile(lit, WHITE_PERCENTILE)))

    def code(self, light):
        x = self.factor * max(light, 0.0)
        share = min(x * (1.0 + x / self.white ** 2) / (1.0 + x), 1.0)
        encoded = 12.92 * share if share <= 0.0031308 else 1.055 * share ** (1 / 2.4) - 0.055
        return math.floor(255.0 * encoded + 0.5)


@dataclasses.dataclass
class Difference:
    """Between the pixels of two pictures, in 1/255 of the range from black to white."""

    mean: float
    worst: float


def difference_of(those, these):
    each = [abs(a - b) for a, b in zip(those, these)]
    return Difference(statistics.fmean(each), max(each))


class Reference:
    """A picture that others are compared with, as a viewer sees them and linearly."""

    def __init__(self, picture):
        self.size = (picture.width, picture.height)
        self.exposure = Exposure.of(picture)
        self.white = percentile(sorted(map(luminance, picture.pixels)),
                                LINEAR_WHITE_PERCENTILE) or 1.0
        self.codes, self.levels = self.codes_of(picture), self.levels_of(picture)

    def codes_of(self, picture):
        """8-bit codes, all channels in one list, at the exposure of the reference."""
        known = {}  # a grey picture has few values
        codes = []
        for pixel in picture.pixels:
            for channel in pixel:
                if channel not in known:
                    known[channel] = self.exposure.code(channel)
                codes.append(known[channel])
        return codes

    def levels_of(self, picture):
        """Luminance, the reference's percentile of it being 255, clipped there."""
        return [min(255.0 * luminance(pixel) / self.white, 255.0) for pixel in picture.pixels]

    def differences_from(self, picture):
        """@return  of the screen codes, of the linear luminance"""
        if (picture.width, picture.height) != self.size:
            raise PictureError("the pictures differ in size")
        return (difference_of(self.codes_of(picture), self.codes),
                difference_of(self.levels_of(picture), self.levels))
