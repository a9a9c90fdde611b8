"""Budgets: bounds on the statistics of finished runs, `umbrameter check`."""
from __future__ import annotations

import json
import math
import os
import pathlib
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

from .parameters import text_of
from .program import Error, run
from .results import Path, Runs, folders_of

if TYPE_CHECKING:
    import pandas

#: A TOML file, or its [[budget]] tables: {"statistic": "acne", "light": "sun", "bound": "<= 0.3%"}.
Budget = Path | Sequence[Mapping[str, str | int | float]]


@dataclass(frozen=True)
class Check:
    """One bound, held against one statistic of one run."""

    kept: bool  #: whether the value keeps the bound
    statistic: str  #: "acne"; "|mean_error|" is the absolute value
    relation: str  #: "<", "<=", ">" or ">="
    bound: float  #: in `unit`
    unit: str  #: "1" for shares (0 to 1), "m", "dB"
    scene: str  #: empty where the budget names none and no run measured it; so are kind and light
    kind: str  #: "shadow", "ao" or "image"
    light: str  #: name; empty unless of a shadow
    run: str = ""  #: name of the run's folder; empty where no run measured it
    value: float = math.nan  #: in `unit`; NaN where no run measured it or no pixel counts
    half_width_95: float = math.nan  #: how far other rays may move the value up, 95 % of them; 0 where nothing was sampled
    excess: float = math.nan  #: how far the value is beyond the bound, in `unit`; negative where it is kept
    excess_in_intervals: float = math.nan  #: in halves of the 95 % interval, towards the bound; NaN without one

    def __str__(self) -> str:
        """One line: where, value and bound."""
        run = f"{self.run}: " if self.run else ""
        where = run + ", ".join(word for word in (self.scene, self.light or self.kind, self.statistic) if word)
        value = f"{self.value:.4g}" if self.run else "not measured,"
        unit = "" if self.unit in ("", "1") else f" {self.unit}"
        return f"{'kept' if self.kept else 'FAILED'}  {where}: {value} {self.relation} {self.bound:.4g}{unit}"


@dataclass(frozen=True)
class CheckResult:
    """What `check` found; it is true where every bound is kept. A notebook shows it as a table."""

    checks: tuple[Check, ...]  #: in the order of the budget
    markdown: str  #: the table of the program's `--summary`

    def __bool__(self) -> bool:
        """Whether every bound is kept."""
        return not self.broken

    @property
    def broken(self) -> list[Check]:
        """The bounds that are not kept."""
        return [each for each in self.checks if not each.kept]

    @property
    def table(self) -> pandas.DataFrame:
        """One row for each check, one column for each field of Check."""
        import pandas

        return pandas.DataFrame({each.name: [getattr(check, each.name) for check in self.checks] for each in fields(Check)})

    def __repr__(self) -> str:
        """How many are kept, and the others."""
        kept = f"<umbrameter check: {len(self.checks) - len(self.broken)} of {len(self.checks)} bounds kept>"
        return "\n".join([kept, *map(str, self.broken)])

    def _repr_markdown_(self) -> str:
        return self.markdown


def check(runs: Runs, budget: Budget, *, junit: Path | None = None, arguments: Sequence[str] = (),
          progress: bool | None = None) -> CheckResult:
    """Hold finished runs against a budget: `umbrameter check`.

    `runs` is one or several, each a Run or its folder; `budget` a TOML file (docs/check.md) or a list of its tables. A broken
    bound is a result and no exception, and so is a bound that no run measured. `junit` is an XML file to write.
    Raises Error with the program's line for a budget that is not understood and for a folder without a finished run.
    """
    with tempfile.TemporaryDirectory(prefix="umbrameter-") as folder:
        summary, written = pathlib.Path(folder) / "summary.md", pathlib.Path(folder) / "budget"
        if isinstance(budget, str | os.PathLike):
            path = os.fspath(budget)
        else:
            path = str(written)
            written.write_text(_toml(budget), encoding="utf-8")
        words = ["check", *folders_of(runs), "--budget", path, "--json", "--summary", str(summary)]
        words += ["--junit", os.fspath(junit)] if junit is not None else []
        try:
            found = json.loads(run([*words, *arguments], progress, exit_codes=(0, 1)))["checks"]
        except Error as error:  # a list has no path, and its third table stands in line 3
            raise Error(str(error).replace(str(written), "budget"), error.exit_code, error.command) from None
        return CheckResult(tuple(Check(**{name: math.nan if value is None else value for name, value in each.items()})
                                 for each in found), summary.read_text(encoding="utf-8"))


def update_budget(runs: Runs, budget: Path, *, progress: bool | None = None) -> str:
    """Set the bounds of a budget file to what runs measured, and some head room: `umbrameter check --update`.

    Where there is no file, it gets a bound for each error of the runs. Returns the program's line. Raises Error as check.
    """
    return run(["check", *folders_of(runs), "--budget", os.fspath(budget), "--update"], progress).strip()


def _toml(tables: Sequence[Mapping[str, str | int | float]]) -> str:
    """One table a line. A basic string of TOML is one of JSON, with all letters as they are."""
    def text(value: str | int | float) -> str:
        return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else text_of(value)

    lines = (", ".join(f"{key} = {text(value)}" for key, value in each.items()) for each in tables)
    return "budget = [" + ",\n".join(f"{{{line}}}" for line in lines) + "]\n"
