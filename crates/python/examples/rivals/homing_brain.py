"""A brain for the arena that maps by hW-inference, from moves, bumps and landmarks alone.

    pip install numpy aalpy
    tolman arena --brain 'python3 homing_brain.py' --family perfect

Source: Groz, Bremond, Simao, Oriat, "hW-inference: A heuristic approach to retrieve models through
black box testing", Journal of Systems and Software 159 (2020), as AALpy (`run_hW`) has it. It needs
a laser, a compass, odometry from cell to cell, and a world of cells. What it learns from is which
moves failed and what stood where; dead reckoning drives, and tells the judge where a place is.
"""

import queue
import random
import threading
from collections import Counter

import wire
from aalpy.base import SUL
from aalpy.learning_algs.resetless.hW import run_hW
from aalpy.learning_algs.resetless.resetless_oracles import RandomWphWOracle
from cell_walk import SIDES, CellWalk
from wheels import Wheels

# How near the middle of a cell it ends a move, and how far it backs off a wall, in cells.
MIDDLE, BACK = 0.12, 0.1
# Moves after which it gives up finding itself.
MOST_MOVES = 300


class Moves(SUL):
    """The robot as the learner has it: it asks for moves, and waits for what came of them."""

    def __init__(self):
        super().__init__()
        self.asked, self.made = queue.Queue(), queue.Queue()
        self.learned = None

    def pre(self):
        """Stay: nobody carries the robot back."""

    def post(self):
        """Stay."""

    def step(self, letter):
        """Ask for a move, and return whether it was made and which landmark is there."""
        self.asked.put(letter)
        return self.made.get()

    def learn(self):
        """Learn the automaton."""
        oracle = RandomWphWOracle(random_walk_length=20, num_test_origin_states=20)
        sides = range(len(SIDES))
        options = {"query_for_initial_state": False, "print_level": 0}
        self.learned = run_hW(list(sides), self, oracle, "mealy", **options)
        self.asked.put(None)


class HomingBrain:
    def __init__(self, hello):
        self.width, self.wheels = hello.corridor_width, Wheels()
        self.walk, self.moves = CellWalk(self.width), Moves()
        self.side, self.goal = None, None
        # The moves so far: the cell before, the side, and what came of it.
        self.story = []
        # The states in which it may be, and its moves since it was put down.
        self.states, self.count = [], 0
        random.seed(0)
        threading.Thread(target=self.moves.learn, daemon=True).start()

    def act(self, told):
        """Return the belief and the command."""
        sensing = told["sensing"]
        if sensing["compass"] is None:
            return [], self.wheels.command(0, 0)
        if told["put_down"]:  # This reading is still from before the lift.
            self.walk, self.side = CellWalk(self.width), None
            self.states, self.count = list(self.automaton()), 0
            return [], self.wheels.command(0, 0)
        self.wheels.learn(wire.motion(sensing), sensing["bump"])
        self.walk.step(sensing, told["landmark"])
        if told["task"] == "explore":
            command = self.drive(sensing, self.told)
            return [{"point": self.walk.point}], command
        reach = self.home if told["task"] == "reach-goal" else self.localize
        command = self.drive(sensing, reach)
        weight = 1 / max(1, len(self.states))
        return [{"place": self.numbers[state], "weight": weight} for state in self.states[:8]], command

    def drive(self, sensing, next_side):
        """Go on with the move under way, or begin the next. A shut side is a bump."""
        if sensing["bump"]:
            return self.wheels.command(0.3, -BACK * self.width)
        walk = self.walk
        while True:
            if self.side is None:
                self.side = next_side()
                if not isinstance(self.side, int):
                    command, self.side = self.side, None
                    return command
                cell, look = walk.cells[-1], walk.looks[-1]
                is_open = bool(look) and look[0][self.side]
                step = SIDES[self.side] if is_open else (0, 0)
                self.before, self.goal = cell, (cell[0] + step[0], cell[1] + step[1])
            off = [to - at - by for to, at, by in zip(self.goal, walk.cells[-1], (walk.x, walk.y))]
            if max(map(abs, off)) > MIDDLE:
                return self.wheels.toward(off[0] * self.width, off[1] * self.width, sensing["compass"])
            self.end_move()

    def end_move(self):
        """Tell what came of a move."""
        look = self.walk.looks[-1]
        made = (self.goal != self.before, look and look[1])
        if self.moves.learned is None:
            self.story.append((self.before, self.side, made))
            self.moves.made.put(made)
        else:
            self.states = [on for on in map(lambda state: follow(state, self.side, made), self.states) if on]
            self.states = list(dict.fromkeys(self.states)) or list(self.automaton())
            self.count += 1
        self.side = None

    def told(self):
        """Return the move for which the learner asks."""
        side = self.moves.asked.get()
        return {"done": True} if side is None else side

    def localize(self):
        """Move at random until one state is left."""
        if len(self.states) == 1:
            return {"done": True}
        if self.count > MOST_MOVES:
            return {"give_up": "places look alike"}
        return self.at_random()

    def home(self):
        """Go to the goal by the automaton."""
        look = self.walk.looks[-1]
        if look and look[1] == "Goal":
            return {"done": True}
        if len(self.states) != 1:
            return self.localize()
        first, left = {self.states[0]: None}, [self.states[0]]
        for state in left:
            for side, on in state.transitions.items():
                if on not in first:
                    first[on] = side if first[state] is None else first[state]
                    if state.output_fun[side][1] == "Goal":
                        return first[on]
                    left.append(on)
        return {"give_up": "no way to the goal on the map"}

    def at_random(self):
        """Return a side that is open."""
        look = self.walk.looks[-1]
        sides = [side for side, is_open in enumerate(look[0] if look else ()) if is_open]
        return random.choice(sides or range(len(SIDES)))

    def automaton(self):
        """Return the states that were learned."""
        return self.moves.learned.states if self.moves.learned else []

    def map(self):
        """Return the states, and the moves between them. What it began with shows which they were."""
        self.numbers = {state: at for at, state in enumerate(self.automaton())}
        where, marks = {}, {}
        for state in self.states_passed():
            for (cell, side, made), (at, on) in zip(self.story, state):
                where.setdefault(at, Counter())[cell] += 1
                marks[on] = made[1]
        places = [
            {
                "id": self.numbers[state],
                "position": [part * self.width for part in cells.most_common(1)[0][0]],
                "landmark": marks.get(state),
            }
            for state, cells in where.items()
        ]
        links = {
            tuple(sorted((self.numbers[state], self.numbers[on])))
            for state in where
            for side, on in state.transitions.items()
            if state.output_fun[side][0]
        }
        return {"places": places, "links": sorted(links)}

    def states_passed(self):
        """Yield the states that the story passed, from the state that explains all of it."""
        for state in self.automaton():
            passed, at = [], state
            for _, side, made in self.story:
                on = follow(at, side, made)
                if on is None:
                    break
                passed.append((at, on))
                at = on
            else:
                yield passed
                return


def follow(state, side, made):
    """Return the state after a move, or `None` if it would have come out otherwise."""
    return state.transitions[side] if state.output_fun[side] == made else None


if __name__ == "__main__":
    wire.drive(HomingBrain(wire.hello()))
