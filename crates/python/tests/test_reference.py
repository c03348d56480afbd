"""Docstrings say what a user has to know, and the page in docs is made of them."""

import runpy
from pathlib import Path

import pytest
import tolman

ROOT = Path(__file__).parents[3]
REFERENCE = runpy.run_path(str(ROOT / "crates" / "python-quantizers" / "reference.py"))


def modules():
    pytest.importorskip("gymnasium")
    import tolman.gym

    return [tolman, tolman.gym]


def test_nothing_lacks_words():
    for module in modules():
        assert REFERENCE["faults"](module) == []


def test_the_page_is_that_of_the_docstrings():
    page = (ROOT / "docs" / "python-tolman.md").read_text(encoding="utf-8")
    assert page == REFERENCE["page"](*modules()), "make it again as the head of reference.py says"
