import json, sys

middle = json.loads(sys.stdin.readline())["hello"]["corridor_width"] / 2

def nearest(ranges, first, last):  # m, between two bearings, degrees counter-clockwise from ahead
    return min(ranges[i * len(ranges) // 360] for i in range(first, last))

for line in sys.stdin:
    seen = json.loads(line)
    ranges = seen["sensing"]["scan"]["ranges"]
    ahead, right = nearest(ranges, -15, 15), nearest(ranges, -100, -40)
    if seen["landmark"] == "Goal":
        answer = {"done": True}
    elif ahead < 0.9 * middle:  # a wall ahead: to the left
        answer = {"turn": 0.2, "translate": 0.0}
    elif right > 1.6 * middle:  # an opening on the right: round the corner
        answer = {"turn": -0.25, "translate": 0.08}
    else:  # along the wall on the right
        answer = {"turn": 0.6 * (0.9 * middle - right), "translate": 0.08}
    print(json.dumps(answer), flush=True)
