"""The quantizers beside what a Python user would choose otherwise: speed, and quality on scikit-learn's own sets.

    OMP_NUM_THREADS=1 python crates/python-quantizers/benches/against_rivals.py [--seconds 1.0]

compares with whichever of MiniBatchKMeans, MDP 3.6 (needs numpy 1.23) and minisom is installed. Rates are rows
a second of processor time with all units there, medians of three, learners in turn. All rows are printed, not the best.
"""

import argparse
import time
import warnings

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


def mdp(x, units):
    from mdp.nodes import GrowingNeuralGasNode

    node = GrowingNeuralGasNode(start_poss=list(x[:2]), eps_b=0.2, eps_n=0.006, max_age=50, lambda_=2, alpha=0.5, d=0.995, max_nodes=units)
    node.train(x[: 2 * units + 10])
    return lambda rows: node.train(rows)


def minisom(x, units):
    from minisom import MiniSom

    side = max(1, round(units**0.5))
    som = MiniSom(side, -(-units // side), x.shape[1], random_seed=0)
    return lambda rows: som.train(rows, len(rows))


LEARNERS = {
    "GNG": gng,
    "GNG, float32": lambda x, units: gng(x.astype(np.float32), units),
    "GNG, batches of 256": lambda x, units: gng(x, units, batch_size=256),
    "MiniBatchKMeans": k_means,
    "MDP": mdp,
    "minisom": minisom,
}


# They take thousands of times as long: fewer rows a call keep to the time.
SLOW = ("MDP", "minisom")


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
                ready[name] = (learn, rows[:300] if name in SLOW else rows)
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
    print("\n| set | units | MSE / k-means, one call | shuffled | batches of 256 | unlinked pairs |\n| --- | ---: | ---: | ---: | ---: | ---: |")
    for name, x in sets.items():
        best = MiniBatchKMeans(64, n_init=3, random_state=0).fit(x).inertia_ / len(x)
        ways = [GNG(64, **how).fit(x) for how in ({}, {"shuffle": True, "random_state": 0}, {"batch_size": 256})]
        errors = " | ".join(f"{way.quantization_error(x) / best:.2f}" for way in ways)
        print(f"| {name} | {len(ways[0].units_)} | {errors} | {ways[0].topographic_error(x):.3f} |", flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=1.0, help="how long each of three measurements takes")
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    speed(options.seconds)
    quality()
