"""The rivals enter the arena, and learn a small world. They need the command, as the comparison with CSCG does."""

import importlib.util
import json
import subprocess
import sys
from pathlib import Path

import pytest
from cscg_walks import COMMAND

ROOT = Path(__file__).parents[3]
RIVALS = ROOT / "crates" / "python" / "examples" / "rivals"
STAR = ROOT / "mazes" / "star.maze"
needs_command = pytest.mark.skipif(not Path(COMMAND).exists(), reason="TOLMAN names no command")


def row_of(role, program):
    """Return the row of a program in the star."""
    command = [COMMAND, "arena", STAR, role, f"{sys.executable} {RIVALS}/{program}", "--json"]
    rows = subprocess.run([*command, "--time-limit", "600"], check=True, stdout=subprocess.PIPE).stdout
    return json.loads(rows)


@needs_command
@pytest.mark.parametrize(
    "role, program, knows",
    [
        ("--mapper", "grid_mapper.py", "right"),
        ("--mapper", "cscg.py", None),
        ("--mapper", "cscg.py --odometry", None),
        ("--brain", "active_locate.py", "right"),
    ],
)
def test_a_rival_is_judged(role, program, knows):
    row = row_of(role, program)
    assert row["abstained"] is None and row["purity"] > 0.5
    # It answered what it was asked. Whether the driver's walk shows where it is, is not its own.
    assert row["why"] in (None, "it does not say where it is")
    assert row["right"] or knows is None


@needs_command
def test_homing_moves_from_cell_to_cell_until_its_time_is_up():
    pytest.importorskip("aalpy")
    row = row_of("--brain", "homing_brain.py")
    # It would need some fifty times the moves.
    assert row["why"] == "it was still looking when its time was up"
    assert row["metres_over_corridors"] > 9 and row["says"] != "right"


def test_homing_and_the_bump_map_learn_a_maze(monkeypatch, capsys):
    pytest.importorskip("aalpy")
    monkeypatch.setattr(sys, "argv", ["homing.py", "--mazes", "2", "--side", "3", "--seed", "5"])
    found = importlib.util.spec_from_file_location("homing", RIVALS / "homing.py")
    homing = importlib.util.module_from_spec(found)
    found.loader.exec_module(homing)
    homing.main()
    told = capsys.readouterr().out
    assert "| bump_map | 2 of 2 |" in told and "| homing | 2 of 2 |" in told
