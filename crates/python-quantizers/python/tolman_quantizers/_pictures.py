"""Pictures of units and edges."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._protocol import optional

_COLOURS = ["#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e", "#17becf", "#8c564b", "#e377c2", "#7f7f7f", "#bcbd22"]
_SIDE = 320


def _placed(units: npt.NDArray[Any], features: tuple[int, int]) -> npt.NDArray[np.float64]:
    """Return two features of each unit; with one feature alone, the second is 0."""
    count = units.shape[1]
    for feature in features:
        if not 0 <= feature < max(count, 2):
            raise ValueError(f"features has {feature}, but the features are 0 to {count - 1}")
    columns = [units[:, feature] if feature < count else np.zeros(len(units)) for feature in features]
    return np.column_stack(columns).astype(np.float64)


def svg(
    units: npt.NDArray[Any], edges: npt.NDArray[np.int64], clusters: npt.NDArray[np.int64], features: tuple[int, int]
) -> str:
    """Return a picture as SVG: a dot a unit, its colour the cluster's."""
    at = _placed(units, features)
    low = at.min(axis=0)
    at = 8 + (at - low) / max(float((at.max(axis=0) - low).max()), np.finfo(np.float64).tiny) * (_SIDE - 16)
    at[:, 1] = _SIDE - at[:, 1]
    lines = "".join(
        f'<line x1="{at[a, 0]:.1f}" y1="{at[a, 1]:.1f}" x2="{at[b, 0]:.1f}" y2="{at[b, 1]:.1f}"/>' for a, b in edges.tolist()
    )
    dots = "".join(
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{_COLOURS[cluster % len(_COLOURS)]}"/>'
        for (x, y), cluster in zip(at.tolist(), clusters.tolist())
    )
    title = f"<title>{len(units)} units, {len(edges)} edges</title>"
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{_SIDE}" height="{_SIDE}" viewBox="0 0 {_SIDE} {_SIDE}">'
        f'{title}<g stroke="#999">{lines}</g>{dots}</svg>'
    )


def plot(
    ax: Any, units: npt.NDArray[Any], edges: npt.NDArray[np.int64], clusters: npt.NDArray[np.int64], features: tuple[int, int]
) -> Any:
    """Draw with matplotlib into `ax`, or into new axes, and return the axes."""
    axes = optional("matplotlib.pyplot").subplots()[1] if ax is None else ax
    at = _placed(units, features)
    lines = optional("matplotlib.collections").LineCollection(at[edges], colors="#999", linewidths=0.8)
    axes.add_collection(lines)
    axes.scatter(at[:, 0], at[:, 1], s=12, c=[_COLOURS[cluster % len(_COLOURS)] for cluster in clusters.tolist()], zorder=2)
    return axes
