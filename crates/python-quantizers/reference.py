"""Writes the reference of modules from their docstrings, and says what these lack.

    python crates/python-quantizers/reference.py tolman_quantizers > docs/python-quantizers.md
"""

from __future__ import annotations

import importlib
import inspect
import re
import sys
from collections.abc import Iterator
from typing import Any

SECTIONS = ("Parameters", "Attributes", "Returns", "Raises", "Warns")


def own(module: Any) -> dict[str, Any]:
    """Return what a module offers and this project wrote, by name."""
    family = module.__name__.partition(".")[0]
    offered = {name: getattr(module, name) for name in module.__all__}
    return {name: value for name, value in offered.items() if (getattr(value, "__module__", None) or family).partition(".")[0] == family}


def members(kind: type) -> Iterator[tuple[str, Any]]:
    """Yield the public methods and properties of a class, those of its bases of this project, too."""
    family = kind.__module__.partition(".")[0]
    known: dict[str, Any] = {}
    for base in reversed(kind.__mro__):
        if base.__module__.partition(".")[0] == family:
            known.update((name, value) for name, value in vars(base).items() if not name.startswith("_"))
    for name, value in known.items():
        is_field = name in getattr(kind, "_fields", ())
        if not is_field and (callable(value) or isinstance(value, (property, staticmethod, classmethod)) or inspect.isdatadescriptor(value)):
            yield name, value


def parameters(value: Any) -> list[str]:
    """Return the names of the arguments that a caller gives."""
    if isinstance(value, (staticmethod, classmethod)):
        is_bound = isinstance(value, classmethod)
        value = value.__func__
    else:
        is_bound = not inspect.isclass(value) and "." in getattr(value, "__qualname__", "")
    try:
        signature = inspect.signature(value)
    except (TypeError, ValueError):
        return []  # A property.
    names = [("*" * (what.kind is what.VAR_POSITIONAL) + "**" * (what.kind is what.VAR_KEYWORD)) + name for name, what in signature.parameters.items()]
    return [name for at, name in enumerate(names) if not (at == 0 and is_bound) and name not in ("self", "cls", "type")]


def doc_of(value: Any) -> str:
    """Return a docstring without its indent."""
    value = value.__func__ if isinstance(value, (staticmethod, classmethod)) else value
    return inspect.cleandoc(getattr(value, "__doc__", None) or "")


def parts(doc: str) -> tuple[str, dict[str, str]]:
    """Return the words before the sections, and the sections by name. Words after the last section's items are words."""
    pieces = re.split(r"^(\w+)\n-{3,}\n", doc, flags=re.M)
    words, sections = pieces[0].strip(), {}
    for name, text in zip(pieces[1::2], pieces[2::2]):
        lines = text.rstrip().split("\n")
        # An unindented line after an empty one, which names no item, ends the section.
        end = next((at for at in range(1, len(lines)) if not lines[at - 1] and lines[at] and lines[at][0] not in " -"), len(lines))
        sections[name] = "\n".join(lines[:end]).strip("\n")
        words += "\n\n" * (end < len(lines)) + "\n".join(lines[end:]).strip()
    return words, sections


def items(section: str) -> list[tuple[str, str]]:
    """Return the heads and texts of a section."""
    found: list[tuple[str, str]] = []
    for line in section.split("\n"):
        if line and not line.startswith(" "):
            found.append((line, ""))
        elif found:
            head, text = found[-1]
            found[-1] = (head, f"{text} {line.strip()}".strip())
    return found


def faults(module: Any) -> list[str]:
    """Return what docstrings lack: words, a parameter, what comes back, what is raised."""
    found = []

    def look(name: str, value: Any, is_class: bool) -> None:
        words, sections = parts(doc_of(value))
        if not words.split("\n")[0].strip().endswith((".", ":")) and not re.match(r"[^.]*\n?[^\n]*\.", words):
            found.append(f"{name}: no sentence says what it is or does")
        known = {part.strip() for head, _ in items(sections.get("Parameters", "")) for part in head.partition(" : ")[0].split(",")}
        asked = parameters(value)
        found.extend(f"{name}: the parameter {one} is not described" for one in asked if one not in known)
        found.extend(f"{name}: there is no parameter {one}" for one in sorted(known - set(asked)) if asked)
        if asked and not is_class:
            if "Raises" not in sections:
                found.append(f"{name}: it does not say what is raised")
            gives = inspect.signature(value.__func__ if isinstance(value, (staticmethod, classmethod)) else value).return_annotation
            says = "Returns" in sections or re.search(r"\bReturns?\b", words)
            # Functions of Rust have no annotation here: their stubs say it.
            if gives not in (None, "None", inspect.Signature.empty) and not says:
                found.append(f"{name}: it does not say what comes back")

    for name, value in own(module).items():
        look(name, value, inspect.isclass(value))
        if inspect.isclass(value):
            for member, what in members(value):
                look(f"{name}.{member}", what, False)
    return found


def page(*modules: Any) -> str:
    """Return the reference of modules as a page of Markdown."""
    told = [f"# Reference of {modules[0].__name__}", "", "Made of the docstrings, which `help` shows, too. [How to use it](python.md).", ""]
    shown: dict[Any, str] = {}
    for module in modules:
        names = own(module)
        told += [_plain(parts(doc_of(module))[0]), "", " · ".join(f"[{name}](#{name.lower()})" for name in names), ""]
        for name, value in names.items():
            told += [f"## {name}", "", *_described(name, value)]
            again: dict[str, list[str]] = {}
            for member, what in members(value) if inspect.isclass(value) else ():
                if what in shown:
                    again.setdefault(shown[what], []).append(f"`{member}`")
                    continue
                shown[what] = name
                told += [f"### {name}.{member}", "", *_described(f"{name}.{member}", what)]
            for other, same in again.items():
                told += [f"As those of [{other}](#{other.lower()}): {', '.join(same)}.", ""]
    return "\n".join(told).rstrip() + "\n"


def _described(name: str, value: Any) -> list[str]:
    words, sections = parts(doc_of(value))
    asked = parameters(value)
    told = [f"`{name}({', '.join(asked)})`", ""] if asked or not _is_field(value) else []
    told += [_plain(words), ""]
    for section in SECTIONS:
        if section in sections:
            told += [f"*{section}*", ""]
            for head, text in items(sections[section]):
                head, _, kind = head.partition(" : ")
                told.append(f"- `{head}`" + f" ({kind})" * bool(kind) + f": {text}" * bool(text))
            told.append("")
    return told


def _is_field(value: Any) -> bool:
    return inspect.isclass(value) or (inspect.isdatadescriptor(value) and not callable(value))


def _plain(words: str) -> str:
    """Return words with their examples in fences."""
    return re.sub(r"((?:^(?:>>>|\.\.\.) .*\n?(?:^(?!>>>|\.\.\.|\n).+\n?)*)+)", r"```pycon\n\1\n```\n", words, flags=re.M).replace("\n\n```\n", "\n```\n").strip()


if __name__ == "__main__":
    sys.stdout.write(page(*map(importlib.import_module, sys.argv[1:])))
