"""The types are whole, for mypy and pyright, and the stubs say what the module has."""

import json
import subprocess
import sys

import pytest

USE = """\
import numpy as np
from tolman_quantizers import GNG, SOINN, EquilibriumGNG

x = np.zeros((3, 2))
reveal_type(GNG(max_units=5).fit(x).partial_fit(x).set_params(max_age=3))
reveal_type(EquilibriumGNG(0.5).fit(x).predict(x))
print(SOINN().fit(x).labels_, GNG().fit_transform(x), GNG().get_params(), GNG().to_networkx(), GNG().plot())
"""


def run(*command, **how):
    done = subprocess.run([sys.executable, "-m", *map(str, command)], capture_output=True, text=True, **how)
    return done.returncode, done.stdout + done.stderr


def test_the_stubs_are_those_of_the_module():
    pytest.importorskip("mypy")
    status, told = run("mypy.stubtest", "tolman_quantizers._quantizers", "--ignore-disjoint-bases")
    assert status == 0, told


def test_mypy_is_content(tmp_path):
    pytest.importorskip("mypy")
    use = tmp_path / "use.py"
    use.write_text(USE)
    status, told = run("mypy", "--strict", "-p", "tolman_quantizers")
    assert status == 0, told
    status, told = run("mypy", "--strict", use)
    assert status == 0 and told.count("GNG") == 1 and "int64" in told or "signedinteger" in told, told


def test_pyright_is_content(tmp_path):
    pytest.importorskip("pyright")
    import tolman_quantizers

    (tmp_path / "use.py").write_text(USE)
    package = list(tolman_quantizers.__path__)[0]
    config = {"typeCheckingMode": "strict", "include": [".", package], "ignore": [], "reportMissingTypeStubs": False}
    (tmp_path / "pyrightconfig.json").write_text(json.dumps(config))
    status, told = run("pyright", "--pythonpath", sys.executable, "-p", tmp_path)
    assert status == 0 and '"GNG"' in told, told
