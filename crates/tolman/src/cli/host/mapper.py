import json, math, statistics, sys

wide = json.loads(sys.stdin.readline())["hello"]["corridor_width"]  # m; the cells of the grid are as wide
seen, marks, x, y = {}, {(0, 0): None}, 0.0, 0.0  # votes for ways between cells; cells to keep; the robot, in cells

def look(scan, heading):  # the ways that beams pass, 1, or find shut, -1, and how far x and y are off the walls
    ways, off = {}, ([0.0], [0.0])
    for beam, reach in enumerate(scan["ranges"]):
        bearing, met = heading + beam * scan["ring"]["spacing"], reach < scan["ring"]["max_range"]
        dx, dy, reach, last = math.cos(bearing), math.sin(bearing), reach / wide, (round(x), round(y))
        for far in (0.05 * step for step in range(1, int(20 * reach + 4 * met))):
            px, py = x + far * dx, y + far * dy
            at, aside = (round(px), round(py)), min(abs(px - round(px)), abs(py - round(py)))
            if abs(at[0] - last[0]) + abs(at[1] - last[1]) == 1 and aside < 0.25:  # not by a corner
                ways[frozenset([last, at])] = 1 if far < reach - 0.1 else -1
            last = at
        hit = (x + reach * dx) % 1 - 0.5, (y + reach * dy) % 1 - 0.5
        for axis in (axis for axis in (0, 1) if met and abs(hit[1 - axis]) > 0.25):  # in the middle of a wall
            off[axis].append(hit[axis])
    return ways, [statistics.median(far) for far in off]

def places_and_links():  # the cells where not just two ways meet, and the corridors between them
    near = {cell: [to for way in seen if seen[way] > 0 and cell in way for to in way - {cell}] for way in seen for cell in way}
    ids = {cell: id for id, cell in enumerate(near) if len(near[cell]) not in (0, 2) or cell in marks}
    end = lambda last, at: at if at in ids else end(at, next(to for to in near[at] if to != last))
    place = lambda cell: {"id": ids[cell], "position": [cell[0] * wide, cell[1] * wide], "landmark": marks.get(cell)}
    links = [[ids[cell], ids[end(cell, at)]] for cell in ids for at in near[cell]]
    return {"places": [place(cell) for cell in ids], "links": links}

for told in map(json.loads, sys.stdin):
    answer = {"map": places_and_links()} if "map" in told["ask"] else {}
    if "belief" in told["ask"] and told["task"] == "explore":
        along, rolled = told["sensing"]["compass"], told["sensing"]["odometry"]["distance"] / wide
        x, y = x + rolled * math.cos(along), y + rolled * math.sin(along)
        ways, off = look(told["sensing"]["scan"], along)
        x, y, seen = x - off[0], y - off[1], {**seen, **{way: seen.get(way, 0) + ways[way] for way in ways}}
        marks.update({(round(x), round(y)): told["landmark"]} if told["landmark"] else {})
        answer["belief"] = [{"point": [x * wide, y * wide]}]
    print(json.dumps({"answer": answer}), flush=True)
