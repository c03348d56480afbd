"""The quantizers beside what a Python user would choose otherwise: speed, and quality on scikit-learn's own sets.

    OMP_NUM_THREADS=1 python crates/python-quantizers/benches/against_rivals.py [--seconds 1.0] [--quality]

compares with whichever of MiniBatchKMeans, MDP 3.6, minigng, neupy 0.8 and minisom is installed; MDP needs numpy 1.23, and
neupy imports TensorFlow, which its growing neural gas does not use. Rates are rows a second of processor time with all
units there, medians of three, learners in turn. All rows are printed, not the best.
"""

import argparse
import sys
import time
import warnings
from unittest.mock import MagicMock

import numpy as np
from sklearn.cluster import MiniBatchKMeans
from sklearn.datasets import load_digits, make_blobs, make_moons, make_swiss_roll
from tolman_quantizers import GNG

SIZES = [(2, 1000), (11, 1000), (72, 100), (72, 1000), (784, 100), (784, 1000)]


def inputs(features, count):
    """A surface of three dimensions that is bent into many, with noise."""
    rng = np.random.default_rng(features)
    if features == 2:
        return rng.random((count, 2))
    bent = np.sin(rng.random((count, 3)) @ rng.uniform(-2, 2, (3, features)) + rng.uniform(-2, 2, features))
    return bent + rng.uniform(-0.05, 0.05, (count, features))


def gng(x, units, **how):
    """Return the learning of a GNG that has all its units."""
    learner = GNG(max_units=units, growth_period=2, compute_labels=False, **how).fit(x).set_params(growth_period=100)
    return learner.partial_fit


def k_means(x, units):
    learner = MiniBatchKMeans(units, n_init=1, random_state=0, batch_size=1024).partial_fit(x[: max(units, 1024)])
    return lambda rows: [learner.partial_fit(rows[at : at + 1024]) for at in range(0, len(rows), 1024)]


def mdp(x, units, period=2):
    from mdp.nodes import GrowingNeuralGasNode

    node = GrowingNeuralGasNode(
        start_poss=list(x[:2]), eps_b=0.2, eps_n=0.006, max_age=50, lambda_=period, alpha=0.5, d=0.995, max_nodes=units
    )
    return node.train, lambda: np.array([unit.data.pos for unit in node.graph.nodes])


def minigng(x, units, period=2):
    from minigng import MiniGNG

    learner = MiniGNG(n_epochs=1, sigma=period, max_units=units, shuffle=False).fit(x[: period * 2])
    return learner.partial_fit, lambda: np.array([unit.prototype for unit in learner.units])


def neupy(x, units, period=2):
    sys.modules.setdefault("tensorflow", MagicMock())
    from neupy.algorithms.competitive.growing_neural_gas import GrowingNeuralGas

    learner = GrowingNeuralGas(
        n_inputs=x.shape[1], step=0.2, neighbour_step=0.006, max_edge_age=50, max_nodes=units, n_iter_before_neuron_added=period
    )
    learner.shuffle_data = False
    learner.initialize_nodes(x)
    return lambda rows: learner.train(rows, epochs=1), lambda: np.array([unit.weight[0] for unit in learner.graph.nodes])


def minisom(x, units, period=2):
    from minisom import MiniSom

    side = max(1, round(units**0.5))
    som = MiniSom(side, -(-units // side), x.shape[1], random_seed=0)
    return lambda rows: som.train(rows, len(rows)), lambda: som.get_weights().reshape(-1, x.shape[1])


def full(make):
    """Return what makes the learning of a rival that has all its units."""

    def learning(x, units):
        train, _ = make(x, units)
        if make is not minisom:
            train(x[: 2 * units + 10])
        return train

    return learning


RIVALS = {"MDP": mdp, "minigng": minigng, "neupy": neupy, "minisom": minisom}

LEARNERS = {
    "GNG": gng,
    "GNG, float32": lambda x, units: gng(x.astype(np.float32), units),
    "GNG, batches of 1024": lambda x, units: gng(x, units, batch_size=1024),
    "MiniBatchKMeans": k_means,
    **{name: full(make) for name, make in RIVALS.items()},
}


# They take thousands of times as long: fewer rows a call keep to the time.
SLOW = tuple(RIVALS)


def rate(learn, rows, seconds):
    """Return the rows learnt per second of processor time."""
    learnt, begun = 0, time.process_time()
    while time.process_time() - begun < seconds:
        learn(rows)
        learnt += len(rows)
    return learnt / (time.process_time() - begun)


def speed(seconds):
    print("| features, units |", " | ".join(LEARNERS), "|")
    print("| --- |" + " ---: |" * len(LEARNERS))
    for features, units in SIZES:
        x = inputs(features, 4096)
        ready = {}
        for name, make in LEARNERS.items():
            try:
                learn = make(x, units)
                rows = x.astype(np.float32) if "float32" in name else x
                ready[name] = (learn, rows[:100] if name in SLOW else rows)
            except Exception:  # It is not installed, or does not work with this numpy.
                continue
        rates = {name: [] for name in ready}
        for _ in range(3):
            for name, (learn, rows) in ready.items():
                rates[name].append(rate(learn, rows, seconds))
        shown = [f"{np.median(rates[name]):,.0f}" if name in rates else "" for name in LEARNERS]
        print(f"| {features}, {units} |", " | ".join(shown), "|", flush=True)


def quality():
    sets = {
        "digits": load_digits().data,
        "blobs": make_blobs(5000, centers=5, random_state=0)[0],
        "moons": make_moons(5000, noise=0.05, random_state=0)[0],
        "swiss roll": make_swiss_roll(5000, noise=0.2, random_state=0)[0],
    }
    ours = {
        "GNG, one call": {},
        "shuffled": {"shuffle": True, "random_state": 0},
        "batches of 256": {"batch_size": 256},
    }
    print("\n| set, 64 units |", " | ".join([*ours, *RIVALS]), "| unlinked pairs |")
    print("| --- |" + " ---: |" * (len(ours) + len(RIVALS) + 1))
    for name, x in sets.items():
        best = MiniBatchKMeans(64, n_init=3, random_state=0).fit(x).inertia_ / len(x)
        fitted = [GNG(64, **how).fit(x) for how in ours.values()]
        shown = [f"{way.quantization_error(x) / best:.2f}" for way in fitted]
        # As many inputs as one call learns from.
        count = -(-2 * 64 * 100 // len(x))
        for make in RIVALS.values():
            try:
                train, prototypes = make(x, 64, 100)
            except Exception:  # It is not installed, or does not work with this numpy.
                shown.append("")
                continue
            for _ in range(count):
                train(x)
            units = prototypes()
            nearest = [((units - row) ** 2).sum(axis=1).min() for row in x]
            shown.append(f"{np.mean(nearest) / best:.2f}")
        print(f"| {name} |", " | ".join(shown), f"| {fitted[0].topographic_error(x):.3f} |", flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=1.0, help="how long each of three measurements takes")
    parser.add_argument("--quality", action="store_true", help="leave speed out")
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    if not options.quality:
        speed(options.seconds)
    quality()
