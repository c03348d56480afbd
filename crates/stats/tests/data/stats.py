"""Writes stats.json, the values that tolman::stats is held to.

Run it in its own folder after `pip install scipy`; the samples are seeded, so the same versions of
NumPy and SciPy write the same file.
"""

import json

import numpy as np
import scipy
from scipy import special, stats

rng = np.random.default_rng(1948)
# A stream of its own, so that the values above and below stay what they were.
median_rng = np.random.default_rng(1999)


def samples():
    """Pairs of samples, small and large, with and without ties, near and far apart."""
    yield [1.0, 2.0, 3.0], [4.0, 5.0, 6.0]
    yield [5.0], [1.0, 2.0, 3.0]
    yield [1.5, 2.5, 2.5, 9.0], [2.5, 3.0, 9.0, 9.0, 11.0]
    yield rng.normal(0, 1, 7).tolist(), rng.normal(3, 1, 50).tolist()
    yield rng.normal(0, 1, 8).tolist(), rng.normal(0.5, 1, 8).tolist()
    yield rng.normal(0, 1, 25).tolist(), rng.normal(1, 2, 25).tolist()
    yield rng.integers(0, 30, 25).tolist(), rng.integers(10, 40, 25).tolist()
    yield rng.integers(0, 5, 40).tolist(), rng.integers(1, 6, 60).tolist()
    yield np.round(rng.exponential(70, 300), 1).tolist(), np.round(rng.exponential(40, 300), 1).tolist()
    yield rng.normal(0, 1, 400).tolist(), rng.normal(5, 1, 400).tolist()
    yield [0.0] * 5 + [1.0] * 20, [0.0] * 15 + [1.0] * 10


def mann_whitney(a, b, method):
    result = stats.mannwhitneyu(a, b, alternative="two-sided", method=method)
    return {"u": result.statistic, "p": result.pvalue}


def pair(a, b):
    ties = len(set(a) | set(b)) < len(a) + len(b)
    n = min(len(a), len(b))
    x, y = a[:n], b[:n]
    d = np.array(x) - np.array(y)
    uneven = (d == 0).any() or len(set(abs(d))) < n
    signed = stats.wilcoxon(x, y, method="asymptotic", correction=True)
    # wilcoxon's statistic is the lesser sum; ours is the sum of the positive ranks.
    ranks = stats.rankdata(abs(d[d != 0]))
    case = {
        "a": a,
        "b": b,
        "mann_whitney_asymptotic": mann_whitney(a, b, "asymptotic"),
        "mann_whitney_exact": None if ties or n > 60 else mann_whitney(a, b, "exact"),
        "wilcoxon_rank_sum": float(ranks[d[d != 0] > 0].sum()),
        "wilcoxon_asymptotic": signed.pvalue,
        "wilcoxon_exact": None if uneven or n > 60 else stats.wilcoxon(x, y, method="exact").pvalue,
        "a12": stats.mannwhitneyu(a, b).statistic / (len(a) * len(b)),
        "mean": float(np.mean(a)),
        "sd": float(np.std(a, ddof=1)) if len(a) > 1 else None,
        "quantiles": [[q, float(np.quantile(a, q))] for q in (0, 0.025, 0.25, 0.5, 0.75, 0.9, 1)],
    }
    return case


def bca(data, statistic):
    result = stats.bootstrap(
        (np.array(data),), statistic, method="BCa", n_resamples=999, rng=rng, vectorized=True
    )
    jackknife = [float(statistic(np.delete(data, i), axis=-1)) for i in range(len(data))]
    return {
        "data": list(data),
        "estimate": float(statistic(np.array(data), axis=-1)),
        "replicates": result.bootstrap_distribution.tolist(),
        "jackknife": jackknife,
        "low": float(result.confidence_interval.low),
        "high": float(result.confidence_interval.high),
    }


def median(data, level):
    """None where even the extremes do not reach the level, as SciPy's NaN says."""
    interval = stats.quantile_test(data, q=0, p=0.5).confidence_interval(level)
    ends = [float(interval.low), float(interval.high)]
    return {"data": data, "level": level, "interval": None if np.isnan(ends).any() else ends}


def proportion(k, n, level):
    test = stats.binomtest(k, n)
    exact = test.proportion_ci(level, "exact")
    wilson = test.proportion_ci(level, "wilson")
    return {
        "successes": k,
        "trials": n,
        "level": level,
        "exact": [float(exact.low), float(exact.high)],
        "wilson": [float(wilson.low), float(wilson.high)],
    }


def corrections(p):
    """Holm by hand from its definition: SciPy has no function for it."""
    order = sorted(range(len(p)), key=lambda i: p[i])
    holm, least = [0.0] * len(p), 0.0
    for passed, i in enumerate(order):
        least = max(least, min(1.0, p[i] * (len(p) - passed)))
        holm[i] = least
    return {"p": p, "holm": holm, "bonferroni": [min(1.0, x * len(p)) for x in p]}


zs = [-8.0, -1.0, 0.0, 0.3, 1.0, 1.96, 5.0, 12.0, 29.9, 30.0, 30.1, 37.0, 40.0, 120.0]
golden = {
    "made_with": f"scipy {scipy.__version__}, numpy {np.__version__}",
    "pairs": [pair(list(map(float, a)), list(map(float, b))) for a, b in samples()],
    "ln_upper_tail": [[z, float(stats.norm.logsf(z))] for z in zs],
    "normal_quantile": [[p, float(special.ndtri(p))] for p in (1e-300, 1e-12, 0.01, 0.025, 0.4999, 0.5, 0.7, 0.975, 0.999999)],
    "beta": [
        [a, b, x, float(special.betainc(a, b, x))]
        for a, b, x in [(1, 1, 0.3), (17, 9, 0.6), (0.5, 0.5, 0.1), (900, 101, 0.9), (3, 400, 0.01), (30, 2, 0.2)]
    ],
    "bca": [
        bca(np.round(rng.exponential(70, 40), 2), np.mean),
        bca(np.round(rng.normal(100, 20, 25), 2), np.mean),
        bca(np.round(rng.exponential(10, 31), 2), np.median),
    ],
    "medians": [
        median(data, level)
        for level in (0.5, 0.95, 0.99)
        for data in (
            [1.0],
            [3.0, 1.0, 2.0, 5.0, 4.0],
            [3.0, 1.0, 2.0, 5.0, 4.0, 6.0],
            np.round(median_rng.normal(0, 1, 25), 3).tolist(),
            median_rng.integers(0, 5, 60).astype(float).tolist(),
            np.round(median_rng.exponential(70, 201), 2).tolist(),
        )
    ],
    "proportions": [
        proportion(k, n, level)
        for k, n, level in [(0, 25, 0.95), (25, 25, 0.95), (17, 25, 0.95), (1, 3, 0.9), (680, 1000, 0.95), (1, 1000, 0.99)]
    ],
    "corrections": [
        corrections([0.01, 0.04, 0.03, 0.005]),
        corrections([0.9, 0.5]),
        corrections([1e-200, 1e-100, 0.2, 0.2, 1.0]),
        corrections([0.03]),
    ],
}

with open("stats.json", "w") as file:
    json.dump(golden, file, indent=None, separators=(",", ":"))
    file.write("\n")
