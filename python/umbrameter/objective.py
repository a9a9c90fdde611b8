"""The error of a scene as a function of parameters, for optimisers: a persistent process, `umbrameter serve`."""
from __future__ import annotations

import contextlib
import json
import os
import subprocess
import threading
import weakref
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Self, Unpack

from .measure import command_words
from .parameters import Value, name_of, parameters, text_of
from .program import Error, Program
from .results import Path, Quantity

if TYPE_CHECKING:
    from .measure import ObjectiveOptions

#: Values in the order of the names, as SciPy passes them, or by name, as Optuna has them.
Point = Mapping[str, Value] | Iterable[Value] | float


@dataclass(frozen=True)
class Evaluation:
    """What was measured at one point."""

    statistics: Mapping[str, float]  #: by name, as `summary.json` has them; NaN where no pixel counts
    milliseconds: float  #: time of the measurement


class Objective:
    """The error of a scene as a function of parameters; `um.objective` makes it.

    Its process keeps the scene loaded until `close()`, the end of a `with` block, or the end of the object. Calls may come
    from several threads; they are measured one after the other.
    """

    def __init__(self, program: Program, names: Mapping[str, str], statistic: str) -> None:
        self._program = program
        self._units = names
        self._requests = 0
        self._lock = threading.Lock()
        self._close = weakref.finalize(self, _end, program)
        #: What `describe` of docs/serve.md says: version, scene, light, lights, renderer, parameters.
        self.description: Mapping[str, Any] = MappingProxyType(self._ask({"request": "describe"}))
        #: Unit and meaning of each statistic.
        self.quantities: Mapping[str, Quantity] = MappingProxyType(
            {each["name"]: Quantity(each["unit"], each["meaning"]) for each in self.description["statistics"]})
        #: The statistic that a call returns.
        self.statistic: str = statistic or self.description["objective"]
        #: Full names of the parameters, in the order of a call's values.
        self.names: tuple[str, ...] = tuple(names)
        if self.statistic not in self.quantities:
            self.close()
            raise Error(f"no statistic '{self.statistic}' is measured here: choose one of {', '.join(self.quantities)}, "
                        "or name an image metric in run_metrics")

    def __call__(self, point: Point | None = None, /, **values: Value) -> float:
        """Measure a point and return the statistic, by default the error that `tune` minimises.

        `point` has numbers in the order of `names`, or values by name; keywords are values by name.
        """
        return self.evaluate(point, **values).statistics[self.statistic]

    def evaluate(self, point: Point | None = None, /, **values: Value) -> Evaluation:
        """Measure a point and return all its statistics. Raises Error with the program's line for a refused value."""
        named = {name_of(word): value for word, value in {**self._by_name(point), **values}.items()}
        reply = self._ask({"request": "evaluate", "parameters": {name: self._json(name, named[name]) for name in named}})
        statistics = {name: float("nan") if value is None else value for name, value in reply["statistics"].items()}
        return Evaluation(MappingProxyType(statistics), reply["milliseconds"])

    def close(self) -> None:
        """End the process."""
        self._close()

    def __enter__(self) -> Self:
        """Leave it open until the end of the block."""
        return self

    def __exit__(self, *_: object) -> None:
        """End the process."""
        self.close()

    def _by_name(self, point: Point | None) -> Mapping[str, Value]:
        if point is None:
            return {}
        if isinstance(point, Mapping):
            return point
        # An array of SciPy without dimensions is iterable by its type only.
        is_one = isinstance(point, int | float) or getattr(point, "ndim", 1) == 0
        numbers: list[Any] = [point] if is_one else list(point)  # type: ignore[arg-type]
        if len(numbers) != len(self.names):
            raise TypeError(f"{len(numbers)} values for {len(self.names)} parameters: "
                            f"{', '.join(self.names) or 'none was named'}")
        return dict(zip(self.names, numbers, strict=True))

    def _json(self, name: str, value: Any) -> bool | int | float | str:
        if hasattr(value, "item"):
            value = value.item()  # of NumPy
        unit = self._units.get(name)
        if isinstance(value, bool | int | float | str):
            return text_of(value) + unit if unit and not isinstance(value, str) else value
        is_size = name in parameters and parameters[name].type == "size"
        return "x".join(map(text_of, value)) if is_size else text_of(value)

    def _ask(self, request: Mapping[str, Any]) -> dict[str, Any]:
        with self._lock:
            stdin, stdout = self._program.process.stdin, self._program.process.stdout
            assert stdin is not None and stdout is not None
            if not self._close.alive:
                raise Error("umbrameter: the objective is closed", command=self._program.command)
            self._requests += 1
            line = json.dumps({"id": self._requests, **request}, allow_nan=False)
            try:
                with contextlib.suppress(BrokenPipeError):
                    stdin.write(line.encode() + b"\n")
                    stdin.flush()
                answer = stdout.readline()
            except BaseException:  # Ctrl-C: the next reply would be that of this request
                self._program.process.kill()
                self._close()
                raise
            if not answer.endswith(b"\n"):
                self._close()
                raise self._program.error()
        reply: dict[str, Any] = json.loads(answer)
        if "error" in reply:
            raise Error("umbrameter: " + reply["error"], command=self._program.command)
        return reply


def _end(program: Program) -> None:
    """The end of its stdin ends the process."""
    assert program.process.stdin is not None
    with contextlib.suppress(OSError):
        program.process.stdin.close()
    try:
        program.process.wait(5)
    except subprocess.TimeoutExpired:
        program.process.kill()
        program.process.wait()
    program.close()


def objective(scene: Path, parameters: Sequence[str] | Mapping[str, str] = (), *, statistic: str = "",
              **options: Unpack[ObjectiveOptions]) -> Objective:
    """Keep a scene loaded and return its error as a function of parameters: `umbrameter serve`.

    `parameters` names, by keyword or full name, what the numbers of a call mean, in their order. A mapping gives the unit
    of each length, {"shadow_constant_bias": "texels"}; without one it is metres. `statistic` is what a call returns, the error
    that `tune` minimises if it is empty. Of a scene with several lights, `view_light` selects one.
    Raises Error with the program's line if the scene cannot be measured, TypeError for an unknown parameter.
    """
    if isinstance(parameters, str):
        raise TypeError(f"parameters is a list of names: write ['{parameters}']")
    units = parameters if isinstance(parameters, Mapping) else dict.fromkeys(parameters, "")
    names = {name_of(word): unit for word, unit in units.items()}
    unknown = {"force", "figures"} & options.keys()
    if unknown:
        raise TypeError(f"an objective writes no files: leave out {', '.join(sorted(unknown))}")
    words = ["serve", os.fspath(scene), *command_words(options)]
    return Objective(Program(words, subprocess.PIPE, options.get("progress")), names, statistic)
