"""Solids, trees and the CityJSON file of the sample town.

Everything is built in the town's own frame (metres, x along the streets, y across, z = height)
from faces: (semantic, [outer ring, inner ring, ...]), rings counter-clockwise seen from outside,
inner rings clockwise. `CityJson` turns, shifts and rounds them when they are added.
"""

import json
import math


def add(p, q, k=1.0):
    return (p[0] + k * q[0], p[1] + k * q[1])


def at(points, z):
    return [(x, y, z) for x, y in points]


def left_of(u):
    return (-u[1], u[0])


def inset(polygon, distance):
    """The counter-clockwise polygon with every edge moved inwards."""
    result = []
    for i, p in enumerate(polygon):
        before, after = polygon[i - 1], polygon[(i + 1) % len(polygon)]
        u, v = unit(before, p), unit(p, after)
        turn = u[0] * v[1] - u[1] * v[0]
        shift = (1.0 - (u[0] * v[0] + u[1] * v[1])) / turn
        result.append(add(add(p, left_of(u), distance), u, -distance * shift))
    return result


def unit(p, q):
    length = math.dist(p, q)
    return ((q[0] - p[0]) / length, (q[1] - p[1]) / length)


def rectangle(origin, u, width, depth):
    """Counter-clockwise; its first edge is the front, from `origin` along `u`."""
    v = left_of(u)
    p1 = add(origin, u, width)
    return [origin, p1, add(p1, v, depth), add(origin, v, depth)]


def wall(p, q, bottom, top, openings=(), apex=None):
    """A wall whose outside is to the right of p -> q, and the openings that fill its holes.

    openings: (semantic, start, sill, end, head), start and end measured from p; apex: the height
    of the top of a gable, above the middle.
    """
    u = unit(p, q)
    outer = [(*p, bottom), (*q, bottom), (*q, top)]
    if apex is not None:
        middle = add(p, u, math.dist(p, q) / 2)
        outer.append((*middle, apex))
    outer.append((*p, top))
    rings, faces = [outer], []
    for semantic, start, sill, end, head in openings:
        a, b = add(p, u, start), add(p, u, end)
        rings.append([(*a, sill), (*a, head), (*b, head), (*b, sill)])
        faces.append((semantic, [[(*a, sill), (*b, sill), (*b, head), (*a, head)]]))
    return [("WallSurface", rings)] + faces


def window_row(length, count, width, sill, head, margin=0.0):
    """`count` equal windows, evenly spaced along a wall."""
    pitch = (length - 2 * margin) / count
    starts = [margin + (i + 0.5) * pitch - width / 2 for i in range(count)]
    return [("Window", s, sill, s + width, head) for s in starts]


def ground(footprint, z, holes=()):
    rings = [at(reversed(footprint), z)] + [at(h, z) for h in holes]
    return [("GroundSurface", rings)]


def block(footprint, bottom, top, holes=(), semantic="RoofSurface"):
    """The extruded footprint: the LOD1 of a building. Holes are counter-clockwise."""
    faces = ground(footprint, bottom, holes)
    faces.append((semantic, [at(footprint, top)] + [at(list(reversed(h)), top) for h in holes]))
    for ring in [footprint] + [list(reversed(h)) for h in holes]:
        for p, q in zip(ring, ring[1:] + ring[:1]):
            faces += wall(p, q, bottom, top)
    return faces


def gabled(footprint, bottom, eaves, ridge, openings):
    """Ridge parallel to the first edge. openings: one list a wall, in the order of the footprint."""
    p0, p1, p2, p3 = footprint
    a1 = (*add(p1, unit(p1, p2), math.dist(p1, p2) / 2), ridge)
    a3 = (*add(p3, unit(p3, p0), math.dist(p3, p0) / 2), ridge)
    t = at(footprint, eaves)
    faces = ground(footprint, bottom)
    for i, (p, q) in enumerate(zip(footprint, footprint[1:] + footprint[:1])):
        faces += wall(p, q, bottom, eaves, openings[i], ridge if i % 2 else None)
    faces.append(("RoofSurface", [[t[0], t[1], a1, a3]]))
    faces.append(("RoofSurface", [[t[2], t[3], a3, a1]]))
    return faces


def hipped(footprint, bottom, eaves, ridge, openings):
    """Four equal slopes; a pyramid where the footprint is square. First edge the longer one."""
    p0, p1, p2, p3 = footprint
    half = math.dist(p1, p2) / 2
    u, v = unit(p0, p1), left_of(unit(p0, p1))
    r0 = (*add(add(p0, v, half), u, half), ridge)
    r1 = (*add(add(p1, v, half), u, -half), ridge)
    t = at(footprint, eaves)
    faces = ground(footprint, bottom)
    for i, (p, q) in enumerate(zip(footprint, footprint[1:] + footprint[:1])):
        faces += wall(p, q, bottom, eaves, openings[i])
    pyramid = math.dist(r0, r1) < 0.01
    slopes = [[t[0], t[1], r1, r0], [t[1], t[2], r1], [t[2], t[3], r0, r1], [t[3], t[0], r0]]
    for slope in slopes:
        faces.append(("RoofSurface", [slope[:3] if pyramid else slope]))
    return faces


def flat_with_parapet(footprint, bottom, roof, parapet, openings):
    """Flat roof `parapet` metres below the top of a parapet 0.3 m thick."""
    inner, top = inset(footprint, 0.3), roof + parapet
    faces = ground(footprint, bottom)
    for i, (p, q) in enumerate(zip(footprint, footprint[1:] + footprint[:1])):
        faces += wall(p, q, bottom, top, openings[i])
    faces.append(("RoofSurface", [at(footprint, top), at(reversed(inner), top)]))
    for p, q in zip(inner, inner[1:] + inner[:1]):
        faces += wall(q, p, roof, top)
    faces.append(("RoofSurface", [at(inner, roof)]))
    return faces


def perimeter_block(outer, inner, bottom, eaves, ridge, openings_outer, openings_inner):
    """Four wings about a courtyard under one ring of pitched roofs."""
    mid = [((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) for a, b in zip(outer, inner)]
    faces = ground(outer, bottom, [inner])
    for i in range(4):
        j = (i + 1) % 4
        faces += wall(outer[i], outer[j], bottom, eaves, openings_outer[i])
        faces += wall(inner[j], inner[i], bottom, eaves, openings_inner[i])
        faces.append(("RoofSurface", [[(*outer[i], eaves), (*outer[j], eaves), (*mid[j], ridge),
                                       (*mid[i], ridge)]]))
        faces.append(("RoofSurface", [[(*mid[i], ridge), (*mid[j], ridge), (*inner[j], eaves),
                                       (*inner[i], eaves)]]))
    return faces


def arched_bridge(x, width, stations):
    """A trough along y with solid rails; stations: (y, height of the deck)."""
    rail, thickness, height = 0.2, 0.35, 0.95
    profile = [(0, -thickness, None), (width, -thickness, "OuterCeilingSurface"),
               (width, height, "WallSurface"), (width - rail, height, "RoofSurface"),
               (width - rail, 0, "WallSurface"), (rail, 0, "OuterFloorSurface"),
               (rail, height, "WallSurface"), (0, height, "RoofSurface"),
               (0, -thickness, "WallSurface")]
    sections = [[(x + a, y, z + b) for a, b, _ in profile] for y, z in stations]
    faces = []
    for near, far in zip(sections, sections[1:]):
        for i in range(len(profile) - 1):
            faces.append((profile[i + 1][2], [[near[i], far[i], far[i + 1], near[i + 1]]]))
    faces.append(("WallSurface", [sections[0][:-1]]))
    faces.append(("WallSurface", [sections[-1][:-1][::-1]]))
    return faces


def spindle(rings, sides, phase=0.0):
    """Triangles of a closed surface of revolution; rings: (radius, z) upwards, ends of radius 0."""
    def point(ring, k):
        radius, z = ring
        angle = phase + 2 * math.pi * k / sides
        return (radius * math.cos(angle), radius * math.sin(angle), z)

    faces = []
    for lower, upper in zip(rings, rings[1:]):
        for k in range(sides):
            a, b = point(lower, k), point(lower, k + 1)
            d, c = point(upper, k), point(upper, k + 1)
            if lower[0] > 0:
                faces.append([a, b, d] if upper[0] == 0 else [a, b, c])
            if upper[0] > 0:
                faces.append([a, c, d])
    return faces


def tree_templates():
    """Of height and crown radius one metre: instances scale them. Broad crown, tall crown, conifer."""
    trunk = spindle([(0, -0.05), (0.08, -0.05), (0, 0.6)], 3)
    broad = spindle([(0, 0.25), (0.8, 0.38), (1.0, 0.62), (0.6, 0.88), (0, 1.0)], 6)
    tall = spindle([(0, 0.2), (1.0, 0.4), (0.65, 0.8), (0, 1.0)], 6, 0.4)
    conifer = spindle([(0, 0.15), (1.0, 0.18), (0, 1.0)], 7)
    return [trunk + broad, trunk + tall, trunk + conifer]


class CityJson:
    """Collects city objects; vertices are shared and whole millimetres."""

    def __init__(self, origin, turn_deg):
        self.origin = origin
        self.cos = math.cos(math.radians(turn_deg))
        self.sin = math.sin(math.radians(turn_deg))
        self.index, self.objects, self.templates, self.template_vertices = {}, {}, [], []

    def vertex(self, p):
        """Index of a town point: turned about the middle of the town, in millimetres."""
        x, y, z = p
        east, north = x * self.cos - y * self.sin, x * self.sin + y * self.cos
        key = (round(east * 1000), round(north * 1000), round(z * 1000))
        return self.index.setdefault(key, len(self.index))

    def surfaces(self, faces):
        return [[[self.vertex(p) for p in ring] for ring in rings] for _, rings in faces]

    def geometry(self, kind, lod, faces):
        """faces as above; semantics are left out where they are None."""
        boundaries, solid = self.surfaces(faces), kind == "Solid"
        result = {"type": kind, "lod": lod, "boundaries": [boundaries] if solid else boundaries}
        names = list(dict.fromkeys(semantic for semantic, _ in faces))
        if names != [None]:
            values = [names.index(semantic) for semantic, _ in faces]
            result["semantics"] = {"surfaces": [{"type": name} for name in names],
                                   "values": [values] if solid else values}
        return result

    def add(self, name, kind, geometry, attributes=None, parent=None):
        entry = {"type": kind}
        if attributes:
            entry["attributes"] = attributes
        if parent:
            entry["parents"] = [parent]
            self.objects[parent].setdefault("children", []).append(name)
        entry["geometry"] = geometry
        self.objects[name] = entry

    def add_template(self, triangles):
        seen = {}
        for triangle in triangles:
            for p in triangle:
                rounded = tuple(round(c, 4) + 0.0 for c in p)
                seen.setdefault(rounded, len(self.template_vertices) + len(seen))
        look_up = [[[seen[tuple(round(c, 4) + 0.0 for c in p)] for p in t]] for t in triangles]
        self.template_vertices += [list(v) for v in seen]
        self.templates.append({"type": "MultiSurface", "lod": "2", "boundaries": look_up})

    def instance(self, template, foot, radius, height, turn):
        c, s = round(radius * math.cos(turn), 4), round(radius * math.sin(turn), 4)
        matrix = [c, -s, 0, 0, s, c, 0, 0, 0, 0, round(height, 3), 0, 0, 0, 0, 1]
        return {"type": "GeometryInstance", "template": template,
                "boundaries": [self.vertex(foot)], "transformationMatrix": matrix}

    def text(self, metadata):
        """The file: one city object a line, so that changes can be read."""
        def dump(value):
            return json.dumps(value, separators=(",", ":"), sort_keys=False)

        vertices = [list(v) for v in self.index]
        low = [min(v[i] for v in vertices) for i in range(3)]
        high = [max(v[i] for v in vertices) for i in range(3)]
        scale, shift = 0.001, [self.origin[0], self.origin[1], 0.0]
        metadata = {"geographicalExtent": [round(v[i] * scale + shift[i], 3)
                                           for v in (low, high) for i in range(3)], **metadata}
        objects = ",\n".join(f"{dump(k)}:{dump(v)}" for k, v in self.objects.items())
        rows = [vertices[i:i + 8] for i in range(0, len(vertices), 8)]
        lines = ",\n".join(",".join(dump(v) for v in row) for row in rows)
        templates = dump({"templates": self.templates,
                          "vertices-templates": self.template_vertices})
        transform = dump({"scale": [scale] * 3, "translate": shift})
        return (f'{{"type":"CityJSON","version":"2.0",\n"transform":{transform},\n'
                f'"metadata":{dump(metadata)},\n"geometry-templates":{templates},\n'
                f'"CityObjects":{{\n{objects}\n}},\n"vertices":[\n{lines}\n]}}\n')
