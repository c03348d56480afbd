"""A mapper of four methods, and the arena that it enters."""

import io
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import tolman
from command import command

ROOT = Path(__file__).parents[3]
EXAMPLE = ROOT / "crates" / "python" / "examples" / "mapper_class.py"
HELLO = {"protocol": 1, "robot": "pioneer", "radius": 0.2, "step_us": 1, "step_limit": None, "corridor_width": 1.0}
STEP = {"step": 0, "sensing": {"compass": 0.0}, "landmark": "Start", "task": "explore", "put_down": False}


def answers(mapper, *lines):
    """Return what a mapper answers to the hello and to further lines."""
    out = io.StringIO()
    mapper.run([json.dumps(line) for line in ({"hello": HELLO}, *lines)], out)
    return [json.loads(line)["answer"] for line in out.getvalue().splitlines()]


class Silent(tolman.Mapper):
    """It says nothing of where it is, and prints."""

    def step(self, told):
        print("seen", told["step"])
        assert "ask" not in told
        return None

    def map(self):
        return {"places": [], "links": []}


def test_it_answers_what_it_is_asked_and_no_more(capsys):
    class Mine(Silent):
        def begin(self, hello):
            self.wide, self.certain = hello["corridor_width"], 0.75

        def map(self):
            return {"places": [{"id": np.int64(4), "position": np.zeros(2)}], "links": []}

        def certainty(self):
            return self.certain * self.wide

    told = answers(Mine, {**STEP, "ask": ["belief"]}, {"ask": ["map"]}, {"ask": ["map", "verdict"]})
    drawn = {"places": [{"id": 4, "position": [0.0, 0.0]}], "links": []}
    assert told == [{"belief": []}, {"map": drawn}, {"map": drawn, "verdict": {"certainty": 0.75}}]
    kept = capsys.readouterr()
    assert "seen 0" in kept.err and not kept.out
    assert answers(Silent, {"ask": ["verdict"]}) == [{"verdict": {"certainty": None}}]


@pytest.mark.parametrize(
    ("belief", "written"),
    [
        (None, []),
        ((1, 2.5), [{"point": [1, 2.5]}]),
        (np.array([0.5, 0.25]), [{"point": [0.5, 0.25]}]),
        (3, [{"place": 3}]),
        (np.int64(3), [{"place": 3}]),
        ([{"place": 1, "weight": 0.7}, {"point": (0, 1), "weight": 0.3}], [{"place": 1, "weight": 0.7}, {"point": [0, 1], "weight": 0.3}]),
    ],
)
def test_a_belief_is_a_point_or_a_place_or_guesses(belief, written):
    class Mine(Silent):
        def step(self, told):
            return belief

    assert answers(Mine, {**STEP, "ask": ["belief"]}) == [{"belief": written}]


def test_wrong_answers_are_named():
    class Bare(tolman.Mapper):
        pass

    class Odd(Silent):
        def step(self, told):
            return {1, 2}

        def certainty(self):
            return float("nan")

    with pytest.raises(NotImplementedError, match="Bare has no method step"):
        answers(Bare, {**STEP, "ask": ["belief"]})
    with pytest.raises(NotImplementedError, match="Bare has no method map"):
        answers(Bare, {"ask": ["map"]})
    with pytest.raises(TypeError, match="a set, which JSON has not"):
        answers(Odd, {**STEP, "ask": ["belief"]})
    with pytest.raises(ValueError, match="not JSON compliant"):
        answers(Odd, {"ask": ["verdict"]})


def test_who_cannot_be_found_by_another_process_is_named(tmp_path):
    class Hidden(Silent):
        pass

    with pytest.raises(TypeError, match="has to be a class that is made of tolman.Mapper"):
        tolman.arena(Hidden())
    with pytest.raises(ValueError, match="Hidden is not at the top of its file"):
        tolman.arena(Hidden)
    asked = subprocess.run(
        [sys.executable, "-"],
        input="import tolman\nclass Mine(tolman.Mapper): pass\ntolman.arena(Mine)",
        capture_output=True,
        text=True,
    )
    assert "Mine stands in no file" in asked.stderr
    with pytest.raises(FileNotFoundError):
        tolman.arena(Silent, command=str(tmp_path / "tolman"))


@pytest.mark.skipif(command() is None, reason="the command tolman is not built")
class TestArena:
    def test_the_example_has_right_maps(self, monkeypatch):
        monkeypatch.syspath_prepend(str(EXAMPLE.parent))
        from mapper_class import DrivenCells

        rows = tolman.arena(DrivenCells, families=["star", "ring"], worlds=1, seed=1, system="oracle", command=command())
        assert [(row["system"], row["world"]) for row in rows[:2]] == [("DrivenCells", "star 0"), ("oracle", "star 0")]
        assert [row["right"] for row in rows] == [True, None, True, None]

    def test_the_command_takes_its_file(self):
        arena = [command(), "arena", "--family", "star", "--worlds", "1", "--json", "--mapper", f"'{sys.executable}' '{EXAMPLE}'"]
        held = subprocess.run(arena, capture_output=True, text=True, check=True)
        assert json.loads(held.stdout)["right"] is True

    def test_what_goes_wrong_is_told(self, capsys):
        with pytest.raises(ValueError, match="family"):
            tolman.arena(Silent, families="round", command=command())
        (row,) = tolman.arena(Failing, families="star", worlds=1, command=command(), log=True)
        assert "exit status: 1" in row["why"] and not row["right"]
        assert "ZeroDivisionError" in capsys.readouterr().err

    def test_a_file_that_calls_the_arena_while_it_is_looked_up_starts_no_further_process(self, tmp_path):
        mine = tmp_path / "mine.py"
        call = f"tolman.arena(Mine, families='star', worlds=1, log=True, command={command()!r})"
        mine.write_text(f"import tolman\nclass Mine(tolman.Mapper): pass\nprint({call})\n", encoding="utf-8")
        held = subprocess.run([sys.executable, str(mine)], capture_output=True, text=True)
        assert "put the call under if __name__" in held.stderr and "exit status: 1" in held.stdout


class Failing(Silent):
    """It fails in its first step."""

    def step(self, told):
        return 1 / 0
