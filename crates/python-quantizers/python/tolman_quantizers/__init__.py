"""Growing graphs of prototypes, as estimators of scikit-learn.

>>> import numpy as np
>>> from tolman_quantizers import GNG
>>> gng = GNG(max_units=20).fit(np.random.default_rng(1).random((2000, 2)))
>>> gng.units_.shape
(20, 2)
"""

from ._estimators import GNG, SOINN, EquilibriumGNG
from ._memory import AssociativeMemory
from ._protocol import NotFittedError

__all__ = ["GNG", "SOINN", "AssociativeMemory", "EquilibriumGNG", "NotFittedError"]
