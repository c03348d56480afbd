"""The stubs say what the module has."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLE = Path(__file__).parents[1] / "examples" / "learn_a_maze.py"


def test_the_stubs_are_those_of_the_module():
    pytest.importorskip("mypy")
    checked = subprocess.run(
        [sys.executable, "-m", "mypy.stubtest", "tolman._tolman", "--ignore-disjoint-bases"],
        capture_output=True,
        text=True,
    )
    assert checked.returncode == 0, checked.stdout + checked.stderr


@pytest.mark.parametrize("what", [["-p", "tolman"], [str(EXAMPLE)]], ids=["module", "example"])
def test_it_is_typed(what):
    pytest.importorskip("mypy")
    checked = subprocess.run([sys.executable, "-m", "mypy", "--strict", *what], capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_pyright_is_content(tmp_path):
    pytest.importorskip("pyright")
    import tolman

    config = {"typeCheckingMode": "strict", "include": [str(EXAMPLE), *tolman.__path__], "reportMissingTypeStubs": False}
    (tmp_path / "pyrightconfig.json").write_text(json.dumps(config))
    command = [sys.executable, "-m", "pyright", "--pythonpath", sys.executable, "-p", str(tmp_path)]
    checked = subprocess.run(command, capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_gymnasium_is_not_needed_to_import():
    """The module is imported where neither gymnasium nor networkx can be."""
    code = "import sys; sys.modules.update(gymnasium=None, networkx=None); import tolman; assert 'tolman.gym' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
    code = "import sys; sys.modules['gymnasium'] = None; import tolman.gym"
    asked = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "pip install gymnasium" in asked.stderr
