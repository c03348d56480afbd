"""The quantizers: one class an algorithm."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, NoReturn, Union

import numpy as np
import numpy.typing as npt

from . import _pictures
from ._protocol import ConvergenceWarning, Estimator, NotFittedError, check_random_state, numbers, optional
from ._quantizers import Learner

if TYPE_CHECKING:
    from typing_extensions import Self

Progress = Union[bool, Callable[[int, int], object]]
"""Whether to show progress on standard error, or what to call with the rows learnt so far and the rows in all."""


def _distances(rows: npt.NDArray[Any], units: npt.NDArray[Any]) -> Iterator[tuple[slice, npt.NDArray[np.float64]]]:
    """Yield the distances of some rows at a time to all units: they are computed in float64, whatever the rows are."""
    few = max(1, 1_000_000 // max(1, len(units)))
    for begin in range(0, len(rows), few):
        piece = slice(begin, begin + few)
        yield piece, optional("scipy.spatial.distance").cdist(rows[piece], units)


class _Quantizer(Estimator):
    """What all quantizers have in common.

    X is an array of shape (rows, features), or a frame. float32 and float64 are read where they
    lie, and the first X decides which of the two the units have; all else becomes float64. NaN,
    infinities, masked values, sparse matrices and columns in another order raise, and nothing is
    learnt from them. While one thread learns, others may read.
    """

    _kind: str
    _learner: Learner | None = None
    max_age: int
    n_epochs: int | str
    shuffle: bool
    random_state: Any
    compute_labels: bool
    progress: Progress

    labels_: npt.NDArray[np.int64]
    """The number of the nearest unit of each row that `fit` was given, as `predict` says."""

    def _keep(self, given: dict[str, Any]) -> None:
        """Set the parameters of `__init__` as they are, by their names: scikit-learn asks for that."""
        vars(self).update((name, given[name]) for name in self._get_param_names())

    def fit(self, X: npt.ArrayLike, y: Any = None, **refused: NoReturn) -> Self:
        """Forget what was learnt, and learn from X.

        Parameters
        ----------
        X : array of shape (rows, features)
            The inputs, learnt in their order unless `shuffle` is set.
        y : ignored
        **refused
            Nothing else is taken: `sample_weight` raises with what to do instead.

        Returns
        -------
        self

        Raises
        ------
        ValueError
            If X or a parameter is wrong: nothing is learnt. The message names the row.
        TypeError
            If X is sparse, or an argument is not known.
        KeyboardInterrupt
            On Ctrl-C, within a tenth of a second. What was learnt by then is kept.
        """
        self._refuse("fit", refused)
        rows = numbers(self, X, reset=True, dtype=[np.float64, np.float32])
        learner = self._begun(rows)
        learner.check(rows)
        epochs = self._epochs(len(rows))
        self.__dict__.pop("labels_", None)
        self._learner = learner
        self._learn(learner, rows, epochs)
        self._warn(learner, len(rows) * epochs)
        if self.compute_labels:
            self.labels_ = learner.nearest(rows)[0]
        return self

    def partial_fit(self, X: npt.ArrayLike, y: Any = None, **refused: NoReturn) -> Self:
        """Learn once from the rows of X in their order, after all that was learnt before.

        `labels_` is forgotten, as it told of other units.

        Parameters
        ----------
        X : array of shape (rows, features)
            The inputs, with the columns of those before.
        y : ignored
        **refused
            Nothing else is taken.

        Returns
        -------
        self

        Raises
        ------
        ValueError, TypeError, KeyboardInterrupt
            As `fit` does, or if X has other columns than were learnt.
        """
        self._refuse("partial_fit", refused)
        learner = self._learner
        if learner is None:
            rows = numbers(self, X, reset=True, dtype=[np.float64, np.float32])
            learner = self._begun(rows)
        else:
            rows = self._like(learner, X)
        learner.check(rows)
        self.__dict__.pop("labels_", None)
        self._learner = learner
        learner.observe(rows, None, self._batch(), None)
        return self

    def predict(self, X: npt.ArrayLike) -> npt.NDArray[np.int64]:
        """Return for each row of X the number of the nearest unit: its row in `units_`.

        Many rows are compared at once, in all threads (`OMP_NUM_THREADS` sets their number). The answer is the same
        to the bit for any number of rows and threads. Ties go to the older unit.

        Parameters
        ----------
        X : array of shape (rows, features)

        Returns
        -------
        array of shape (rows,), int64

        Raises
        ------
        NotFittedError
            If nothing was learnt yet.
        ValueError
            If X has other columns than were learnt, or a number that cannot be compared. The message names the row.
        """
        learner = self._fitted()
        return learner.nearest(self._like(learner, X))[0]

    def fit_predict(self, X: npt.ArrayLike, y: Any = None, **refused: NoReturn) -> npt.NDArray[np.int64]:
        """Learn from X, and return for each row the number of the nearest unit.

        Parameters
        ----------
        X : array of shape (rows, features)
        y : ignored
        **refused
            Nothing else is taken.

        Returns
        -------
        array of shape (rows,), int64

        Raises
        ------
        ValueError, TypeError, KeyboardInterrupt
            As `fit` does.
        """
        self.fit(X, y, **refused)
        return self.labels_ if self.compute_labels else self.predict(X)

    def transform(self, X: npt.ArrayLike) -> npt.NDArray[Any]:
        """Return the distance of each row of X to each unit.

        Parameters
        ----------
        X : array of shape (rows, features)

        Returns
        -------
        array of shape (rows, units)
            Euclidean distances in the unit of the features, float32 for a float32 learner and else float64. A frame
            after `set_output`.

        Raises
        ------
        NotFittedError
            If nothing was learnt yet.
        ValueError
            If X has other columns than were learnt, or a number that cannot be compared. The message names the row.
        """
        learner = self._fitted()
        rows = self._like(learner, X)
        learner.check(rows)
        units = self.units_
        distances = np.empty((len(rows), len(units)), rows.dtype)
        for piece, found in _distances(rows, units):
            distances[piece] = found
        return distances

    def predict_cluster(self, X: npt.ArrayLike) -> npt.NDArray[np.int64]:
        """Return for each row of X the cluster of the nearest unit, as `clusters_` numbers them.

        Parameters
        ----------
        X : array of shape (rows, features)

        Returns
        -------
        array of shape (rows,), int64

        Raises
        ------
        NotFittedError
            If nothing was learnt yet.
        ValueError
            If X has other columns than were learnt, or a number that cannot be compared. The message names the row.
        """
        learner = self._fitted()
        return learner.nearest(self._like(learner, X))[2]

    def quantization_error(self, X: npt.ArrayLike) -> float:
        """Return the mean of the **squared** distances of the rows of X to their nearest units (MSE).

        Parameters
        ----------
        X : array of shape (rows, features)

        Returns
        -------
        float
            In squared units of the features.

        Raises
        ------
        NotFittedError
            If nothing was learnt yet.
        ValueError
            If X has other columns than were learnt, or a number that cannot be compared. The message names the row.
        """
        learner = self._fitted()
        return float(learner.nearest(self._like(learner, X))[1].mean())

    def topographic_error(self, X: npt.ArrayLike) -> float:
        """Return the share of the rows of X whose two nearest units share no edge (Martinetz, Schulten 1994).

        Parameters
        ----------
        X : array of shape (rows, features)

        Returns
        -------
        float
            From 0, where edges join all neighbours, to 1.

        Raises
        ------
        NotFittedError
            If nothing was learnt yet.
        ValueError
            If X has other columns than were learnt, or a number that cannot be compared. The message names the row.
        """
        learner = self._fitted()
        rows = self._like(learner, X)
        learner.check(rows)
        units, _, edges, _ = learner.graph()
        if len(units) < 2:
            return 0.0
        linked = np.sort(edges[:, 0] * len(units) + edges[:, 1])
        apart = 0
        for _, found in _distances(rows, units):
            two = np.sort(np.argpartition(found, 1, axis=1)[:, :2], axis=1)
            are_linked = np.isin(two[:, 0] * len(units) + two[:, 1], linked)
            apart += int(np.count_nonzero(~are_linked))
        return apart / len(rows)

    def score(self, X: npt.ArrayLike, y: Any = None) -> float:
        """Return the mean squared distance with a minus, so that more is better.

        Parameters
        ----------
        X : array of shape (rows, features)
        y : ignored

        Returns
        -------
        float
            In squared units of the features, at most 0.

        Raises
        ------
        NotFittedError
            If nothing was learnt yet.
        ValueError
            If X has other columns than were learnt, or a number that cannot be compared. The message names the row.
        """
        return -self.quantization_error(X)

    @property
    def units_(self) -> npt.NDArray[Any]:
        """The prototypes: an array of shape (units, features), the oldest first. A copy."""
        return self._fitted().graph()[0]

    @property
    def unit_ids_(self) -> npt.NDArray[np.int64]:
        """The name of each unit, which it keeps when others go: an array of shape (units,), int64."""
        return self._fitted().graph()[1]

    @property
    def edges_(self) -> npt.NDArray[np.int64]:
        """The ends of each edge as rows in `units_`: an array of shape (edges, 2), int64, the lower first."""
        return self._fitted().graph()[2][:, :2]

    @property
    def edge_ages_(self) -> npt.NDArray[np.int64]:
        """The age of each edge, in inputs that its ends have won: an array of shape (edges,), int64."""
        return self._fitted().graph()[2][:, 2]

    @property
    def clusters_(self) -> npt.NDArray[np.int64]:
        """The cluster of each unit, from 0: an array of shape (units,), int64. What edges join is one cluster."""
        return self._fitted().graph()[3]

    @property
    def _n_features_out(self) -> int:
        return len(self._fitted())

    def to_networkx(self) -> Any:
        """Return units and edges as a graph of networkx, which its writers of files take.

        A unit has the attributes id, cluster, and its features: by their names, or as x0, x1, …
        An edge has the attribute age.

        Raises
        ------
        NotFittedError
            If nothing was learnt yet.
        ImportError
            If networkx is not installed.
        """
        units, ids, edges, clusters = self._fitted().graph()
        names = self._names()
        graph = optional("networkx").Graph()
        for number, position in enumerate(units.tolist()):
            known = {"id": int(ids[number]), "cluster": int(clusters[number])}
            graph.add_node(number, **known, **dict(zip(names, position)))
        graph.add_edges_from((low, high, {"age": age}) for low, high, age in edges.tolist())
        return graph

    def to_frame(self) -> Any:
        """Return the units as a frame of pandas: a row a unit, its id as the index, its cluster in the last column.

        Raises
        ------
        NotFittedError
            If nothing was learnt yet.
        ImportError
            If pandas is not installed.
        """
        pandas = optional("pandas")
        units, ids, _, clusters = self._fitted().graph()
        index = pandas.Index(ids, name="id")
        frame = pandas.DataFrame(units, index=index, columns=self._names())
        frame["cluster"] = clusters
        return frame

    def plot(self, ax: Any = None, *, features: tuple[int, int] = (0, 1)) -> Any:
        """Draw units and edges with matplotlib, by two of the features, and return the axes.

        Parameters
        ----------
        ax : matplotlib.axes.Axes or None
            Where to draw; None makes new axes.
        features : (int, int)
            The columns of X that are drawn, from 0: to the right, and up.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        NotFittedError
            If nothing was learnt yet.
        ValueError
            If there is no such feature.
        ImportError
            If matplotlib is not installed.
        """
        units, _, edges, clusters = self._fitted().graph()
        return _pictures.plot(ax, units, edges[:, :2], clusters, features)

    def svg(self, *, features: tuple[int, int] = (0, 1)) -> str:
        """Return a picture of units and edges as SVG, by two of the features.

        Parameters
        ----------
        features : (int, int)
            The columns of X that are drawn, from 0: to the right, and up.

        Returns
        -------
        str

        Raises
        ------
        NotFittedError
            If nothing was learnt yet.
        ValueError
            If there is no such feature.
        """
        units, _, edges, clusters = self._fitted().graph()
        return _pictures.svg(units, edges[:, :2], clusters, features)

    def _repr_mimebundle_(self, **wanted: Any) -> dict[str, str]:
        """Return what a notebook shows: parameters, and a picture once there are units."""
        page = self._repr_html_()
        if self._learner is not None and len(self._learner):
            page += self.svg()
        return {"text/plain": repr(self), "text/html": page}

    def _names(self) -> list[str]:
        named = getattr(self, "feature_names_in_", None)
        return [f"x{number}" for number in range(self.n_features_in_)] if named is None else list(map(str, named))

    def _begun(self, rows: npt.NDArray[Any]) -> Learner:
        return Learner(self._kind, rows.shape[1], rows.dtype == np.float32, self.get_params())

    def _like(self, learner: Learner, X: npt.ArrayLike) -> npt.NDArray[Any]:
        """Return X itself if it has the numbers of the learner, and else a copy that has."""
        return numbers(self, X, reset=False, dtype=np.float32 if learner.single else np.float64)

    def _learn(self, learner: Learner, rows: npt.NDArray[Any], epochs: int) -> None:
        chance = check_random_state(self.random_state) if self.shuffle else None
        total = len(rows) * epochs
        for epoch in range(epochs):
            order = None if chance is None else chance.permutation(len(rows)).astype(np.int64)
            learner.observe(rows, order, self._batch(), self._teller(epoch * len(rows), total))

    def _teller(self, before: int, total: int) -> Callable[[int], object] | None:
        tell = self.progress
        if not tell:
            return None
        if callable(tell):
            return lambda done: tell(before + done, total)
        return lambda done: self._show(before + done, total)

    def _show(self, done: int, total: int) -> None:
        end = "\n" if done == total else ""
        print(f"\r{type(self).__name__}: {done} of {total} rows", end=end, file=sys.stderr, flush=True)

    def _epochs(self, rows: int) -> int:
        asked = self.n_epochs
        if isinstance(asked, str):
            if asked != "auto":
                raise ValueError(f"n_epochs is {asked!r} but has to be 'auto' or a whole number from 1")
            return max(1, -(-self._inputs_wanted() // rows))
        if int(asked) != asked or asked < 1:
            raise ValueError(f"n_epochs is {asked!r} but has to be 'auto' or a whole number from 1")
        return int(asked)

    def _inputs_wanted(self) -> int:
        """Return the number of inputs that it takes to grow, and as many again to settle."""
        return 1

    def _batch(self) -> int:
        return 1

    def _warn(self, learner: Learner, learnt: int) -> None:
        """Warn where other units were asked for than there are."""

    def _refuse(self, method: str, given: dict[str, Any]) -> None:
        if "sample_weight" in given:
            raise TypeError(
                f"{type(self).__name__}.{method} takes no sample_weight, because its rows are a stream: draw rows by their weights "
                "instead, X[rng.choice(len(X), size, p=weight / weight.sum())]"
            )
        if given:
            raise TypeError(f"{type(self).__name__}.{method} got an unexpected keyword argument {next(iter(given))!r}")

    def _fitted(self) -> Learner:
        if self._learner is None:
            raise NotFittedError(f"this {type(self).__name__} has learnt nothing yet: call fit or partial_fit first")
        return self._learner

    def __sklearn_is_fitted__(self) -> bool:
        return self._learner is not None

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        tags.transformer_tags.preserves_dtype = ["float64", "float32"]
        return tags

    def _more_tags(self) -> dict[str, Any]:
        """Say the same to scikit-learn before 1.6."""
        return {"preserves_dtype": [np.float64, np.float32]}

    def __getstate__(self) -> dict[str, Any]:
        state = dict(super().__getstate__())
        learner = state.pop("_learner", None)
        if learner is not None:
            state["_saved"] = (learner.kind, learner.single, learner.saved())
        return state

    def __setstate__(self, state: dict[str, Any]) -> None:
        state = dict(state)
        saved = state.pop("_saved", None)
        super().__setstate__(state)
        if saved is not None:
            self._learner = Learner.resumed(*saved)


class _Grower(_Quantizer):
    """What the growing neural gases have in common."""

    _kind = "gng"
    max_units: int | None
    growth_period: int
    winner_rate: float
    neighbour_rate: float
    split_factor: float
    decay: float
    error: str
    order: str
    batch_size: int | None

    def _inputs_wanted(self) -> int:
        return 1 if self.max_units is None else 2 * self.growth_period * self.max_units

    def _batch(self) -> int:
        asked = self.batch_size
        if asked is None:
            return 1
        if int(asked) != asked or not 1 <= asked <= 65_536:
            raise ValueError(f"batch_size is {asked!r} but has to be None or a whole number from 1 to 65536")
        return int(asked)


class GNG(_Grower):
    """Growing neural gas (Fritzke 1995); with `utility_threshold`, GNG-U (Fritzke 1997).

    Parameters
    ----------
    max_units : int or None
        The most units, at least 2. Without it the network grows for as long as it learns.
    growth_period : int
        λ: the number of inputs from one new unit to the next.
    winner_rate, neighbour_rate : float
        ε_b and ε_n: the part of the way to an input, 0 to 1, that the nearest unit and its neighbours move.
    max_age : int
        a_max: the age above which edges go, in inputs that one of their ends has won.
    split_factor, decay : float
        α and d: the factors on errors where a unit is added, and after each input.
    error : {"squared", "absolute", "relative"}
        What the nearest unit is charged: ‖x − w‖², ‖x − w‖ or ‖x − w‖ / ‖x‖.
    order : {"fritzke", "mslst"}
        The order of the parts of a step.
    utility_threshold : float or None
        k of GNG-U: the unit of least utility goes if the largest error is above k times that utility.
    removal : {"every_input", "when_full"}
        When units of little utility go.
    replay : int or None
        For streams that stay in one place for long: how many remembered inputs are learnt for each new one, drawn at
        random; 8 served all streams that were tried. None learns each input once, as it comes.
    replay_capacity : int
        How many inputs are remembered, at least 1.
    replay_memory : {"reservoir", "recent"}
        Which: any of the past with the same chance, for worlds that stay, or the last ones, for worlds that change.
    n_epochs : int or "auto"
        How often `fit` goes through X. "auto" goes on until there were inputs enough to grow `max_units`, and as many
        again to settle: 2 · max_units · growth_period.
    shuffle : bool
        Whether `fit` takes the rows in an order that is drawn again in each epoch. Sorted rows want it.
    random_state : int, RandomState or None
        The seed of that order.
    batch_size : int or None
        The number of rows whose nearest units are found at once, by products, 1 to 65536. With many features that is
        many times as fast, and the units are almost the same. None finds them row by row.
    compute_labels : bool
        Whether `fit` ends with `labels_`.
    progress : bool or callable
        True shows the rows learnt on standard error; a function is called with the rows learnt and the rows in all.

    Attributes
    ----------
    units_ : array of shape (units, features)
        The prototypes, the oldest first.
    unit_ids_ : array of shape (units,)
        The name of each unit, which it keeps when others go.
    edges_ : array of shape (edges, 2)
        The ends of each edge, as rows in `units_`.
    edge_ages_ : array of shape (edges,)
        The age of each edge, in inputs that its ends have won.
    clusters_ : array of shape (units,)
        The cluster of each unit: what edges join.
    labels_ : array of shape (rows,)
        The nearest unit of each row that `fit` was given.
    n_features_in_, feature_names_in_
        The number of columns of X, and their names if it was a frame.

    Warns
    -----
    ConvergenceWarning
        If `fit` ends with fewer units than `max_units`.

    The defaults are those of Fritzke 1995.
    """

    utility_threshold: float | None
    removal: str
    replay: int | None
    replay_capacity: int
    replay_memory: str

    def __init__(
        self,
        max_units: int | None = None,
        *,
        growth_period: int = 100,
        winner_rate: float = 0.2,
        neighbour_rate: float = 0.006,
        max_age: int = 50,
        split_factor: float = 0.5,
        decay: float = 0.995,
        error: str = "squared",
        order: str = "fritzke",
        utility_threshold: float | None = None,
        removal: str = "every_input",
        replay: int | None = None,
        replay_capacity: int = 10_000,
        replay_memory: str = "reservoir",
        n_epochs: int | str = "auto",
        shuffle: bool = False,
        random_state: Any = None,
        batch_size: int | None = None,
        compute_labels: bool = True,
        progress: Progress = False,
    ) -> None:
        self._keep(locals())

    def _warn(self, learner: Learner, learnt: int) -> None:
        found, asked = len(learner), self.max_units
        if asked is None or found >= asked or self.utility_threshold is not None:
            return
        wanted = self.growth_period * asked
        why = (
            f"{learnt} inputs are too few for a unit every {self.growth_period}: raise n_epochs or lower growth_period"
            if learnt < wanted
            else "X has too few different rows, or max_age is too low for so many units"
        )
        warnings.warn(f"GNG has {found} of the {asked} units of max_units: {why}", ConvergenceWarning, stacklevel=3)


class EquilibriumGNG(_Grower):
    """A growing neural gas that grows only while its mean error is above a threshold.

    Parameters
    ----------
    threshold : float
        The mean error above which it grows, in units of `error`: squared units of the features by default.
    gate : {"mean_error", "rate"}
        What is compared with it: the mean of the units' errors, as in MSLST, or that times 1 − decay, as in Provost's
        code for SODA.
    max_units, growth_period, winner_rate, neighbour_rate, max_age, split_factor, decay, error, order
        Those of `GNG`, with the defaults of MSLST. `max_units` is a bound, which need not be reached.
    n_epochs, shuffle, random_state, batch_size, compute_labels, progress
        Those of `GNG`.

    The attributes are those of `GNG`.
    """

    threshold: float
    gate: str

    def __init__(
        self,
        threshold: float = 1.0,
        *,
        gate: str = "mean_error",
        max_units: int | None = None,
        growth_period: int = 100,
        winner_rate: float = 0.2,
        neighbour_rate: float = 0.006,
        max_age: int = 50,
        split_factor: float = 0.5,
        decay: float = 0.995,
        error: str = "squared",
        order: str = "mslst",
        n_epochs: int | str = "auto",
        shuffle: bool = False,
        random_state: Any = None,
        batch_size: int | None = None,
        compute_labels: bool = True,
        progress: Progress = False,
    ) -> None:
        self._keep(locals())


class SOINN(_Quantizer):
    """One layer of a SOINN (Shen and Hasegawa 2006), which chooses the number of its units itself.

    Parameters
    ----------
    max_age : int
        The age above which edges go.
    period : int
        λ: the number of inputs after which units are inserted and noise is removed.
    insertion : {"unless_one_grew", "unless_all_grew", "off"}
        When an inserted unit is kept.
    denoising : {"few_wins", "low_rate", "off"}
        Which units count as noise.
    noise_factor : float
        c, from 0 to 1: the larger, the more units count as noise.
    threshold : float or None
        A constant distance beyond which an input is new; without it each unit has its own.
    n_epochs : int or "auto"
        How often `fit` goes through X; "auto" is once.
    shuffle, random_state, compute_labels, progress
        Those of `GNG`.

    The attributes are those of `GNG`. The defaults are those of the paper; max_age=20 with denoising="low_rate" serves
    noisy streams. An input that repeats exactly may make two units of one place, which share an edge, as the paper has it.
    """

    _kind = "soinn"
    period: int
    insertion: str
    denoising: str
    noise_factor: float
    threshold: float | None

    def __init__(
        self,
        *,
        max_age: int = 100,
        period: int = 100,
        insertion: str = "unless_one_grew",
        denoising: str = "few_wins",
        noise_factor: float = 1.0,
        threshold: float | None = None,
        n_epochs: int | str = "auto",
        shuffle: bool = False,
        random_state: Any = None,
        compute_labels: bool = True,
        progress: Progress = False,
    ) -> None:
        self._keep(locals())
