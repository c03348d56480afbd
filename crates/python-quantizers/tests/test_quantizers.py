"""Quantizers behave as estimators of scikit-learn do, and learn what the project's quantizers learn."""

import pickle
import threading
import time

import numpy as np
import pytest
from tolman_quantizers import GNG, SOINN, AssociativeMemory, EquilibriumGNG, NotFittedError

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
            resumed = pickle.loads(pickle.dumps(copy_of(estimator).partial_fit(typed[:1000])))
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
        with pytest.raises(ValueError, match="Invalid parameter 'widht'"):
            clone.set_params(widht=1)
        assert repr(clone).startswith(type(clone).__name__) and "max_age=7" in repr(clone)

    def test_nothing_is_known_before(self, estimator):
        for ask in (lambda e: e.units_, lambda e: e.predict([[0, 0]])):
            with pytest.raises(NotFittedError, match="call fit"):
                ask(copy_of(estimator))

    @pytest.mark.parametrize(
        ("x", "said"),
        [
            ([1.0, 2.0], "Expected 2D array, got 1D array"),
            (np.zeros((2, 2, 2)), "dim 3"),
            ([["a", "b"]], "could not convert string to float"),
            ([[1j, 0]], "Complex data not supported"),
            ([[1.0], [1.0, 2.0]], "inhomogeneous|sequence"),
            (None, "."),
            (np.zeros((0, 2)), "0 sample"),
            (np.zeros((3, 0)), "0 feature"),
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
        with pytest.raises(ValueError, match="X has 3 features, but .* is expecting 2 features"):
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
    assert (graph.nodes[0]["x0"], graph.nodes[0]["x1"]) == tuple(gng.units_[0])


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
    gng = GNG(max_units=2, compute_labels=False)
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


class TestNeverSilentlyWrong:
    @pytest.mark.parametrize("dtype", [np.float64, np.float32])
    def test_tiny_scales_are_refused(self, dtype):
        x = points(300)
        for estimator in ALL:
            tiny = (x * (1e-200 if dtype == np.float64 else 1e-25)).astype(dtype)
            for learn in (copy_of(estimator).fit, copy_of(estimator).partial_fit):
                with pytest.raises(ValueError, match="squares of distances vanish: scale X"):
                    learn(tiny)
        small = (x * (1e-120 if dtype == np.float64 else 1e-12)).astype(dtype)
        assert len(GNG(max_units=10, growth_period=10).fit(small).units_) == 10

    def test_masked_values_are_refused(self):
        x = np.ma.masked_greater(points(300), 0.9)
        fitted = GNG(max_units=10, growth_period=10).fit(points(300))
        for ask in (GNG().fit, fitted.partial_fit, fitted.predict):
            with pytest.raises(ValueError, match="masked values"):
                ask(x)
        assert len(GNG(max_units=5, growth_period=9).fit(np.ma.masked_array(points(300))).units_) == 5

    def test_sample_weight_is_refused(self):
        x = points(30)
        for learn in (GNG().fit, GNG().partial_fit, GNG().fit_predict):
            with pytest.raises(TypeError, match="takes no sample_weight"):
                learn(x, sample_weight=np.ones(30))
        with pytest.raises(TypeError, match="unexpected keyword argument 'wieght'"):
            GNG().fit(x, wieght=1)


class TestFit:
    def test_one_call_gives_the_units_asked_for(self):
        from sklearn.cluster import MiniBatchKMeans
        from sklearn.datasets import load_digits

        x = load_digits().data
        gng = GNG(max_units=100).fit(x)
        k_means = MiniBatchKMeans(100, n_init=1, random_state=0).fit(x)
        assert len(gng.units_) == 100
        assert gng.quantization_error(x) < 1.15 * k_means.inertia_ / len(x)

    def test_it_warns_of_fewer_units(self):
        from sklearn.exceptions import ConvergenceWarning

        with pytest.warns(ConvergenceWarning, match="GNG has .* of the 100 units of max_units: 300 inputs are too few"):
            GNG(max_units=100, n_epochs=1).fit(points(300))
        with pytest.warns(ConvergenceWarning, match="too few different rows"):
            GNG(max_units=5).fit(np.ones((300, 2)))

    def test_epochs_go_on_with_the_same_rows(self):
        x = points(500)
        by_hand = GNG(max_units=40, growth_period=20)
        for _ in range(3):
            by_hand.partial_fit(x)
        assert (GNG(max_units=40, growth_period=20, n_epochs=3).fit(x).units_ == by_hand.units_).all()
        for wrong in (0, 1.5, "many"):
            with pytest.raises(ValueError, match="n_epochs is"):
                GNG(n_epochs=wrong).fit(x)

    def test_shuffling_repeats_by_its_seed_and_serves_sorted_rows(self):
        x = np.sort(points(4000), axis=0)

        def fitted(**how):
            return GNG(max_units=50, growth_period=20, n_epochs=2, **how).fit(x)

        once, again, other = (fitted(shuffle=True, random_state=seed) for seed in (1, 1, 2))
        assert (once.units_ == again.units_).all() and not np.array_equal(once.units_, other.units_)
        assert once.quantization_error(x) < fitted().quantization_error(x)

    def test_labels_are_what_predict_says(self):
        x = points()
        for estimator in ALL:
            fitted = copy_of(estimator).fit(x)
            assert (fitted.labels_ == fitted.predict(x)).all()
            assert not hasattr(fitted.partial_fit(x[:9]), "labels_")
        gng = GNG(compute_labels=False)
        assert (gng.fit_predict(x) == gng.predict(x)).all() and not hasattr(gng, "labels_")

    def test_progress_is_told(self, capsys):
        told = []
        GNG(max_units=50, n_epochs=2, growth_period=50, progress=lambda done, total: told.append((done, total))).fit(points(2000))
        assert told[-1] == (4000, 4000) and sorted(told) == told
        GNG(max_units=20, progress=True).fit(points(2000))
        assert "GNG: 4000 of 4000 rows\n" in capsys.readouterr().err

    def test_a_pickle_is_hardly_larger_than_the_units(self):
        x = np.random.default_rng(0).random((2000, 100))
        gng = GNG(max_units=200, growth_period=10, compute_labels=False).fit(x)
        assert len(pickle.dumps(gng)) < 1.2 * gng.units_.nbytes


class TestThreadsAndSignals:
    def test_others_read_while_one_learns(self):
        x = points(600_000)
        gng = GNG(max_units=2000, growth_period=20, compute_labels=False).partial_fit(x[:100])
        learning = threading.Thread(target=gng.partial_fit, args=(x,))
        learning.start()
        sizes, reads = [], 0
        while learning.is_alive():
            assert len(gng.predict_cluster(x[:10])) == 10
            sizes.append(len(gng.units_))
            gng.edges_, gng.clusters_, pickle.dumps(gng)
            reads += 1
        learning.join()
        assert reads > 3 and len(set(sizes)) > 2, (reads, sizes)

    def test_control_c_ends_learning_and_keeps_it(self):
        import os
        import signal

        x = np.random.default_rng(0).random((400_000, 32))
        sent = []

        def send(done, total):
            if not sent:
                sent.append(time.perf_counter())
                os.kill(os.getpid(), signal.SIGINT)

        gng = GNG(max_units=2000, growth_period=20, progress=send)
        with pytest.raises(KeyboardInterrupt):
            gng.fit(x)
        # A tenth of a second on a free processor.
        assert time.perf_counter() - sent[0] < 1.0
        assert len(gng.units_) > 10 and not hasattr(gng, "labels_")


class TestMiniBatches:
    @pytest.mark.parametrize(("features", "units"), [(8, 100), (64, 100), (200, 50)])
    @pytest.mark.parametrize("dtype", [np.float64, np.float32])
    def test_the_error_is_that_of_row_by_row(self, features, units, dtype):
        rng = np.random.default_rng(features)
        x = (rng.random((8000, 3)) @ rng.normal(size=(3, features)) + 0.05 * rng.normal(size=(8000, features))).astype(dtype)
        exact, batched = (GNG(max_units=units, growth_period=20, batch_size=size).fit(x) for size in (None, 256))
        assert len(batched.units_) == units
        assert batched.quantization_error(x) < 1.02 * exact.quantization_error(x)
        again = GNG(max_units=units, growth_period=20, batch_size=256).fit(x)
        assert (again.units_ == batched.units_).all()

    def test_far_from_the_origin_it_finds_the_same(self):
        x = points(4000) @ np.random.default_rng(1).random((2, 20))
        near, far = (GNG(max_units=40, growth_period=20, batch_size=64).fit(y) for y in (x, x + 1e7))
        assert far.quantization_error(x + 1e7) < 1.1 * near.quantization_error(x)

    def test_a_wrong_size_is_named(self):
        for wrong in (0, 2.5, 10**6):
            with pytest.raises(ValueError, match="batch_size is"):
                GNG(batch_size=wrong).fit(points(100))


class TestMemories:
    def test_pairs_are_recalled_from_either_part(self):
        patterns = np.array([[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]])
        memory = AssociativeMemory().associate(patterns[:-1], patterns[1:])
        assert (memory.response(patterns[:-1] + 0.1) == patterns[1:]).all()
        assert (memory.key(patterns[1:] - 0.1) == patterns[:-1]).all()
        assert (memory.chain(patterns[0], reach=0.2) == patterns[1:]).all() and len(memory) == 3
        memory.associate(patterns[:1], [[5.0, 5.0]])
        assert memory.responses(patterns[0], 0.1).tolist() == [[0.0, 1.0], [5.0, 5.0]]
        assert memory.keys([5.0, 5.0], 0.1).tolist() == [[0.0, 0.0]] and memory.keys([9.0, 9.0], 0.1).shape == (0, 2)
        cycle = AssociativeMemory().associate(patterns, np.roll(patterns, -1, axis=0))
        assert len(cycle.chain(patterns[0], reach=0.1, most=9)) == 9

    @pytest.mark.parametrize(
        ("ask", "said"),
        [
            (lambda m: AssociativeMemory().response([[0.0]]), "call associate first"),
            (lambda m: AssociativeMemory(max_age=0).associate([[0.0]], [[1.0]]), "max_age is 0"),
            (lambda m: m.associate([[0.0, 1.0]], [[1.0], [2.0]]), "keys has 1 rows and responses has 2"),
            (lambda m: m.associate([[0.0, 1.0]], [[np.nan]]), "row 0: feature 2 is NaN"),
            (lambda m: m.response([[0.0]]), "row 0: .*2"),
            (lambda m: m.response([0.0]), "keys has 1 dimensions"),
            (lambda m: m.responses([[0.0, 0.0]], 1.0), "key has 2 dimensions"),
            (lambda m: m.chain([0.0, 1.0], reach=1.0), "the memory cannot answer"),
        ],
    )
    def test_wrong_input_is_named(self, ask, said):
        with pytest.raises(ValueError, match=said):
            ask(AssociativeMemory().associate([[0.0, 1.0]], [[2.0]]))

    def test_a_stream_that_goes_round_slowly_is_remembered(self):
        angles = np.arange(5000) * 0.00125
        ring = np.column_stack([np.cos(angles), np.sin(angles)])
        plain, remembering = (GNG(max_units=30, replay=replay).partial_fit(ring) for replay in (None, 8))
        assert remembering.quantization_error(ring) < 0.1 * plain.quantization_error(ring)
        resumed = pickle.loads(pickle.dumps(GNG(max_units=30, replay=8).partial_fit(ring[:3000]))).partial_fit(ring[3000:])
        assert (resumed.units_ == remembering.units_).all()
        for wrong, said in (({"replay": 0}, "replay is 0"), ({"replay": 8, "replay_memory": "all"}, "replay_memory is 'all'")):
            with pytest.raises(ValueError, match=said):
                GNG(**wrong).fit(ring)


class TestWhatANotebookShows:
    def test_files_take_the_graph(self):
        import io

        networkx = pytest.importorskip("networkx")
        graph = GNG(max_units=10, growth_period=10).fit(points()).to_networkx()
        for write in (networkx.write_graphml, networkx.write_gexf, networkx.write_gml):
            write(graph, io.BytesIO())

    def test_pictures_have_a_dot_a_unit(self):
        gng = GNG(max_units=10, growth_period=10)
        assert "<svg" not in gng._repr_mimebundle_()["text/html"]
        gng.fit(points())
        assert gng.svg().count("<circle") == 10 and "<svg" in gng._repr_mimebundle_()["text/html"]
        assert GNG(max_units=4, growth_period=9).fit(points()[:, :1]).svg().count("<circle") == 4
        with pytest.raises(ValueError, match="features has 2, but the features are 0 to 1"):
            gng.svg(features=(0, 2))
        matplotlib = pytest.importorskip("matplotlib")
        matplotlib.use("Agg")
        assert len(gng.plot().collections) == 2
