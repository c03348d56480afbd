"""A mapper for the arena that learns a clone-structured cognitive graph of the cells it passes.

    tolman arena --mapper 'python3 cscg.py' --family office
    tolman arena --mapper 'python3 cscg.py --odometry' --family office

Source: clone_graph.py. It needs a laser, a compass, odometry from cell to cell, a world of cells,
and numpy. With `--odometry` a look names its cell by dead reckoning, so that it has one clone.
Without, dead reckoning only tells the judge where a place was seen.
"""

import sys
from collections import Counter

import numpy as np
import wire
from cell_walk import SIDES, CellWalk
from clone_graph import CloneGraph

# Most clones of a look (the paper's rooms have 70).
CLONES = 70
# Restarts of EM. The likeliest model is taken.
RESTARTS = 3


class CscgMapper:
    def __init__(self, width, odometry):
        self.width, self.odometry = width, odometry
        self.walk, self.later = CellWalk(width), None
        self.graph = None

    def explore(self, told):
        """Note a step, and return where dead reckoning has the robot."""
        self.walk.step(told["sensing"], told["landmark"])
        return [{"point": self.walk.point}]

    def learn(self):
        """Learn from the whole walk."""
        walk = self.walk
        seen = list(zip(walk.looks, walk.cells)) if self.odometry else walk.looks
        self.kinds = {look: kind for kind, look in enumerate(sorted(set(seen), key=str))}
        looks = [self.kinds[look] for look in seen]
        counts = Counter(looks)
        clones = [1 if self.odometry else min(CLONES, counts[kind]) for kind in range(len(counts))]
        tries = []
        for seed in range(1 if self.odometry else RESTARTS):
            graph = CloneGraph(clones, len(SIDES), seed)
            tries.append((graph.learn(looks, walk.actions), seed, graph))
        _, _, self.graph = max(tries)
        self.states, _ = self.graph.viterbi(looks, walk.actions)

    def map(self):
        """Return the states of the likeliest path, and the moves between them."""
        if self.graph is None:
            self.learn()
        where, marks = {}, {}
        for state, cell, look in zip(self.states.tolist(), self.walk.cells, self.walk.looks):
            where.setdefault(state, Counter())[cell] += 1
            marks[state] = look and look[1]
        places = []
        for state, cells in where.items():
            column, row = cells.most_common(1)[0][0]
            position = [column * self.width, row * self.width]
            places.append({"id": state, "position": position, "landmark": marks[state]})
        links = {tuple(sorted(link)) for link in zip(self.states.tolist(), self.states.tolist()[1:])}
        return {"places": places, "links": sorted(links)}

    def localize(self, told):
        """Return the belief over the states after the moves since the robot was put down."""
        if told["put_down"]:  # This reading is still from before the lift.
            self.later = CellWalk(self.width)
            return []
        self.later.step(told["sensing"], told["landmark"])
        visits = np.bincount(self.states, minlength=self.graph.starts[-1])
        belief = (visits > 0) / (visits > 0).sum()
        for at, look in enumerate(self.later.looks):
            if at:
                belief = belief @ self.graph.transitions[self.later.actions[at - 1]]
            fits = np.zeros(len(belief), bool)
            for kind, number in self.kinds.items():
                fits[self.graph.states_of(number)] = look == (kind[0] if self.odometry else kind)
            belief = belief * fits
            if not belief.any():  # A look that no place has here says nothing.
                belief = (visits > 0) * 1.0
            belief /= belief.sum()
        order = (-belief).argsort(kind="stable")[:8]
        return [{"place": int(at), "weight": min(1.0, float(belief[at]))} for at in order if belief[at] > 0]


if __name__ == "__main__":
    wire.watch(CscgMapper(wire.hello().corridor_width, "--odometry" in sys.argv[1:]))
