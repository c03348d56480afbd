"""The stubs say what the module has."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[1] / "examples"
EXAMPLES = [str(FOLDER / name) for name in ("learn_a_maze.py", "mapper_class.py", "grid_scores.py")]


def test_the_stubs_are_those_of_the_module():
    pytest.importorskip("mypy")
    checked = subprocess.run(
        [sys.executable, "-m", "mypy.stubtest", "tolman._tolman", "--ignore-disjoint-bases"],
        capture_output=True,
        text=True,
    )
    assert checked.returncode == 0, checked.stdout + checked.stderr


@pytest.mark.parametrize("what", [["-p", "tolman"], EXAMPLES], ids=["module", "examples"])
def test_it_is_typed(what):
    pytest.importorskip("mypy")
    checked = subprocess.run([sys.executable, "-m", "mypy", "--strict", *what], capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_pyright_is_content(tmp_path):
    pytest.importorskip("pyright")
    import tolman

    # It leaves out absolute paths, and by default what lies in an environment.
    include = [os.path.relpath(path, tmp_path) for path in [*EXAMPLES, *tolman.__path__]]
    config = {"typeCheckingMode": "strict", "include": include, "exclude": [], "reportMissingTypeStubs": False}
    (tmp_path / "pyrightconfig.json").write_text(json.dumps(config))
    command = [sys.executable, "-m", "pyright", "--pythonpath", sys.executable, "-p", str(tmp_path)]
    checked = subprocess.run(command, capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout + checked.stderr
    assert "Ignoring path" not in checked.stdout + checked.stderr


def test_gymnasium_is_not_needed_to_import():
    """The module is imported where neither gymnasium nor networkx can be."""
    code = "import sys; sys.modules.update(gymnasium=None, networkx=None); import tolman; assert 'tolman.gym' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
    code = "import sys; sys.modules['gymnasium'] = None; import tolman.gym"
    asked = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "pip install gymnasium" in asked.stderr
