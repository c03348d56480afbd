"""Maps with and without odometry beside those of clone-structured cognitive graphs (CSCG).

CSCG names the folder with their public code (github.com/vicariousinc/naturecomm_cscg), which needs numba and tqdm. Both
sides learn from the same random walks. Offices need the command, built in release or named by TOLMAN.
"""

import os
import sys
from typing import NamedTuple

import numpy as np
import pytest

folder = os.environ.get("CSCG")
if folder is None:
    pytest.skip("CSCG names no folder with its code", allow_module_level=True)
sys.path.insert(0, folder)
pytest.importorskip("chmm_actions", reason="CSCG needs numba and tqdm", exc_type=Exception)

from cscg_maps import Score, cscg, with_odometry, without_odometry
from cscg_walks import in_a_maze, in_an_office

# Worlds a row: some CSCG have minutes of training.
WORLDS = int(os.environ.get("CSCG_MAZES", "3"))
# Fewer worlds than this give no share.
SHARED = 100
FIRST_SEED = 55401
# How the means of a score are written.
FORMS = {"purity": "{:.3f}", "places": "{:.2f}", "seconds": "{:.2g}"}


class Row(NamedTuple):
    world: str
    side: int
    moves: int
    robot: str

    def __str__(self):
        return f"{self.world} {self.side}x{self.side}, {self.moves} moves, {self.robot}"

    def walk(self, seed, folder):
        if self.world == "office":
            return in_an_office(self.side, self.moves, seed, folder)
        return in_a_maze(self.side, self.moves, self.robot == "open ways", seed)


ROWS = [
    Row("maze", 4, 2000, "open ways"),
    Row("maze", 4, 2000, "bumps"),
    Row("maze", 6, 5000, "open ways"),
    Row("maze", 6, 5000, "bumps"),
    Row("office", 5, 200, "open ways"),
    Row("office", 5, 200, "open ways and odometry"),
    Row("office", 5, 700, "open ways"),
    Row("office", 5, 700, "open ways and odometry"),
    Row("office", 7, 1000, "open ways"),
    Row("office", 7, 1000, "open ways and odometry"),
]


@pytest.fixture(scope="module")
def table():
    # Compiles what is compiled at the first call.
    cscg(in_a_maze(2, 100, True, 1), 1, odometry=False)
    lines = []
    yield lines
    heads = [f"{what}, {who}" for what in Score._fields for who in ("ours", "CSCG")]
    print("\n| world | moves | the robot observes | " + " | ".join(heads) + " |")
    print("| --- | ---: | --- |" + " ---: |" * len(heads))
    for row, ours, theirs in lines:
        cells = [f"{row.world}, {row.side} × {row.side}", f"{row.moves}", row.robot]
        for what in Score._fields:
            for scores in (ours, theirs):
                values = [getattr(score, what) for score in scores]
                if what == "exact":
                    cells.append(f"{sum(values)} of {len(values)}" if len(values) >= SHARED else "–")
                else:
                    cells.append(FORMS[what].format(np.mean(values)))
        print("| " + " | ".join(cells) + " |")


@pytest.mark.parametrize("row", ROWS, ids=str)
def test_ours_is_as_pure_in_less_time(row, table, tmp_path):
    odometry = "odometry" in row.robot
    ours, theirs = [], []
    for seed in range(FIRST_SEED, FIRST_SEED + WORLDS):
        walk = row.walk(seed, tmp_path)
        ours.append(with_odometry(walk) if odometry else without_odometry(walk))
        theirs.append(cscg(walk, seed, odometry))
    table.append((row, ours, theirs))
    assert sum(score.purity for score in ours) >= sum(score.purity for score in theirs)
    assert sum(score.seconds for score in ours) < sum(score.seconds for score in theirs)
