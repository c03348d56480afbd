"""Where the command `tolman` is."""

import os
import shutil
from pathlib import Path

ROOT = Path(__file__).parents[3]


def command():
    """Return the program `tolman`, on the PATH or as this workspace built it."""
    folder = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    built = [str(folder / profile / "tolman") for profile in ("release", "debug")]
    found = [os.environ.get("TOLMAN"), shutil.which("tolman"), *map(shutil.which, built)]
    return next((program for program in found if program), None)
