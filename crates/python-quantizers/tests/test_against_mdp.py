"""The growing neural gas beside that of MDP: as good, and faster by orders of magnitude."""

import math
import time

import numpy as np
import pytest
from tolman_quantizers import GNG

mdp = pytest.importorskip("mdp", reason="MDP needs numpy 1.23 or older", exc_type=Exception)

UNITS, INPUTS, PERIOD = 1000, 25_000, 20
CALL = 1000


def rate(learn, inputs, chunk, seconds=1.0):
    """Return the inputs learnt per second of processor time, in calls of `chunk` rows."""
    calls = [inputs[at : at + chunk] for at in range(0, len(inputs), chunk)]
    learnt, begun = 0, time.process_time()
    while True:
        for call in calls:
            learn(call)
            learnt += len(call)
            spent = time.process_time() - begun
            if spent > seconds:
                return learnt / spent


@pytest.fixture(scope="module")
def beside():
    """Train both with the same inputs and the values of Fritzke 1995, then measure their speed."""
    inputs = np.random.default_rng(2).random((INPUTS, 2))
    theirs = mdp.nodes.GrowingNeuralGasNode(
        start_poss=[inputs[0], inputs[1]], eps_b=0.2, eps_n=0.006, max_age=50, lambda_=PERIOD, alpha=0.5, d=0.995, max_nodes=UNITS
    )
    # MDP sums distances that are not squared.
    ours = GNG(max_units=UNITS, growth_period=PERIOD, error="absolute", n_epochs=1)
    theirs.train(inputs)
    ours.fit(inputs)
    positions = theirs.get_nodes_position()
    assert len(positions) == len(ours.units_) == UNITS
    squared = [np.min(((positions - row) ** 2).sum(axis=1)) for row in inputs]
    error = {"theirs": float(np.mean(squared)), "ours": ours.quantization_error(inputs)}
    speed = {
        "theirs": rate(theirs.train, inputs, CALL, seconds=3.0),
        "calls": rate(ours.partial_fit, inputs, CALL),
        "rows": rate(ours.partial_fit, inputs, 1),
    }
    print()
    print("| learner | inputs/s | faster than MDP by | MSE | MSE / MDP's |")
    print("| --- | ---: | ---: | ---: | ---: |")
    for name, way in (("MDP 3.6", "theirs"), (f"calls of {CALL} rows", "calls"), ("row by row", "rows")):
        mse = error["theirs" if way == "theirs" else "ours"]
        print(f"| {name} | {speed[way]:,.0f} | {speed[way] / speed['theirs']:,.0f} | {mse:.5g} | {mse / error['theirs']:.3f} |")
    return error, speed


def test_it_is_as_good(beside):
    error, _ = beside
    assert math.isclose(error["ours"], error["theirs"], rel_tol=0.02), error


def test_it_is_faster(beside):
    _, speed = beside
    assert speed["calls"] >= 1000 * speed["theirs"], speed
    assert speed["rows"] >= 20 * speed["theirs"], speed
