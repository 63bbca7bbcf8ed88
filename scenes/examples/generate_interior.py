#!/usr/bin/env python3
"""Makes interiors for radiosity: generate_interior.py box|room|building --out FILE.obj

box       a closed room of 6 x 8 x 3 m: floor, ceiling, four walls.
room      the same with a table top, a cupboard on the floor and a luminaire: 18 faces, as many as
          the room of which the paper's tables 1 and 2 give times.
building  storeys of furnished rooms along corridors, with doors that stand open and windows: by
          default 10,300 polygons, as many as the paper's figure 3 has.

The paper, "A hemisphere base for form factors", says no more of its scenes than these numbers;
all else is chosen here. Colours are in interior_materials.toml. The same options give the same
bytes. Metres, z up. Needs nothing but Python 3.
"""

import argparse
import pathlib

ROOM = (6.0, 8.0, 3.0)
ROOM_WIDTH, ROOM_DEPTH, CORRIDOR, HEIGHT, WALL = 4.0, 5.5, 2.4, 2.8, 0.2
STOREY = HEIGHT + 0.4
DOOR = (2.6, 3.5, 2.1)              # from, to along the wall; height
WINDOW = (0.8, 3.2, 0.9, 2.3)       # from, to along the wall; sill, head


class Obj:
    """Polygons under names, written as OBJ."""

    def __init__(self, title):
        self.lines, self.vertices, self.faces = [f"# {title}"], 0, 0

    def begin(self, name):
        self.lines.append(f"o {name}")

    def face(self, material, *corners):
        """A polygon, counter-clockwise from its front."""
        self.lines += [f"v {x:.10g} {y:.10g} {z:.10g}" for x, y, z in corners]
        self.lines.append(f"usemtl {material}")
        count = len(corners)
        self.lines.append("f " + " ".join(str(k - count) for k in range(count)))
        self.faces += 1

    def text(self):
        return "\n".join(self.lines) + "\n"

    def level(self, material, x, y, z, up=True):
        """A level rectangle over two ranges."""
        corners = [(x[0], y[0], z), (x[1], y[0], z), (x[1], y[1], z), (x[0], y[1], z)]
        self.face(material, *(corners if up else corners[::-1]))

    def wall(self, material, a, b, z):
        """An upright rectangle over the line from a to b; its front is to the right of the line."""
        self.face(material, (*a, z[0]), (*b, z[0]), (*b, z[1]), (*a, z[1]))

    def solid(self, material, x, y, z, bottom=True, top=True):
        """A cuboid that faces outwards."""
        corners = [(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])]
        for a, b in zip(corners, corners[1:] + corners[:1]):
            self.wall(material, a, b, z)
        if top:
            self.level(material, x, y, z[1])
        if bottom:
            self.level(material, x, y, z[0], up=False)


def add_box(obj, size):
    width, depth, height = size
    obj.begin("room")
    obj.level("floor", (0, width), (0, depth), 0)
    obj.level("ceiling", (0, width), (0, depth), height, up=False)
    corners = [(0, 0), (0, depth), (width, depth), (width, 0)]
    for a, b in zip(corners, corners[1:] + corners[:1]):
        obj.wall("wall", a, b, (0, height))


def box():
    obj = Obj("Closed room")
    add_box(obj, ROOM)
    return obj


def room():
    obj = Obj("Room with a table top, a cupboard and a luminaire: 18 faces")
    add_box(obj, ROOM)
    obj.begin("table")
    obj.solid("wood", (2.0, 4.0), (3.0, 5.0), (0.7, 0.8))
    obj.begin("cupboard")
    obj.solid("wood", (4.8, 5.8), (6.0, 7.5), (0.0, 1.6), bottom=False)
    obj.begin("luminaire")
    obj.level("light", (2.0, 4.0), (3.5, 4.5), 2.98, up=False)
    return obj


def place(x0, y0, flip):
    """From metres in a room, the corridor at y = 0, to the building; the other side is turned."""
    if flip:
        return lambda x, y: (x0 + ROOM_WIDTH - x, y0 - y)
    return lambda x, y: (x0 + x, y0 + y)


class Room:
    """Room of a building: what is in it is placed in its own metres."""

    def __init__(self, obj, at, z):
        self.obj, self.at, self.z = obj, at, z

    def range(self, x, y):
        a, b = self.at(x[0], y[0]), self.at(x[1], y[1])
        return tuple(sorted((a[0], b[0]))), tuple(sorted((a[1], b[1])))

    def solid(self, material, x, y, z, **which):
        heights = (self.z + z[0], self.z + z[1])
        self.obj.solid(material, *self.range(x, y), heights, **which)

    def level(self, material, x, y, z, up):
        self.obj.level(material, *self.range(x, y), self.z + z, up=up)

    def panel(self, material, *corners):
        self.obj.face(material, *((*self.at(x, y), self.z + z) for x, y, z in corners))

    def shell(self):
        w, d, h = ROOM_WIDTH, ROOM_DEPTH, HEIGHT
        self.level("floor", (0, w), (0, d), 0, True)
        self.level("ceiling", (0, w), (0, d), h, False)
        self.panel("wall", (0, 0, 0), (0, d, 0), (0, d, h), (0, 0, h))
        self.panel("wall", (w, d, 0), (w, 0, 0), (w, 0, h), (w, d, h))
        self.door_wall(0.0)
        self.window_wall(d)

    def door_wall(self, y):
        w, h, (a, b, top) = ROOM_WIDTH, HEIGHT, DOOR
        self.panel("wall", (w, y, 0), (b, y, 0), (b, y, top), (a, y, top), (a, y, 0), (0, y, 0),
                   (0, y, h), (w, y, h))
        self.panel("wall", (a, y - WALL, 0), (a, y, 0), (a, y, top), (a, y - WALL, top))
        self.panel("wall", (b, y, 0), (b, y - WALL, 0), (b, y - WALL, top), (b, y, top))
        self.panel("wall", (a, y - WALL, top), (a, y, top), (b, y, top), (b, y - WALL, top))
        self.panel("floor", (a, y - WALL, 0), (b, y - WALL, 0), (b, y, 0), (a, y, 0))

    def window_wall(self, y):
        # Four strips about the opening, as OBJ has no holes; the mesh joins them.
        w, h, (a, b, sill, head) = ROOM_WIDTH, HEIGHT, WINDOW
        for x, z in (((0, a), (0, h)), ((b, w), (0, h)), ((a, b), (0, sill)), ((a, b), (head, h))):
            self.panel("wall", (x[0], y, z[0]), (x[1], y, z[0]), (x[1], y, z[1]), (x[0], y, z[1]))
        self.panel("window", (a, y, sill), (b, y, sill), (b, y, head), (a, y, head))

    def desk(self, x, y):
        self.solid("wood", (x, x + 1.6), (y, y + 0.8), (0.70, 0.74))
        for dx in (0.05, 1.50):
            for dy in (0.05, 0.70):
                self.solid("metal", (x + dx, x + dx + 0.05), (y + dy, y + dy + 0.05), (0.0, 0.70),
                           bottom=False, top=False)

    def chair(self, x, y):
        self.solid("wood", (x, x + 0.45), (y, y + 0.45), (0.43, 0.46))
        self.solid("wood", (x, x + 0.45), (y + 0.42, y + 0.45), (0.46, 0.90), bottom=False)
        for dx in (0.0, 0.41):
            for dy in (0.0, 0.41):
                self.solid("metal", (x + dx, x + dx + 0.04), (y + dy, y + dy + 0.04), (0.0, 0.43),
                           bottom=False, top=False)

    def furnish(self, shelves):
        self.desk(0.4, 3.6)
        self.desk(2.1, 3.6)
        self.chair(1.0, 3.0)
        self.chair(2.7, 3.0)
        self.solid("wood", (0.05, 0.45), (0.4, 2.0), (0.0, 1.9), bottom=False)
        self.solid("wood", (0.05, 0.45), (2.1, 2.9), (0.0, 0.8), bottom=False)
        for z in (1.2, 1.6) if shelves else ():
            self.solid("wood", (3.68, 3.98), (0.8, 2.3), (z, z + 0.03))
        self.level("light", (1.4, 2.6), (2.4, 2.7), HEIGHT - 0.02, False)


def add_corridor(obj, z, rooms):
    """Between two rows of rooms: a wall with all doors on either side."""
    length = rooms * (ROOM_WIDTH + WALL) - WALL
    a, b, top = DOOR
    obj.level("floor", (0, length), (0, CORRIDOR), z)
    obj.level("ceiling", (0, length), (0, CORRIDOR), z + HEIGHT, up=False)
    obj.wall("wall", (0, 0), (0, CORRIDOR), (z, z + HEIGHT))
    obj.wall("wall", (length, CORRIDOR), (length, 0), (z, z + HEIGHT))
    for y, flip in ((CORRIDOR, False), (0.0, True)):
        outline = [(0.0, z)]
        for k in range(rooms):
            at = place(k * (ROOM_WIDTH + WALL), 0.0, flip)
            low, high = sorted((at(a, 0.0)[0], at(b, 0.0)[0]))
            outline += [(low, z), (low, z + top), (high, z + top), (high, z)]
        outline += [(length, z), (length, z + HEIGHT), (0.0, z + HEIGHT)]
        corners = [(x, y, height) for x, height in outline]
        obj.face("wall", *(corners[::-1] if flip else corners))


def building(storeys, rooms):
    obj = Obj(f"Building of {storeys} storeys, {2 * rooms} rooms each")
    for storey in range(storeys):
        z = storey * STOREY
        obj.begin(f"corridor_{storey + 1}")
        add_corridor(obj, z, rooms)
        for side, (y0, flip) in enumerate(((CORRIDOR + WALL, False), (-WALL, True))):
            for k in range(rooms):
                made = Room(obj, place(k * (ROOM_WIDTH + WALL), y0, flip), z)
                name = f"{storey + 1}{side * rooms + k + 1:02d}"
                obj.begin(f"room_{name}")
                made.shell()
                obj.begin(f"furniture_{name}")
                made.furnish(shelves=k % 7 != 6)
    return obj


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kind", choices=("box", "room", "building"))
    parser.add_argument("--storeys", type=int, default=3, help="of the building")
    parser.add_argument("--rooms", type=int, default=14, help="on either side of a corridor")
    parser.add_argument("--out", type=pathlib.Path, required=True, metavar="FILE.obj")
    options = parser.parse_args()
    if options.storeys < 1 or options.rooms < 1:
        parser.error("--storeys and --rooms must be at least 1")
    made = {"box": box, "room": room}.get(
        options.kind, lambda: building(options.storeys, options.rooms))()
    options.out.write_bytes(made.text().encode())
    print(f"{made.faces} faces")


if __name__ == "__main__":
    main()
