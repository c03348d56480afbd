"""Maps of both sides of the comparison with CSCG, and the judge."""

import json
import math
import resource
import subprocess
import time
from collections import Counter
from typing import NamedTuple

import chmm_actions as chmm
import numpy as np
from cscg_walks import ACTIONS, COMMAND
from tolman import BumpMap

RESTARTS = 3
# As many clones of each look as the authors give a room of 6 x 8 cells, for its size.
CLONES = 70 / 48


class Learned(NamedTuple):
    """A map: by place and action the place beyond, and the place of each visit."""

    ways: dict
    places: list


class Score(NamedTuple):
    exact: bool
    purity: float
    # Places of the map for each true one.
    places: float
    seconds: float = 0


def judged(walk, learned):
    """Judge a map. It is exact if each place stands for one true place and each way leads where it truly leads."""
    visits = {}
    for place, cell in zip(learned.places, walk.cells):
        visits.setdefault(place, Counter())[cell] += 1
    pure = sum(count.most_common(1)[0][1] for count in visits.values())
    cell_of = {place: count.most_common(1)[0][0] for place, count in visits.items()}
    exact = pure == len(walk.cells) and all(
        place in cell_of and cell_of.get(beyond) == walk.world.beyond(cell_of[place], action)
        for (place, action), beyond in learned.ways.items()
    )
    return Score(exact, pure / len(walk.cells), len(visits) / len(set(walk.cells)))


def strictly(score):
    """Let a map be exact only if it has each place once."""
    return score._replace(exact=score.exact and score.places == 1)


def without_odometry(walk):
    """Score the map from actions, bumps and looks. A way that looks closed counts as a bump."""
    begun = time.process_time()
    look = walk.looks if walk.sees else [0] * len(walk.looks)
    bumps = BumpMap(look[0])
    for at, (action, moved) in enumerate(zip(walk.actions, walk.moved)):
        for closed in range(4) if walk.sees else ():
            if not look[at] >> closed & 1:
                bumps.learn(ACTIONS[closed], False, look[at])
        bumps.learn(ACTIONS[action], moved, look[at + 1])
    seconds = time.process_time() - begun
    ways = {}
    for place in bumps.places:
        for action, name in enumerate(ACTIONS):
            if bumps.way(place, name) != "untried":
                beyond = bumps.beyond(place, name)
                ways[place, action] = place if beyond is None else beyond
    places = followed(ways, bumps.start, walk.actions)
    assert places[-1] == bumps.here
    return strictly(judged(walk, Learned(ways, places)))._replace(seconds=seconds)


def with_odometry(walk):
    """Score the map of the diktiometry. The command makes it from the journal in its file, and takes these seconds."""
    begun = resource.getrusage(resource.RUSAGE_CHILDREN)
    shown = subprocess.run([COMMAND, "map", "show", "--json", walk.survey], check=True, stdout=subprocess.PIPE)
    ended = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = ended.ru_utime + ended.ru_stime - begun.ru_utime - begun.ru_stime
    told = json.loads(shown.stdout)
    links = [(place["id"], link) for place in told["places"] for link in place["links"]]
    ways = {(place, ACTIONS.index(link["action"])): link["to"] for place, link in links}
    # The first place has the lowest number, which it keeps when places merge.
    places = followed(ways, 0, walk.actions)
    assert places[-1] == told["here"]
    return strictly(judged(walk, Learned(ways, places)))._replace(seconds=seconds)


def followed(ways, start, actions):
    """Return the places of a walk on a map."""
    places = [start]
    for action in actions:
        places.append(ways[places[-1], action])
    return places


def cscg(walk, seed, odometry):
    """Score the best of some restarts. The judge chooses, which the model could not."""
    actions = with_lengths(walk) if odometry else walk.actions
    begun = time.process_time()
    runs = [trained(actions, walk.looks, walk.world.size, seed * RESTARTS + run) for run in range(RESTARTS)]
    seconds = time.process_time() - begun
    scores = [judged(walk, Learned(likeliest(walk.actions, states), states)) for states in runs]
    best = max(scores, key=lambda score: (score.exact, score.purity, -score.places))
    return best._replace(seconds=seconds)


def with_lengths(walk):
    """Return an action for each direction and length."""
    return [action + len(ACTIONS) * (length - 1) for action, length in zip(walk.actions, walk.lengths)]


def trained(actions, looks, size, seed):
    """Train as the authors do: EM, then Viterbi training. Return the state of each visit."""
    kinds = {look: kind for kind, look in enumerate(sorted(set(looks)))}
    x = np.array([kinds[look] for look in looks], dtype=np.int64)
    a = np.array([*actions, 0], dtype=np.int64)
    clones = np.full(len(kinds), math.ceil(CLONES * size), dtype=np.int64)
    model = chmm.CHMM(n_clones=clones, x=x, a=a, pseudocount=2e-3, seed=seed)
    model.learn_em_T(x, a, n_iter=1000)
    model.pseudocount = 0.0
    model.learn_viterbi_T(x, a, n_iter=100)
    return model.decode(x, a)[1]


def likeliest(actions, states):
    """Return where each way out of a state led most often."""
    targets = {}
    for action, state, beyond in zip(actions, states, states[1:]):
        targets.setdefault((state, action), Counter())[beyond] += 1
    return {way: count.most_common(1)[0][0] for way, count in targets.items()}
