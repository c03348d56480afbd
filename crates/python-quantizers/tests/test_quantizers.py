"""Quantizers behave as estimators of scikit-learn do, and learn what the project's quantizers learn."""

import pickle
import threading
import time

import numpy as np
import pytest
import tolman
from tolman import GNG, SOINN, EquilibriumGNG

ALL = [GNG(max_units=30, growth_period=20), EquilibriumGNG(0.05, growth_period=20), SOINN()]


def points(count=3000, seed=1, dtype=np.float64):
    return np.random.default_rng(seed).random((count, 2)).astype(dtype)


def copy_of(estimator):
    return type(estimator)(**estimator.get_params())


@pytest.mark.parametrize("estimator", ALL, ids=lambda estimator: type(estimator).__name__)
class TestAll:
    def test_fit_learns_a_graph(self, estimator):
        x = points()
        fitted = copy_of(estimator).fit(x)
        units, edges = fitted.units_, fitted.edges_
        assert len(units) > 5 and units.shape[1] == 2 == fitted.n_features_in_
        assert edges.shape == (len(fitted.edge_ages_), 2)
        assert 0 <= edges.min() and edges.max() < len(units) and (edges[:, 0] != edges[:, 1]).all()
        assert fitted.quantization_error(x) < 0.02
        assert fitted.score(x) == -fitted.quantization_error(x)
        assert (np.diff(fitted.unit_ids_) > 0).all()

    def test_predict_is_the_nearest_unit(self, estimator):
        fitted = copy_of(estimator).fit(points())
        x = points(200, seed=2)
        squared = ((x[:, None] - fitted.units_) ** 2).sum(axis=2)
        assert (fitted.predict(x) == squared.argmin(axis=1)).all()
        assert fitted.quantization_error(x) == pytest.approx(squared.min(axis=1).mean())
        assert (fitted.predict_cluster(x) == fitted.clusters_[fitted.predict(x)]).all()

    def test_partial_fit_goes_on_and_fit_begins_anew(self, estimator):
        x = points()
        whole, parts = copy_of(estimator).fit(x), copy_of(estimator)
        for part in np.array_split(x, 7):
            assert parts.partial_fit(part) is parts
        assert (whole.units_ == parts.units_).all() and (whole.edges_ == parts.edges_).all()
        assert (parts.fit(x).units_ == whole.units_).all()
        assert (copy_of(estimator).fit_predict(x) == whole.predict(x)).all()

    def test_a_saved_one_goes_on_to_the_same_bits(self, estimator):
        x = points()
        for dtype in (np.float64, np.float32):
            typed = x.astype(dtype)
            through = copy_of(estimator).fit(typed)
            resumed = pickle.loads(pickle.dumps(copy_of(estimator).fit(typed[:1000])))
            resumed.partial_fit(typed[1000:])
            assert (through.units_ == resumed.units_).all() and through.units_.dtype == dtype
        assert pickle.loads(pickle.dumps(copy_of(estimator))).get_params() == estimator.get_params()

    def test_strides_and_types_change_nothing(self, estimator):
        x = points()
        expected = copy_of(estimator).fit(x).units_
        spread = np.zeros((len(x) * 2, 4))
        spread[::2, ::2] = x
        for same in (np.asfortranarray(x), spread[::2, ::2], x.tolist(), x.astype(">f8"), x.astype(object)):
            assert (copy_of(estimator).fit(same).units_ == expected).all()
        assert (x == points()).all(), "the input is read, not written"

    def test_parameters_are_those_of_a_clone(self, estimator):
        params = estimator.get_params()
        clone = type(estimator)(**params)
        assert all(clone.get_params()[name] is value for name, value in params.items())
        assert clone.set_params(max_age=7) is clone and clone.get_params()["max_age"] == 7
        with pytest.raises(ValueError, match="widht is no parameter"):
            clone.set_params(widht=1)
        assert repr(clone).startswith(type(clone).__name__) and "max_age=7" in repr(clone)

    def test_nothing_is_known_before(self, estimator):
        for ask in (lambda e: e.units_, lambda e: e.predict([[0, 0]])):
            with pytest.raises(tolman.NotFittedError, match="call fit"):
                ask(copy_of(estimator))

    @pytest.mark.parametrize(
        ("x", "said"),
        [
            ([1.0, 2.0], "X has 1 dimensions"),
            (np.zeros((2, 2, 2)), "X has 3 dimensions"),
            ([["a", "b"]], "X has to be an array of numbers"),
            ([[1j, 0]], "X has to be an array of numbers"),
            ([[1.0], [1.0, 2.0]], "X has to be an array of numbers"),
            (None, "X "),
            (np.zeros((0, 2)), "X has no rows"),
            (np.zeros((3, 0)), "X: the inputs have no features"),
            ([[0.0, 1.0], [0.0, float("nan")]], "X, row 1: feature 1 is NaN"),
            ([[0.0, 1e200]], "X, row 0: feature 1 is 1e200"),
        ],
    )
    def test_wrong_input_is_named(self, estimator, x, said):
        with pytest.raises(ValueError, match=said):
            copy_of(estimator).fit(x)

    def test_of_wrong_input_nothing_is_learnt(self, estimator):
        x = points(500)
        fitted = copy_of(estimator).fit(x)
        units = fitted.units_
        with pytest.raises(ValueError, match="X, row 499"):
            fitted.partial_fit(np.vstack([x[:499], [[np.inf, 0.0]]]))
        with pytest.raises(ValueError, match="X, row 0: the input has 3 features; give 2, as the network has"):
            fitted.predict(np.zeros((1, 3)))
        assert (fitted.units_ == units).all()


@pytest.mark.parametrize(
    ("estimator", "said"),
    [
        (GNG(max_units=1), "max_units is 1 but has to be at least 2"),
        (GNG(max_units="many"), "max_units is 'many' but has to be a number"),
        (GNG(max_units=-3), "max_units is -3 but has to be a whole number"),
        (GNG(max_age=2.5), "max_age is 2.5 but has to be a whole number"),
        (GNG(winner_rate=1.5), "winner_rate is 1.5 but has to be between 0 and 1"),
        (GNG(winner_rate=None), "winner_rate is None but has to be a number"),
        (GNG(error="cubed"), "error is 'cubed' but has to be one of 'squared', 'absolute', 'relative'"),
        (GNG(utility_threshold=-1.0), "utility_threshold is -1 but has to be"),
        (EquilibriumGNG(-1.0), "threshold is -1 but has to be"),
        (EquilibriumGNG(None), "threshold is None but has to be a number"),
        (EquilibriumGNG(1.0, gate="shut"), "gate is 'shut' but has to be one of"),
        (SOINN(noise_factor=2.0), "noise_factor is 2 but has to be between 0 and 1"),
        (SOINN(threshold=-0.5), "threshold is -0.5 but has to be"),
        (SOINN(period=0), "period is 0 but has to be at least 1"),
    ],
    ids=repr,
)
def test_wrong_parameters_are_named(estimator, said):
    with pytest.raises(ValueError, match="^" + said):
        estimator.fit(points(100))


def test_clusters_are_what_hangs_together():
    rng = np.random.default_rng(3)
    angles = rng.random(20_000) * 2 * np.pi
    centres = np.where(rng.random(20_000) < 0.5, -2.0, 2.0)
    rings = np.column_stack([centres + np.cos(angles), np.sin(angles)])
    gng = GNG(max_units=40).fit(rings)
    assert len(set(gng.clusters_)) == 2
    left, right = gng.predict_cluster([[-3.0, 0.0], [3.0, 0.0]])
    assert left != right
    networkx = pytest.importorskip("networkx")
    graph = gng.to_networkx()
    assert networkx.number_connected_components(graph) == 2
    assert graph.number_of_edges() == len(gng.edges_)
    assert graph.nodes[0]["position"] == tuple(gng.units_[0])


def test_utility_moves_units_to_where_the_inputs_are():
    x = points(6000)
    moved = GNG(max_units=20, growth_period=20, utility_threshold=4.0, removal="when_full")
    kept = GNG(max_units=20, growth_period=20)
    away = x + 5.0
    errors = [estimator.fit(x).partial_fit(away).quantization_error(away) for estimator in (moved, kept)]
    assert errors[0] < 0.8 * errors[1], errors


def test_the_input_is_not_copied():
    """8 MB that are fortran-ordered would cost as much again if they were."""
    import tracemalloc

    x = np.asfortranarray(points(500_000))
    gng = GNG(max_units=2)
    tracemalloc.start()
    gng.fit(x)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < x.nbytes / 100, peak


def test_others_go_on_while_one_learns():
    x = points(400_000)
    gng = GNG(max_units=2000, growth_period=20)
    learning = threading.Thread(target=gng.fit, args=(x,))
    longest, ticks, last = 0.0, 0, time.perf_counter()
    learning.start()
    while learning.is_alive():
        time.sleep(0.001)
        now = time.perf_counter()
        longest, ticks, last = max(longest, now - last), ticks + 1, now
    learning.join()
    assert len(gng.units_) == 2000
    # With the lock held, this thread would not have run once amid the learning.
    assert ticks > 10, (ticks, longest)
