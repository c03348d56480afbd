"""`predict` with one thread and with two, beside another version of itself and MiniBatchKMeans.

    python crates/python-quantizers/benches/predict.py [--beside MODULE] [--seconds 1.0]

prints rows a second on the clock, medians of five, learners in turn, float64. MODULE has the class GNG of another version.
It also checks that one thread and two give the same bits, and the other version, too.
"""

import argparse
import importlib
import os
import time
import warnings

import numpy as np
from against_rivals import SIZES, inputs
from sklearn.cluster import MiniBatchKMeans
from threadpoolctl import ThreadpoolController
from tolman_quantizers import GNG


def fitted(kind, x, units):
    """Return a GNG with all its units, which the same inputs make the same in every version."""
    gng = kind(max_units=units, growth_period=2).partial_fit(x)
    assert len(gng.units_) == units
    return gng


def ours(gng, threads):
    def predict(x):
        os.environ["OMP_NUM_THREADS"] = str(threads)
        return gng.predict(x)

    return predict


def theirs(k_means, threads):
    pools = ThreadpoolController()

    def predict(x):
        with pools.limit(limits=threads):
            return k_means.predict(x)

    return predict


def rate(predict, x, seconds):
    """Return the rows per second on the clock."""
    done, begun = 0, time.perf_counter()
    while time.perf_counter() - begun < seconds:
        predict(x)
        done += len(x)
    return done / (time.perf_counter() - begun)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--beside", help="a module with the class GNG of another version")
    parser.add_argument("--seconds", type=float, default=1.0, help="how long each of five measurements takes")
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    other = importlib.import_module(options.beside) if options.beside else None
    names = ["one thread", "two threads", "k-means, one", "k-means, two", *([options.beside] if other else [])]
    print("| features, units |", " | ".join(names), "|" + " two to it |" * bool(other))
    print("| --- |" + " ---: |" * (len(names) + bool(other)))
    for features, units in SIZES:
        x = inputs(features, 20_000)
        gng = fitted(GNG, x[:4096], units)
        k_means = MiniBatchKMeans(units, n_init=1, random_state=0, batch_size=1024).partial_fit(x[:4096])
        ways = {"one thread": ours(gng, 1), "two threads": ours(gng, 2)}
        ways |= {"k-means, one": theirs(k_means, 1), "k-means, two": theirs(k_means, 2)}
        if other:
            before = fitted(other.GNG, x[:4096], units)
            assert (before.units_ == gng.units_).all(), "the versions learn other units"
            ways[options.beside] = before.predict
        answers = [ways[name](x) for name in names if not name.startswith("k-means")]
        assert all((answer == answers[0]).all() for answer in answers), "threads or versions differ"
        rates = {name: [] for name in names}
        for _ in range(5):
            for name in names:
                rates[name].append(rate(ways[name], x, options.seconds))
        medians = [float(np.median(rates[name])) for name in names]
        spread = max((max(found) - min(found)) / np.median(found) for found in rates.values())
        faster = f" {medians[1] / medians[-1]:.1f} |" if other else ""
        print(f"| {features}, {units} |", " | ".join(f"{median:,.0f}" for median in medians), f"|{faster}", f"<!-- spread {spread:.0%} -->", flush=True)


if __name__ == "__main__":
    main()
