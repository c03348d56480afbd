"""What scikit-learn does for its estimators, with types, for each of its versions since 1.3."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from typing_extensions import Self

    class NotFittedError(ValueError, AttributeError):
        """The estimator has not seen any input yet: `sklearn.exceptions.NotFittedError`."""

    class ConvergenceWarning(UserWarning):
        """Fewer units were made than asked for: `sklearn.exceptions.ConvergenceWarning`."""

    class Estimator:
        """What comes from `BaseEstimator` and `TransformerMixin` of scikit-learn."""

        n_features_in_: int
        feature_names_in_: npt.NDArray[np.object_]

        def get_params(self, deep: bool = True) -> dict[str, Any]:
            """Return the parameters by name."""
            ...

        def set_params(self, **params: Any) -> Self:
            """Set parameters by name; they hold from the next `fit` on."""
            ...

        def set_output(self, *, transform: str | None = None) -> Self:
            """Choose what `transform` returns: "default", "pandas" or "polars"."""
            ...

        def get_feature_names_out(self, input_features: Any = None) -> npt.NDArray[np.object_]:
            """Return the names of the columns that `transform` returns: gng0, gng1, …"""
            ...

        def fit_transform(self, X: npt.ArrayLike, y: Any = None) -> npt.NDArray[Any]:
            """Learn from X, and return what `transform` does."""
            ...

        @classmethod
        def _get_param_names(cls) -> list[str]: ...
        def __sklearn_tags__(self) -> Any: ...
        def __getstate__(self) -> dict[str, Any]: ...
        def __setstate__(self, state: dict[str, Any]) -> None: ...
        def _repr_html_(self) -> str: ...

    def check_random_state(seed: Any) -> np.random.RandomState:
        """Return the generator that `random_state` means."""
        ...

    def _validated(estimator: Estimator, X: Any, **how: Any) -> npt.NDArray[Any]: ...

else:
    from sklearn.base import BaseEstimator, ClassNamePrefixFeaturesOutMixin, TransformerMixin
    from sklearn.exceptions import ConvergenceWarning, NotFittedError
    from sklearn.utils import check_random_state

    class Estimator(ClassNamePrefixFeaturesOutMixin, TransformerMixin, BaseEstimator):
        """A transformer of scikit-learn. No clusterer: more units than clusters are the point of it."""

    try:
        from sklearn.utils.validation import validate_data as _validated
    except ImportError:  # Before 1.6, where it is a method, and "ensure_all_finite" has another name.

        def _validated(estimator, X, *, ensure_all_finite, **how):
            return estimator._validate_data(X, force_all_finite=ensure_all_finite, **how)


__all__ = ["ConvergenceWarning", "Estimator", "NotFittedError", "check_random_state", "numbers", "optional"]


def optional(module: str) -> Any:
    """Return a module that only some methods need."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(f"this needs {module}: pip install {module.split('.')[0]}") from error


def numbers(estimator: Estimator, X: npt.ArrayLike, *, reset: bool, dtype: Any) -> npt.NDArray[Any]:
    """Return X as an array of one of the types; X itself if it is one. NaN and infinities are let through.

    With `reset`, the number and names of its columns are remembered, and else compared.
    """
    hidden = np.count_nonzero(getattr(X, "mask")) if isinstance(X, np.ma.MaskedArray) else 0
    if hidden:
        raise ValueError(f"X has {hidden} masked values: fill them, as by X.filled(), or leave their rows out")
    # Complex numbers in a list were another error than in an array.
    given = np.asarray(X) if isinstance(X, (list, tuple)) else X
    array = _validated(estimator, given, reset=reset, dtype=dtype, ensure_all_finite=False)
    return array if array.flags.aligned else np.require(array, None, "A")
