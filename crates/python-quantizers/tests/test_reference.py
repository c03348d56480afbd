"""Docstrings say what a user has to know, and the page in docs is made of them."""

import runpy
import types
from pathlib import Path

import pytest
import tolman_quantizers

ROOT = Path(__file__).parents[3]
REFERENCE = runpy.run_path(str(ROOT / "crates" / "python-quantizers" / "reference.py"))


def test_nothing_lacks_words():
    assert REFERENCE["faults"](tolman_quantizers) == []


def test_the_page_is_that_of_the_docstrings():
    page = (ROOT / "docs" / "python-quantizers.md").read_text(encoding="utf-8")
    assert page == REFERENCE["page"](tolman_quantizers), "make it again as the head of reference.py says"


def learn(rows, *, step=1):
    """Learn rows.

    Parameters
    ----------
    row : array

    Returns
    -------
    int
    """


@pytest.mark.parametrize("lack", ["the parameter rows is not", "the parameter step is not", "no parameter row", "what is raised"])
def test_what_is_lacking_is_found(lack):
    module = types.ModuleType(__name__)
    module.__dict__.update(__all__=["learn"], learn=learn)
    assert any(lack in fault for fault in REFERENCE["faults"](module))
