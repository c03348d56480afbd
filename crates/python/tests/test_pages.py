"""What the page and the example show runs as it stands."""

import os
import re
import runpy
import sys
from pathlib import Path

import pytest
from command import command

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs" / "python.md"
NOTEBOOKS = sorted((ROOT / "crates" / "python" / "examples").glob("*.ipynb"))
EXAMPLE = ROOT / "crates" / "python" / "examples" / "learn_a_maze.py"
SCORES = ROOT / "crates" / "python" / "examples" / "grid_scores.py"


def test_the_page_runs(monkeypatch, capsys):
    pieces = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.S)
    assert len(pieces) == 5
    monkeypatch.chdir(ROOT)
    names: dict = {}
    for piece in pieces:
        exec(compile(piece, str(PAGE), "exec"), names)
    assert names["nearest"].shape == (5, 2)
    told = capsys.readouterr().out
    assert "(1000, 2)" in told and "64 places, 0 ways untried" in told


@pytest.mark.parametrize("arguments", [[], [str(ROOT / "mazes" / "star.maze")]])
def test_the_example_runs(monkeypatch, capsys, arguments):
    monkeypatch.setattr(sys, "argv", [str(EXAMPLE), *arguments])
    runpy.run_path(str(EXAMPLE), run_name="__main__")
    told = capsys.readouterr().out
    assert "right: True" in told and "30 prototypes" in told and "way on the map: [0" in told


def test_the_scores_are_made(monkeypatch, capsys):
    pytest.importorskip("gymnasium")
    monkeypatch.setattr(sys, "argv", [str(SCORES), "--episodes", "1", "--size", "5"])
    runpy.run_path(str(SCORES), run_name="__main__")
    rows = {(row[:11].strip(), row[12:23].strip()): row[24:].split() for row in capsys.readouterr().out.splitlines()[1:]}
    assert all(float(row[0]) >= float(row[1]) for (task, _), row in rows.items() if "learn" not in task)
    # Who plans has all errands done, and sees all.
    assert {rows[who][5] for who in (("errand", "planner"), ("learn", "planner"), ("learn, rays", "micromouse"))} == {"100"}
    assert len(rows) == 10


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_the_notebooks_run(notebook, monkeypatch):
    if "arena" in notebook.read_text(encoding="utf-8"):
        if command() is None:
            pytest.skip("the command tolman is not built")
        monkeypatch.setenv("PATH", os.pathsep.join([str(Path(command()).parent), os.environ["PATH"]]))
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    pytest.importorskip("matplotlib")
    if notebook.stem == "place_cells":
        pytest.importorskip("ratinabox")
    read = nbformat.read(notebook, as_version=4)
    nbclient.NotebookClient(read, timeout=600, kernel_name="python3", resources={"metadata": {"path": str(ROOT)}}).execute()
