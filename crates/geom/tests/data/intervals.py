"""Writes intervals.json: operations on intervals with the tightest result that doubles can bound, worked out by
mpmath with 2400 bits. Run: pip install mpmath && python3 intervals.py > intervals.json"""

import json
import math
import random

from mpmath import cos, mp, mpf, pi, sin, sqrt

mp.prec = 2400
random.seed(20)


def below(exact):
    """The greatest double that is not above."""
    near = float(exact)
    if math.isinf(near):
        return near if near < 0 else 1.7976931348623157e308
    return math.nextafter(near, -math.inf) if mpf(near) > exact else near


def above(exact):
    return -below(-exact)


def extremes(function, low, high, critical):
    """Bounds of a function over an interval, given where it has extremes."""
    values = [function(mpf(low)), function(mpf(high))]
    values += [function(c) for c in critical]
    return min(values), max(values)


def of_sine(low, high):
    quarters = range(math.floor(low / (math.pi / 2)) - 1, math.ceil(high / (math.pi / 2)) + 2)
    return [q * pi / 2 for q in quarters if q % 2 == 1 and mpf(low) <= q * pi / 2 <= mpf(high)]


def of_cosine(low, high):
    quarters = range(math.floor(low / (math.pi / 2)) - 1, math.ceil(high / (math.pi / 2)) + 2)
    return [q * pi / 2 for q in quarters if q % 2 == 0 and mpf(low) <= q * pi / 2 <= mpf(high)]


def value():
    kind = random.random()
    if kind < 0.1:
        return float(random.randint(-3, 3))
    if kind < 0.2:
        return random.choice([-1, 1]) * math.ldexp(random.random(), random.randint(-1060, 500))
    return random.choice([-1, 1]) * math.ldexp(1 + random.random(), random.randint(-30, 30))


def interval(draw=value):
    a, b = draw(), draw()
    return (min(a, b), max(a, b)) if random.random() < 0.9 else (a, a)


def corners(function, a, b):
    values = [function(mpf(x), mpf(y)) for x in a for y in b]
    return min(values), max(values)


cases = []


def case(operation, a, b, result):
    cases.append([operation, *a, *(b or (0.0, 0.0)), below(result[0]), above(result[1])])


for _ in range(120):
    a, b = interval(), interval()
    case("add", a, b, corners(lambda x, y: x + y, a, b))
    case("sub", a, b, corners(lambda x, y: x - y, a, b))
    case("mul", a, b, corners(lambda x, y: x * y, a, b))
    if not b[0] <= 0 <= b[1]:
        case("div", a, b, corners(lambda x, y: x / y, a, b))
    root = (abs(a[0]), abs(a[0]) + abs(b[0]))
    case("sqrt", root, None, (sqrt(mpf(root[0])), sqrt(mpf(root[1]))))
for _ in range(250):
    span = random.choice([3.2, 10.0, 100.0, 1e5])
    low = random.uniform(-span, span)
    width = random.choice([0.0, 1e-12, 1e-3, 0.3, 2.0, 6.0])
    a = (low, low + random.random() * width)
    case("sin", a, None, extremes(sin, *a, of_sine(*a)))
    case("cos", a, None, extremes(cos, *a, of_cosine(*a)))
print("[")
print(",\n".join(json.dumps(c) for c in cases))
print("]")
