"""Growing graphs of prototypes, with the habits of scikit-learn's estimators."""

from __future__ import annotations

import inspect
from typing import Any

import numpy as np
import numpy.typing as npt

from ._tolman import Learner

try:
    from typing import Self  # type: ignore[attr-defined, unused-ignore]
except ImportError:
    Self = Any  # type: ignore[misc, assignment, unused-ignore]


class NotFittedError(ValueError, AttributeError):
    """The quantizer has not seen any input yet."""


class _Quantizer:
    """What all quantizers have in common.

    Arrays of float32 or float64 are read where they lie; others are converted to float64. The
    first inputs decide which of the two the units have. Python's lock is released meanwhile.
    """

    _kind: str
    _learner: Learner | None = None

    @classmethod
    def _names(cls) -> list[str]:
        return [name for name in inspect.signature(cls).parameters]

    def get_params(self, deep: bool = True) -> dict[str, Any]:
        """Return the parameters by name."""
        return {name: getattr(self, name) for name in self._names()}

    def set_params(self, **params: Any) -> Self:
        """Set parameters by name; they hold from the next `fit` on."""
        names = self._names()
        for name in params:
            if name not in names:
                raise ValueError(f"{name} is no parameter of {type(self).__name__}, which has {', '.join(names)}")
        for name, value in params.items():
            setattr(self, name, value)
        return self

    def fit(self, X: npt.ArrayLike, y: Any = None) -> Self:
        """Forget what was learnt, and learn from the rows of X in their order."""
        rows = _numbers(X)
        if rows.ndim == 2 and len(rows) == 0:
            raise ValueError("X has no rows, so there is nothing to learn")
        learner = self._begun(rows)
        learner.observe(rows)
        self._learner = learner
        return self

    def partial_fit(self, X: npt.ArrayLike, y: Any = None) -> Self:
        """Learn from the rows of X in their order, after all that was learnt before."""
        learner = self._learner
        if learner is None:
            rows = _numbers(X)
            learner = self._begun(rows)
            learner.observe(rows)
            self._learner = learner
        else:
            learner.observe(_like(learner, X))
        return self

    def _begun(self, rows: npt.NDArray[Any]) -> Learner:
        features = rows.shape[1] if rows.ndim == 2 else 1
        return Learner(self._kind, features, rows.dtype == np.float32, self.get_params())

    def predict(self, X: npt.ArrayLike) -> npt.NDArray[np.int64]:
        """Return for each row the number of the nearest unit: its row in `units_`."""
        learner = self._fitted()
        return learner.nearest(_like(learner, X))[0]

    def fit_predict(self, X: npt.ArrayLike, y: Any = None) -> npt.NDArray[np.int64]:
        """Learn from X, and return for each row the number of the nearest unit."""
        return self.fit(X).predict(X)

    def predict_cluster(self, X: npt.ArrayLike) -> npt.NDArray[np.int64]:
        """Return for each row the cluster of the nearest unit."""
        clusters: npt.NDArray[np.int64] = self.clusters_[self.predict(X)]
        return clusters

    def quantization_error(self, X: npt.ArrayLike) -> float:
        """Return the mean squared distance of the rows to their nearest units."""
        learner = self._fitted()
        squared = learner.nearest(_like(learner, X))[1]
        if len(squared) == 0:
            raise ValueError("X has no rows, so there is no error to measure")
        return float(squared.mean())

    def score(self, X: npt.ArrayLike, y: Any = None) -> float:
        """Return the mean squared distance with a minus, so that more is better."""
        return -self.quantization_error(X)

    def _fitted(self) -> Learner:
        if self._learner is None:
            raise NotFittedError(f"this {type(self).__name__} has learnt nothing yet: call fit or partial_fit first")
        return self._learner

    @property
    def units_(self) -> npt.NDArray[Any]:
        """The prototypes, a row a unit, the oldest first. A copy."""
        return self._fitted().units()

    @property
    def unit_ids_(self) -> npt.NDArray[np.int64]:
        """The name of each unit, which it keeps when others go."""
        return self._fitted().ids()

    @property
    def edges_(self) -> npt.NDArray[np.int64]:
        """The ends of each edge, as rows in `units_`."""
        return self._fitted().edges()[:, :2]

    @property
    def edge_ages_(self) -> npt.NDArray[np.int64]:
        """The age of each edge, in inputs that its ends have won."""
        return self._fitted().edges()[:, 2]

    @property
    def clusters_(self) -> npt.NDArray[np.int64]:
        """The cluster of each unit: what edges join is one."""
        return self._fitted().clusters()

    @property
    def n_features_in_(self) -> int:
        """The number of features of an input."""
        return self._fitted().dimension

    def to_networkx(self) -> Any:
        """Return units and edges as a graph of networkx."""
        import networkx  # type: ignore[import-untyped, unused-ignore]

        graph = networkx.Graph()
        for number, position in enumerate(self.units_):
            graph.add_node(number, position=tuple(position.tolist()))
        edges = self.edges_.tolist()
        graph.add_edges_from((low, high, {"age": age}) for (low, high), age in zip(edges, self.edge_ages_.tolist()))
        return graph

    def __repr__(self) -> str:
        given = ", ".join(f"{name}={value!r}" for name, value in self.get_params().items())
        return f"{type(self).__name__}({given})"

    def __getstate__(self) -> dict[str, Any]:
        state = dict(self.__dict__)
        learner = state.pop("_learner", None)
        if learner is not None:
            state["_saved"] = (learner.single, learner.saved())
        return state

    def __setstate__(self, state: dict[str, Any]) -> None:
        state = dict(state)
        saved = state.pop("_saved", None)
        self.__dict__.update(state)
        if saved is not None:
            self._learner = Learner.resumed(self._kind, *saved)


class GNG(_Quantizer):
    """Growing neural gas (Fritzke 1995); with `utility_threshold`, GNG-U (Fritzke 1997).

    The defaults are those of Fritzke 1995. Without `max_units` it grows for as long as it learns.
    """

    _kind = "gng"

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
    ) -> None:
        self.max_units = max_units
        self.growth_period = growth_period
        self.winner_rate = winner_rate
        self.neighbour_rate = neighbour_rate
        self.max_age = max_age
        self.split_factor = split_factor
        self.decay = decay
        self.error = error
        self.order = order
        self.utility_threshold = utility_threshold
        self.removal = removal


class EquilibriumGNG(_Quantizer):
    """A growing neural gas that grows only while its mean error is above a threshold.

    The defaults are those of MSLST; `gate="rate"` is Provost's code for SODA.
    """

    _kind = "gng"

    def __init__(
        self,
        threshold: float,
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
    ) -> None:
        self.threshold = threshold
        self.gate = gate
        self.max_units = max_units
        self.growth_period = growth_period
        self.winner_rate = winner_rate
        self.neighbour_rate = neighbour_rate
        self.max_age = max_age
        self.split_factor = split_factor
        self.decay = decay
        self.error = error
        self.order = order


class SOINN(_Quantizer):
    """One layer of a SOINN (Shen and Hasegawa 2006), which chooses the number of its units itself.

    The defaults are those of the paper; max_age=20 with denoising="low_rate" serves noisy streams.
    """

    _kind = "soinn"

    def __init__(
        self,
        *,
        max_age: int = 100,
        period: int = 100,
        insertion: str = "unless_one_grew",
        denoising: str = "few_wins",
        noise_factor: float = 1.0,
        threshold: float | None = None,
    ) -> None:
        self.max_age = max_age
        self.period = period
        self.insertion = insertion
        self.denoising = denoising
        self.noise_factor = noise_factor
        self.threshold = threshold


def _numbers(X: npt.ArrayLike) -> npt.NDArray[Any]:
    """Return X itself if it is an array of float32 or float64, and else a copy in float64."""
    single = type(X) is np.ndarray and X.dtype == np.float32
    return _of_type(X, np.float32 if single else np.float64)


def _like(learner: Learner, X: npt.ArrayLike) -> npt.NDArray[Any]:
    """Return X itself if it has the numbers of the learner, and else a copy that has."""
    return _of_type(X, np.float32 if learner.single else np.float64)


def _of_type(X: npt.ArrayLike, dtype: Any) -> npt.NDArray[Any]:
    if type(X) is np.ndarray and X.dtype == dtype and X.flags.aligned:
        return X
    try:
        converted = np.asarray(X)
        if converted.dtype.kind not in "biufO":
            raise TypeError(f"its type is {converted.dtype}")
        return np.require(converted, dtype, "A")
    except (TypeError, ValueError) as error:
        raise ValueError(f"X has to be an array of numbers: {error}") from error
