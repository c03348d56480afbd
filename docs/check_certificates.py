"""Checks the refutations that `tolman audit` found, by nothing but the graph: python3 check_certificates.py GRAPH.g2o certificates.json"""
import gzip, json, math, sys

def product(a, b):  # of motions (x, y, heading)
    c, s = math.cos(a[2]), math.sin(a[2])
    return a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], a[2] + b[2]
def inverse(a):
    c, s = math.cos(a[2]), math.sin(a[2])
    return -c * a[0] - s * a[1], s * a[0] - c * a[1], -a[2]
def dot(a, b): return [[sum(x * y for x, y in zip(row, column)) for column in zip(*b)] for row in a]
def invert(m):  # 3 x 3, by cofactors
    cof = [[m[(j + 1) % 3][(i + 1) % 3] * m[(j + 2) % 3][(i + 2) % 3] - m[(j + 1) % 3][(i + 2) % 3] * m[(j + 2) % 3][(i + 1) % 3] for j in range(3)] for i in range(3)]
    return [[x / sum(m[0][k] * cof[k][0] for k in range(3)) for x in row] for row in cof]
def moved(a, cov):  # a covariance as seen from the frame that the motion a leaves
    c, s = math.cos(a[2]), math.sin(a[2]); ad = [[c, -s, a[1]], [s, c, -a[0]], [0, 0, 1]]
    return dot(dot(ad, cov), [list(row) for row in zip(*ad)])

graph, found = sys.argv[1], json.load(open(sys.argv[2]))
lines, odometry, scale = {}, {}, found["sigma_scale"] ** 2
for number, line in enumerate((gzip.open if graph.endswith(".gz") else open)(graph, "rt"), 1):
    word = line.split()
    if word and word[0] == "EDGE_SE2":
        a, b, c, d, e, f = map(float, word[6:12])
        edge = int(word[1]), int(word[2]), tuple(map(float, word[3:6])), [[x * scale for x in row] for row in invert([[a, b, c], [b, d, e], [c, e, f]])]
        lines[number] = edge; odometry.setdefault(frozenset(edge[:2]), edge)
for one in found["refuted"]:
    at, off, cov, steps = one["from"], (0, 0, 0), [[0] * 3] * 3, one["cycle"]["steps"]
    for step in steps:
        ids = range(step["from"], step["to"], 1 if step["to"] > step["from"] else -1)
        for edge in [lines[step["line"]]] if "line" in step else [odometry[frozenset((i, i + ids.step))] for i in ids]:
            forth = edge[0] == at; assert at in edge[:2], one
            motion, own = (edge[2], edge[3]) if forth else (inverse(edge[2]), moved(edge[2], edge[3]))
            at, off, cov = edge[1] if forth else edge[0], product(off, motion), [[x + y for x, y in zip(r, o)] for r, o in zip(moved(inverse(motion), cov), own)]
    half = (off[2] + math.pi) % (2 * math.pi) / 2 - math.pi / 2; along = half / math.tan(half) if abs(half) > 1e-9 else 1
    log = along * off[0] + half * off[1], along * off[1] - half * off[0], 2 * half
    chi2 = sum(x * y for x, y in zip(log, [row[0] for row in dot(invert(cov), [[x] for x in log])]))
    assert at == one["from"] and steps[0]["line"] == one["line"] and chi2 > 25 and abs(chi2 - one["cycle"]["chi2"]) < 1e-4 * chi2, (one["line"], chi2)
print(len(found["refuted"]), "refutations hold")
