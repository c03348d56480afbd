"""The process of a mapper that `tolman.arena` sends: `python -m tolman._serve SOURCE CLASS`."""

import importlib
import os
import runpy
import sys

from ._arena import IS_SERVING

if __name__ == "__main__":
    source, name = sys.argv[1:3]
    os.environ[IS_SERVING] = name
    is_file = source.endswith(".py")
    names = runpy.run_path(source) if is_file else vars(importlib.import_module(source))
    names[name].run()
