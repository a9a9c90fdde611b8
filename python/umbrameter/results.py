"""Opens the folder of a run: summary, columns and table, cells over the axes, layers, figures."""
from __future__ import annotations

import csv
import functools
import json
import math
import os
import pathlib
import shutil
import sqlite3
import weakref
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from .exr import Layers
from .parameters import parameters
from .statistics import schema_version, statistics

if TYPE_CHECKING:
    import pandas
    import xarray

Column = npt.NDArray[Any]
Path = str | os.PathLike[str]

_rows_at_once = 4096
_meanings_of_comparison = {
    "value": "value of the statistic, in the unit of its row", "half_width": "half width of its 95 % interval",
    "interval_of": "what the interval covers", "difference": "difference to the first run",
    "difference_lo": "lower end of its 95 % interval", "difference_hi": "upper end of its 95 % interval",
    "blocks": "blocks of pixels that decide", "verdict": "whether the difference is significant",
}
_dtypes = {"real": np.float64, "integer": np.int64, "truth": np.bool_, "text": np.object_}


@dataclass(frozen=True)
class Quantity:
    """What a column holds."""

    unit: str  #: "m", "texels", "px"; empty for words, "1" for shares (0 to 1) and plain numbers
    meaning: str


@dataclass(frozen=True)
class Figure:
    """A figure of a run; a notebook shows it."""

    name: str
    svg: pathlib.Path
    pdf: pathlib.Path
    png: pathlib.Path

    def _repr_svg_(self) -> str:
        return self.svg.read_text(encoding="utf-8")


class Run:
    """A run of the program, read from its folder when it is needed."""

    def __init__(self, folder: Path, answer: str = "", is_temporary: bool = False) -> None:
        self.folder = pathlib.Path(folder)
        self.answer = answer  #: the program's lines; empty for a folder that was loaded
        if is_temporary:  # it lives as long as its run
            weakref.finalize(self, shutil.rmtree, self.folder, True)
        listed = self.folder / ".umbrameter-run.json"
        if not listed.is_file():
            raise FileNotFoundError(f"{self.folder}: not a folder of umbrameter: it has no {listed.name}")
        facts = json.loads(listed.read_text(encoding="utf-8"))
        self.command: str = facts["command"]
        self.is_complete: bool = facts["complete"]  #: False while cells of a sweep are missing

    def __repr__(self) -> str:
        """Command, folder and answer."""
        return f"<umbrameter {self.command} in {self.folder}>" + (f"\n{self.answer}" if self.answer else "")

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """`summary.json`: every number, with the keys of docs/summary.md. Shares are 0 to 1, lengths metres."""
        path = self.folder / "summary.json"
        if not path.is_file():
            raise FileNotFoundError(f"{path} is missing: the run is not complete; rerun its command to resume it")
        summary: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        if int(summary.get("schema_version", 1)) > schema_version:
            raise ValueError(f"{path} has version {summary['schema_version']}, this package reads up to "
                             f"{schema_version}: install the package of the program that wrote it")
        return summary

    @property
    def columns(self) -> dict[str, Column]:
        """Columns of the table as arrays of one length, without pandas.

        Of a sweep one element per cell: the axes, then the statistics; of an incomplete one the cells measured so far. Of
        a tuning one per evaluated point. Of a report one per statistic and run. Of the others one per light and for ambient
        occlusion.
        """
        return self._table[0]

    @property
    def quantities(self) -> dict[str, Quantity]:
        """Unit and meaning of each column."""
        return self._table[1]

    @property
    def table(self) -> pandas.DataFrame:
        """The columns as a DataFrame; `attrs["units"]` and `attrs["meanings"]` have a text for each column."""
        import pandas

        table = pandas.DataFrame(self.columns)
        table.attrs["units"] = {name: each.unit for name, each in self.quantities.items()}
        table.attrs["meanings"] = {name: each.meaning for name, each in self.quantities.items()}
        return table

    @property
    def axes(self) -> dict[str, Column]:
        """Values of each axis of a complete sweep, in the order of the axes; the last varies fastest."""
        if self.command != "sweep" or not self.is_complete:
            raise ValueError(f"{self.folder}: only a complete sweep has axes, this is "
                             f"{'an incomplete sweep' if self.command == 'sweep' else 'a ' + self.command}")
        return {name: np.array(list(dict.fromkeys(self.columns[name].tolist())), self.columns[name].dtype)
                for name in self._axis_names}

    def over_axes(self, name: str) -> Column:
        """A column of a sweep as an array with one dimension for each axis, in their order."""
        return self.columns[name].reshape([len(values) for values in self.axes.values()])

    @property
    def cells(self) -> xarray.Dataset:
        """Statistics of a sweep over its axes; `attrs` have `units` and `long_name`, which xarray's plots show."""
        import xarray

        def attributes(name: str) -> dict[str, str]:
            return {"units": self.quantities[name].unit, "long_name": self.quantities[name].meaning}

        axes = self.axes
        variables = {name: (list(axes), self.over_axes(name), attributes(name)) for name in self.columns if name not in axes}
        coordinates = {name: (name, values, attributes(name)) for name, values in axes.items()}
        about = {"title": f"{self.summary['scene']['name']}: sweep", "source": f"umbrameter {self.summary['program']['version']}"}
        return xarray.Dataset(variables, coordinates, about)

    @functools.cached_property
    def layers(self) -> Layers:
        """Layers of `images.exr`, of a sweep those of the cell of least error; read when they are asked for."""
        path = self.folder / "images.exr"
        if not path.is_file():
            raise FileNotFoundError(f"{path} is missing: tune writes no images, nor does an incomplete run")
        return Layers(path)

    @property
    def figures(self) -> dict[str, Figure]:
        """Figures of the run's page by name; empty after `figures=False`."""
        paths = sorted((self.folder / "figures").glob("*.svg"))
        return {path.stem: Figure(path.stem, path, path.with_suffix(".pdf"), path.with_suffix(".png")) for path in paths}

    @functools.cached_property
    def _table(self) -> tuple[dict[str, Column], dict[str, Quantity]]:
        if self.command == "sweep":
            return _sweep_table(self.folder / ("results.sqlite" if self.is_complete else "results.partial.sqlite"))
        if self.command == "tune":
            return _tuning_table(self.folder / "evaluations.csv", self.summary)
        if self.command == "report":
            return _comparison_table(self.folder / "comparison.csv")
        rows = _rows_of_measured(self.summary)
        names = list(dict.fromkeys(name for _, row in rows for name in row))
        columns = {name: _column([row.get(name) for _, row in rows]) for name in names}
        known = {name: Quantity(**each) for kind, _ in rows for name, each in statistics.get(kind, {}).items()}
        quantities = {name: known.get(name, Quantity("", "")) for name in names}
        return columns, quantities

    @functools.cached_property
    def _axis_names(self) -> list[str]:
        return [name for name in self.columns if "." in name]


#: One or several runs, each as an object or by its folder.
Runs = Path | Run | Sequence[Path | Run]


def load(folder: Path) -> Run:
    """Open the folder of any run: of compare, sweep, tune, evaluate, trace, raster or report.

    Nothing but the list of its files is read. Raises FileNotFoundError where the folder holds no run.
    """
    return Run(folder)


def folders_of(runs: Runs) -> list[str]:
    """Folders of one or several runs. Raises ValueError where there is none."""
    listed = [runs] if isinstance(runs, str | os.PathLike | Run) else list(runs)
    if not listed:
        raise ValueError("no run is given")
    return [str(run.folder) if isinstance(run, Run) else os.fspath(run) for run in listed]


def _sweep_table(path: pathlib.Path) -> tuple[dict[str, Column], dict[str, Quantity]]:
    if not path.is_file():
        raise FileNotFoundError(f"{path} is missing")
    database = sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro", uri=True)
    try:
        described = database.execute("SELECT name, kind, unit, meaning FROM columns ORDER BY position").fetchall()
        (count,) = database.execute("SELECT count(*) FROM cells").fetchone()
        columns = {name: np.empty(count, _dtypes[kind]) for name, kind, _, _ in described}
        names = ", ".join('"' + name.replace('"', '""') + '"' for name in columns)
        cursor = database.execute(f"SELECT {names} FROM cells ORDER BY cell")
        first = 0
        while rows := cursor.fetchmany(_rows_at_once):
            for column, values in zip(columns.values(), zip(*rows, strict=True), strict=True):
                # NULL is an undefined number; None becomes NaN.
                column[first:first + len(rows)] = values
            first += len(rows)
    except sqlite3.DatabaseError as error:
        raise ValueError(f"{path}: cannot be read: {error}") from error
    finally:
        database.close()
    return columns, {name: Quantity(unit, meaning) for name, _, unit, meaning in described}


def _rows_of_measured(summary: Mapping[str, Any]) -> list[tuple[str, dict[str, Any]]]:
    """One row for each light and for ambient occlusion, with the kind of its statistics."""
    rows = []
    for shadow in summary.get("shadows", []):
        values = shadow.get("statistics") or {}
        rows.append((_kind_of(values), {"measured": "visibility", "light": shadow["light"], **_texts(shadow), **values}))
    for key in ("ao", "image"):
        if summary.get(key):
            rows.append((key, {"measured": key, "light": "", **(summary[key].get("statistics") or {})}))
    return rows


def _texts(shadow: Mapping[str, Any]) -> dict[str, float]:
    """The bias in all its units."""
    return {f"constant_bias_{unit}": value for unit, value in (shadow.get("constant_bias") or {}).items()}


def _kind_of(values: Mapping[str, Any]) -> str:
    kinds = ("visibility", "edges", "soft_visibility")
    return next((kind for kind in kinds if values and set(values) <= set(statistics[kind])), "visibility")


def _tuning_table(path: pathlib.Path, summary: Mapping[str, Any]) -> tuple[dict[str, Column], dict[str, Quantity]]:
    columns = _csv_columns(path)
    tuning = summary["tuning"]
    known = {name: Quantity(**each) for kind in ("image", "ao", "soft_visibility", "edges", "visibility")
             for name, each in statistics[kind].items()}
    quantities = {}
    for name in columns:
        statistic, _, case = name.rpartition("_")
        if name in tuning["axes"]:
            quantities[name] = Quantity(tuning["axes"][name]["unit"], parameters[name].meaning if name in parameters else "")
        elif case.isdigit() and statistic in known:
            where = tuning["best"]["cases"][int(case)]["case"]
            quantities[name] = Quantity(known[statistic].unit, f"{known[statistic].meaning}; {where}")
        else:
            quantities[name] = Quantity("", {"cost": f"minimized: {tuning['minimized']}"}.get(name, name))
    return columns, quantities


def _comparison_table(path: pathlib.Path) -> tuple[dict[str, Column], dict[str, Quantity]]:
    if not path.is_file():
        raise FileNotFoundError(f"{path} is missing: a report on a tuning has no table")
    columns = _csv_columns(path)
    return columns, {name: Quantity("", _meanings_of_comparison.get(name, name)) for name in columns}


def _csv_columns(path: pathlib.Path) -> dict[str, Column]:
    with path.open(encoding="utf-8", newline="") as file:
        names, *rows = csv.reader(file)
    return {name: _numbers(values) for name, values in zip(names, zip(*rows, strict=True), strict=True)}


def _numbers(texts: Iterable[str]) -> Column:
    """Numbers with NaN where one is missing; words as objects."""
    found = list(texts)
    try:
        if any(found):
            return np.array([float(text) if text else math.nan for text in found])
    except ValueError:
        pass
    return np.array(found, np.object_)


def _column(values: Iterable[Any]) -> Column:
    """Numbers as float64 with NaN where one is missing; anything else as objects."""
    found = list(values)
    if all(value is None or isinstance(value, int | float) and not isinstance(value, bool) for value in found):
        return np.array([math.nan if value is None else value for value in found], np.float64)
    return np.array(found, np.object_)
