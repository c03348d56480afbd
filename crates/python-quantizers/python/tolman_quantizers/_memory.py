"""The associative memory."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._protocol import NotFittedError
from ._quantizers import Memory

if TYPE_CHECKING:
    from typing_extensions import Self

_Rows = npt.NDArray[np.float64]


class AssociativeMemory:
    """A memory of pairs, a key and its response, recalled from either (Sudo, Sato, Hasegawa 2009).

    A SOINN learns each pair as one vector. A key may have many responses and a response many keys.

    >>> memory = AssociativeMemory().associate([[0, 0], [0, 1]], [[0, 1], [1, 1]])
    >>> memory.response([[0.1, 0.1]])
    array([[0., 1.]])
    >>> memory.chain([0, 0], reach=0.2)
    array([[0., 1.],
           [1., 1.]])

    Parameters
    ----------
    max_age, period, insertion, denoising, noise_factor, threshold
        Those of `SOINN`. The defaults keep each pair that differs from all before, even if it comes once; those of
        `SOINN` serve noisy pairs that come often.

    Numbers are float64: other types are copied. A wrong parameter raises a `ValueError` when the first pair is learnt.
    """

    def __init__(
        self,
        *,
        max_age: int = 100,
        period: int = 100,
        insertion: str = "off",
        denoising: str = "off",
        noise_factor: float = 1.0,
        threshold: float | None = 0.0,
    ) -> None:
        self._params: dict[str, Any] = {
            "max_age": max_age,
            "period": period,
            "insertion": insertion,
            "denoising": denoising,
            "noise_factor": noise_factor,
            "threshold": threshold,
        }
        self._memory: Memory | None = None

    def associate(self, keys: npt.ArrayLike, responses: npt.ArrayLike) -> Self:
        """Learn that each row of responses belongs to that row of keys, after all that was learnt before.

        Parameters
        ----------
        keys : array of shape (pairs, key features)
        responses : array of shape (pairs, response features)

        Returns
        -------
        self

        Raises
        ------
        ValueError
            If a parameter is wrong, or a row, which the message names: the rows before it are learnt.
        """
        left, right = _rows("keys", keys), _rows("responses", responses)
        memory = self._memory
        if memory is None:
            memory = Memory(left.shape[1], right.shape[1], self._params)
        memory.associate(left, right)
        self._memory = memory
        return self

    def response(self, keys: npt.ArrayLike) -> _Rows:
        """Return the response to the known key nearest to each row.

        Parameters
        ----------
        keys : array of shape (rows, key features)

        Returns
        -------
        array of shape (rows, response features)

        Raises
        ------
        NotFittedError
            If no pair was learnt yet.
        ValueError
            If a row has other features than were learnt, or a number that cannot be compared.
        """
        return self._known().recall(_rows("keys", keys), False)

    def key(self, responses: npt.ArrayLike) -> _Rows:
        """Return the key of the known response nearest to each row.

        Parameters
        ----------
        responses : array of shape (rows, response features)

        Returns
        -------
        array of shape (rows, key features)

        Raises
        ------
        NotFittedError
            If no pair was learnt yet.
        ValueError
            If a row has other features than were learnt, or a number that cannot be compared.
        """
        return self._known().recall(_rows("responses", responses), True)

    def responses(self, key: npt.ArrayLike, reach: float) -> _Rows:
        """Return all responses to keys within the distance `reach` of one key, the nearest key first.

        Parameters
        ----------
        key : array of shape (key features,)
        reach : float
            In the unit of the features, from 0.

        Returns
        -------
        array of shape (found, response features)

        Raises
        ------
        NotFittedError
            If no pair was learnt yet.
        ValueError
            If a row has other features than were learnt, or a number that cannot be compared.
        """
        return self._known().recall_all(_row("key", key), reach, False)

    def keys(self, response: npt.ArrayLike, reach: float) -> _Rows:
        """Return all keys of responses within the distance `reach` of one response, the nearest response first.

        Parameters
        ----------
        response : array of shape (response features,)
        reach : float
            In the unit of the features, from 0.

        Returns
        -------
        array of shape (found, key features)

        Raises
        ------
        NotFittedError
            If no pair was learnt yet.
        ValueError
            If a row has other features than were learnt, or a number that cannot be compared.
        """
        return self._known().recall_all(_row("response", response), reach, True)

    def chain(self, key: npt.ArrayLike, *, reach: float, most: int = 1000) -> _Rows:
        """Return the response to a key, the response to that, and so on, while a key lies within `reach`.

        Parameters
        ----------
        key : array of shape (features,)
        reach : float
            The distance within which a key has to lie, in the unit of the features.
        most : int
            The most responses: a memory of a cycle goes round.

        Returns
        -------
        array of shape (found, features)

        Raises
        ------
        NotFittedError
            If no pair was learnt yet.
        ValueError
            If a row has other features than were learnt, or a number that cannot be compared; if keys and
            responses differ in their number of features.
        """
        return self._known().chain(_row("key", key), reach, most)

    def __len__(self) -> int:
        return 0 if self._memory is None else len(self._memory)

    def __repr__(self) -> str:
        return f"<AssociativeMemory: {len(self)} units>"

    def _known(self) -> Memory:
        if self._memory is None:
            raise NotFittedError("this AssociativeMemory has learnt nothing yet: call associate first")
        return self._memory


def _rows(name: str, values: npt.ArrayLike) -> _Rows:
    """Return values as rows."""
    array = np.asarray(values, dtype=np.float64)
    if array.ndim != 2:
        raise ValueError(f"{name} has {array.ndim} dimensions but has to have 2: one row each")
    return array


def _row(name: str, values: npt.ArrayLike) -> _Rows:
    """Return the values of one vector as a row."""
    array = np.asarray(values, dtype=np.float64)
    if array.ndim != 1:
        raise ValueError(f"{name} has {array.ndim} dimensions but has to have 1: it is one vector")
    return array.reshape(1, -1)
