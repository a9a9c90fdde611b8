"""The program's parameters, as `umbrameter parameters --json` describes them: names, units, limits.

`parameters.json` is that output, and `keywords.pyi` is made from it for editors and type checkers;
`scripts/docs --references` writes both.
"""
from __future__ import annotations

import difflib
import importlib.resources
import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

#: What a parameter may be set to: a size may be (width, height) in pixels, a list stands for its values with commas.
Value = bool | int | float | str | Iterable[Any]


@dataclass(frozen=True)
class Parameter:
    """One parameter of the program."""

    name: str  #: full name, "shadow.constant-bias": flag and column
    type: str  #: boolean, integer, number, string, size, choice or length
    default: bool | int | float | str
    unit: str  #: "m", "texels", "1"; empty where there is none
    meaning: str
    limits: str  #: in words
    minimum: float | None = None
    maximum: float | None = None
    choices: tuple[str, ...] = ()
    aliases: Mapping[str, str] | None = None  #: other words for choices

    @property
    def keyword(self) -> str:
        """Its name as a Python argument: `shadow_constant_bias`."""
        return self.name.replace(".", "_").replace("-", "_")


_document = json.loads((importlib.resources.files(__package__) / "parameters.json").read_text(encoding="utf-8"))

#: Version of the program that listed these parameters.
program_version: str = _document["version"]

#: Every parameter by its full name.
parameters: Mapping[str, Parameter] = MappingProxyType({each["name"]: Parameter(**each) for each in _document["parameters"]})

_names = {each.keyword: each.name for each in parameters.values()}


def text_of(value: Value) -> str:
    """As the command line writes it: true, 0.05, box; (320, 180) is 320x180 only for sizes, else 320,180."""
    if isinstance(value, str):
        return value
    if isinstance(value, Iterable):
        return ",".join(map(text_of, value))
    if hasattr(value, "item"):
        value = value.item()  # of NumPy
    return {True: "true", False: "false"}[value] if isinstance(value, bool) else repr(value)


def name_of(word: str) -> str:
    """Full name of a parameter from its keyword; a full name stays as it is, `engine.*` of an engine too.

    Raises TypeError with the nearest names where there is no such parameter.
    """
    if word in parameters or word.startswith("engine."):
        return word
    if word in _names:
        return _names[word]
    near = difflib.get_close_matches(word, [*_names, *parameters] if "." in word else _names, 3, 0.5)
    raise TypeError(f"no parameter '{word}'" + (f": did you mean {' or '.join(near)}?" if near else ""))


def flags(settings: Mapping[str, Any]) -> list[str]:
    """Command-line words of parameters given by keyword or full name."""
    words = []
    for word, value in settings.items():
        name = name_of(word)
        is_size = name in parameters and parameters[name].type == "size" and not isinstance(value, str)
        words += [f"--{name}", "x".join(map(text_of, value)) if is_size else text_of(value)]
    return words
