"""Places and links of a floor: the skeleton of where the robot fits, pruned by clearance.

Source of the idea: Thrun, "Learning Metric-Topological Maps for Indoor Mobile Robot Navigation",
Artificial Intelligence 99 (1998), section 3, and for pruning by the disc of a junction Blum's
medial axis. Cells need be no cells of the world: it works on any floor.
"""

import numpy as np
from clearance import clearance
from thinning import thinned

AROUND = [(dx, dy) for dy in (-1, 0, 1) for dx in (-1, 0, 1) if dx or dy]
# A loop shorter than this many clearances goes around a speck.
SPECK = 4
# A landmark is that of a dead end if it is so near to it, in strides.
DEAD_END = 0.9


class FloorPlaces:
    """The graph of a floor; `marks` are the landmarks by name, with their positions, m.

    `floor` and `walls` are grids by row and column, `corner` has the numbers of the first column
    and row.
    `stride` is how far apart places on a link are, m.
    """

    def __init__(self, floor, walls, corner, cell, radius, stride, marks):
        self.corner, self.cell, self.stride = np.asarray(corner), cell, stride / cell
        self.clear = clearance(~without_pockets(floor, walls), most=4 * round(radius / cell) + 8)
        self.fits = self.clear >= radius / cell - 0.5
        self.places, self.links = {}, {}
        self.marked, self.kept = {}, {}
        pixels = reachable(self.fits, self.pixel((0.0, 0.0)))
        skeleton = thinned(pixels)
        if pixels.any() and not skeleton.any():  # A round or square room is thinned to nothing.
            skeleton.flat[np.where(pixels, self.clear, 0).argmax()] = True
        near = neighbours(skeleton)
        for name, position in marks:
            if near:
                row, column = self.pixel(position)
                at = min(near, key=lambda pixel: (pixel[0] - row) ** 2 + (pixel[1] - column) ** 2)
                self.marked[at], self.kept[at] = name, position
        self.trace(near)
        self.contract()
        self.reach_ends()
        self.part()

    def pixel(self, position):
        """Return the row and column of a position."""
        column, row = np.floor(np.asarray(position) / self.cell).astype(int) - self.corner
        return int(row), int(column)

    def position(self, pixel):
        """Return the middle of a pixel, m; of a landmark where it stands."""
        if pixel in self.kept:
            return [float(at) for at in self.kept[pixel]]
        return [float(at) for at in (np.array(pixel[::-1]) + self.corner + 0.5) * self.cell]

    def trace(self, near):
        """Follow the skeleton from each pixel where not just two ways meet to the next."""
        self.places = {at for at in near if len(near[at]) != 2 or at in self.marked}
        passed = set()
        for start in sorted(self.places):
            for after in sorted(near[start]):
                self.follow(near, [start, after], passed)
        for start in sorted(set(near) - passed - self.places):  # rings without a place
            if start not in passed:
                self.places.add(start)
                self.follow(near, [start, min(near[start])], passed)

    def follow(self, near, path, passed):
        while path[-1] not in self.places:
            path.append(next(at for at in near[path[-1]] if at != path[-2]))
        if (path[0], path[1]) not in passed:
            passed |= {(path[-1], path[-2]), *path[1:-1]}
            self.links[len(self.links)] = path

    def contract(self):
        """Let two places be one if the disc of clearance around one holds the other."""
        while True:
            links = sorted(self.links, key=lambda link: len(self.links[link]))
            short = next((link for link in links if self.is_short(self.links[link])), None)
            if short is not None:
                self.merge(self.links.pop(short))
            elif not self.dissolve():
                return

    def is_short(self, path):
        first, last = path[0], path[-1]
        if first == last:
            return length(path) < SPECK * self.clear[first]
        bare = [end for end in (first, last) if end not in self.marked]
        if len(bare) == 1 and self.degree(bare[0]) == 1:
            # The robot may have turned back as soon as it noticed the landmark of a dead end.
            return length(path) < DEAD_END * self.stride
        return bool(bare) and length(path) < max(self.clear[first], self.clear[last])

    def degree(self, place):
        return sum((path[0] == place) + (path[-1] == place) for path in self.links.values())

    def merge(self, path):
        first, last = path[0], path[-1]
        if first == last:
            return
        keeps = max(first, last, key=lambda at: (at in self.marked, self.clear[at], at))
        goes = last if keeps == first else first
        way = path if path[0] == keeps else path[::-1]
        self.places.discard(goes)
        for number, other in self.links.items():
            if other[0] == goes:
                other = way[:-1] + other
            if other[-1] == goes:
                other = other + way[-2::-1]
            self.links[number] = other

    def dissolve(self):
        """Join the two links of a place that only lies on a way. Return whether there was one."""
        for place in sorted(self.places - set(self.marked)):
            own = [link for link, path in self.links.items() for end in (path[0], path[-1]) if end == place]
            if len(own) == 2 and own[0] != own[1]:
                first, second = (self.links.pop(link) for link in own)
                first = first if first[-1] == place else first[::-1]
                second = second if second[0] == place else second[::-1]
                self.links[own[0]] = first + second[1:]
                self.places.discard(place)
                return True
        return False

    def reach_ends(self):
        """Move dead ends to the last cell that is as far from the walls as the way there.

        Thinning takes away the end of a line.
        """
        rows, columns = np.indices(self.clear.shape)
        for number, path in self.links.items():
            for way in (path, path[::-1]):
                end = way[-1]
                if end in self.marked or self.degree(end) != 1 or len(way) < 3:
                    continue
                back = way[max(0, len(way) - 1 - round(self.stride / 2))]
                wide = np.median([self.clear[at] for at in way[-round(self.stride / 2) :]])
                near = np.hypot(rows - end[0], columns - end[1]) <= self.stride / 2
                cells = np.argwhere(near & (self.clear >= wide - 0.5))
                if not len(cells):
                    continue
                far = ((cells - back) ** 2).sum(axis=1)
                row, column = cells[far >= far.max() - 1].mean(axis=0).round()
                if far.max() > (end[0] - back[0]) ** 2 + (end[1] - back[1]) ** 2:
                    self.kept[end] = (np.array([column, row]) + self.corner + 0.5) * self.cell

    def part(self):
        """Put places on the links, about a stride apart: a robot may be put down there, too."""
        for path in [self.links.pop(number) for number in list(self.links)]:
            parts = max(round(length(path) / self.stride), 2 if path[0] == path[-1] else 1)
            cuts = [round(part * (len(path) - 1) / parts) for part in range(parts + 1)]
            for first, last in zip(cuts, cuts[1:]):
                self.places |= {path[first], path[last]}
                self.links[len(self.links)] = path[first : last + 1]

    def map(self):
        """Return the map as the arena reads it."""
        ids = {pixel: number for number, pixel in enumerate(sorted(self.places))}
        marks = {at: self.marked.get(at) for at in ids}
        places = [{"id": ids[at], "position": self.position(at), "landmark": marks[at]} for at in ids]
        links = [[ids[path[0]], ids[path[-1]]] for path in self.links.values()]
        return {"places": places, "links": links}


def without_pockets(floor, walls):
    """Return the floor with the cells that no beam happened to pass among cells that are free."""
    for _ in range(2):
        near = sum(np.roll(floor, shift, (1, 0)).astype(int) for shift in AROUND)
        floor = floor | (~walls & (near >= 5))
    floor[[0, -1]] = floor[:, [0, -1]] = False
    return floor


def reachable(floor, start):
    """Return the part of a floor that is linked with the floor nearest to the start."""
    cells = np.argwhere(floor)
    if not len(cells):
        return floor
    begun = cells[np.argmin(((cells - start) ** 2).sum(axis=1))]
    seen = np.zeros_like(floor)
    seen[tuple(begun)] = True
    count = 0
    while seen.sum() != count:
        count = seen.sum()
        for _ in range(8):
            grown = seen.copy()
            for shift in AROUND:
                grown |= np.roll(seen, shift, (1, 0))
            seen = grown & floor
    return seen


def neighbours(skeleton):
    """Return the neighbours of each pixel, without the diagonals of a corner."""
    pixels = {(int(row), int(column)) for row, column in np.argwhere(skeleton)}
    near = {}
    for row, column in pixels:
        beside = {(row + dy, column + dx) for dx, dy in AROUND} & pixels
        straight = {at for at in beside if at[0] == row or at[1] == column}
        cut = {(y, x) for y, x in beside - straight if (y, column) in straight or (row, x) in straight}
        near[row, column] = beside - cut
    return near


def length(path):
    """Return the length of a path, in cells."""
    return sum(np.hypot(a[0] - b[0], a[1] - b[1]) for a, b in zip(path, path[1:]))
