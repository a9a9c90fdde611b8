"""Plots of runs with matplotlib, in the style of the program's figures.

Each function draws into `axes`, or into a new figure, and returns the Axes: change every label before you publish.
Shares are drawn in per cent. Lines differ in colour, dash and marker, so that they can be told apart in grey.
"""
from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, ParamSpec

import numpy as np

from .results import Column, Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ink, grid = "#1a1a1a", "#e7e7e7"
#: Style of the plots; `matplotlib.rcParams.update(plot.style)` sets it for your own.
style: dict[str, Any] = {
    "font.family": "DejaVu Sans", "font.size": 8, "axes.edgecolor": "#666666", "axes.labelcolor": ink, "axes.grid": True,
    "axes.axisbelow": True, "axes.spines.top": False, "axes.spines.right": False, "grid.color": grid, "grid.linewidth": 0.8,
    "legend.frameon": False, "lines.linewidth": 1.5, "lines.markersize": 4, "savefig.dpi": 300, "text.color": ink,
    "xtick.color": ink, "ytick.color": ink, "figure.constrained_layout.use": True, "figure.dpi": 120}
width = 84 / 25.4  # of a column, inches

_dashes = ("-", (0, (4, 1.5)), (0, (1, 1.2)), (0, (6, 1.5, 1, 1.5)), (0, (2, 1)))
_markers = "osD^vPX"
_colors = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000")
_causes = {"acne": "#d55e00", "false_occlusion": "#cc79a7", "peter_panning": "#0072b2", "leak": "#56b4e9"}
_cause_names = {"acne": "acne", "false_occlusion": "false occlusion", "peter_panning": "peter-panning", "leak": "light leak"}

Arguments = ParamSpec("Arguments")


def _styled(draw: Callable[Arguments, Axes]) -> Callable[Arguments, Axes]:
    """Draw in our style, which ends with the call: ticks are made now, not when the figure is saved."""
    @functools.wraps(draw)
    def styled(*positional: Arguments.args, **named: Arguments.kwargs) -> Axes:
        import matplotlib

        with matplotlib.rc_context(style):
            axes = draw(*positional, **named)
            axes.figure.canvas.draw()
        return axes
    return styled


@_styled
def bias_curves(run: Run, statistic: str = "mae", over: str = "", axes: Axes | None = None, **fixed: Any) -> Axes:
    """A statistic of a sweep against one axis, `over`, a line for each combination of the others; circles mark the minima.

    `over` is the constant bias, or the first axis where that is not varied. `fixed` selects values of other axes by keyword:
    `shadow_filter="box"`.
    """
    over = _axis(run, over, "shadow.constant-bias")
    axes = axes or _figure(0.72 * width)
    lines = list(_lines(run, over, fixed))
    for number, (label, chosen) in enumerate(lines):
        x, y = run.columns[over][chosen], _shown(run, statistic)[chosen]
        color = _colors[number % len(_colors)]
        axes.plot(x, y, color=color, linestyle=_dashes[number % len(_dashes)], label=label)
        if np.isfinite(y).any():
            least = int(np.nanargmin(y))
            axes.plot(x[least], y[least], "o", markerfacecolor="white", markeredgecolor=color, markersize=6)
    _scale(axes, "x", run.axes[over])
    _scale(axes, "y", _shown(run, statistic))
    axes.set(xlabel=_label(run, over), ylabel=_label(run, statistic))
    _legend(axes, ", ".join(_label(run, name) for name in _others(run, over, fixed)), len(lines))
    return axes


@_styled
def causes(run: Run, over: str = "", axes: Axes | None = None, **fixed: Any) -> Axes:
    """Shares of the four causes of shadow error against one axis of a sweep; the other axes need values in `fixed`."""
    over = _axis(run, over, "shadow.constant-bias")
    axes = axes or _figure(0.72 * width)
    lines = list(_lines(run, over, fixed))
    if len(lines) != 1:
        raise ValueError(f"give values of {', '.join(_others(run, over, fixed))}: there are {len(lines)} combinations")
    chosen = lines[0][1]
    for number, (name, color) in enumerate(_causes.items()):
        axes.plot(run.columns[over][chosen], _shown(run, name)[chosen], color=color, linestyle=_dashes[number],
                  marker=_markers[number], markevery=-(-len(chosen) // 9), label=_cause_names[name], clip_on=False)
    axes.set_yscale("function", functions=(lambda y: np.sqrt(np.maximum(y, 0)), np.square))
    _scale(axes, "x", run.axes[over])
    axes.set(xlabel=_label(run, over), ylabel="share [%]\nsquare-root scale", ylim=(0, None))
    _legend(axes, "cause", 4)
    return axes


@_styled
def heat_map(run: Run, statistic: str = "mae", over: tuple[str, str] | None = None, axes: Axes | None = None,
             **fixed: Any) -> Axes:
    """A statistic of a sweep over two axes, (horizontal, vertical); the first two by default. A circle marks the minimum."""
    names = [_axis(run, name) for name in over or list(run.axes)[:2]]
    if len(names) != 2:
        raise ValueError("a heat map needs a sweep over two axes")
    index: Any = tuple(slice(None) if name in names else _position(run, name, fixed) for name in run.axes)
    values = _shown(run, statistic).reshape([len(each) for each in run.axes.values()])[index]
    if list(run.axes).index(names[0]) < list(run.axes).index(names[1]):
        values = values.T
    axes = axes or _figure(0.72 * width)
    shades = axes.pcolormesh(values, cmap="cividis_r", edgecolor="white", linewidth=0.3 if max(values.shape) < 33 else 0)
    axes.figure.colorbar(shades, ax=axes, label=_label(run, statistic))
    if np.isfinite(values).any():
        row, column = np.unravel_index(np.nanargmin(values), values.shape)
        axes.plot(column + 0.5, row + 0.5, "o", markerfacecolor="white", markeredgecolor=ink, markersize=6)
    for which, name in zip("xy", names, strict=True):
        ticks = run.axes[name]
        step = -(-len(ticks) // 8)
        getattr(axes, f"set_{which}ticks")(np.arange(0, len(ticks), step) + 0.5, [_number(each) for each in ticks[::step]])
    axes.grid(False)
    axes.set(xlabel=_label(run, names[0]), ylabel=_label(run, names[1]))
    return axes


@_styled
def pareto_front(run: Run, first: str = "acne", second: str = "peter_panning", axes: Axes | None = None, **fixed: Any) -> Axes:
    """Cells of a sweep that no other cell beats in both statistics, over all cells in grey."""
    axes = axes or _figure(0.72 * width)
    chosen = np.all([run.columns[name] == run.axes[name][_position(run, name, fixed)] for name in run.axes
                     if _keyword(name) in fixed] or [np.ones(len(run.columns[first]), bool)], axis=0)
    x, y = _shown(run, first)[chosen], _shown(run, second)[chosen]
    order = np.lexsort((y, x))
    least = np.minimum.accumulate(np.concatenate([[np.inf], y[order]]))
    front = order[(y[order] < least[:-1]) & np.isfinite(x[order])]
    axes.plot(x, y, "o", color="#b0b0b0", markersize=3, label="all cells", clip_on=False)
    axes.plot(x[front], y[front], "o-", color=_colors[0], label="Pareto front", clip_on=False)
    root = {"functions": (lambda value: np.sqrt(np.maximum(value, 0)), np.square)}
    axes.set_xscale("function", **root)
    axes.set_yscale("function", **root)
    axes.set(xlim=(0, None), ylim=(0, None))
    axes.set(xlabel=_label(run, first) + "\nsquare-root scale", ylabel=_label(run, second) + "\nsquare-root scale")
    axes.legend()
    return axes


@_styled
def error_map(run: Run, layer: str = "", axes: Axes | None = None) -> Axes:
    """An error layer, technique - reference from -1 to 1: blue is too dark, red too bright. The first one by default."""
    layer = layer or _first(run, "error_visibility_", "error_")
    from matplotlib.colors import LinearSegmentedColormap

    axes = axes or _figure(0.68 * width)
    # The blue is lighter than the red, so that they differ in grey.
    scale = LinearSegmentedColormap.from_list("error", ["#2f7de1", "#f4f4f4", "#8f1010"])
    image = axes.imshow(run.layers[layer], cmap=scale, vmin=-1, vmax=1, interpolation="nearest")
    axes.figure.colorbar(image, ax=axes, orientation="horizontal", aspect=40, pad=0.03,
                         label="technique − reference: below 0 is too dark")
    _frame(axes)
    return axes


@_styled
def cause_map(run: Run, layer: str = "", axes: Axes | None = None) -> Axes:
    """The cause of each wrong pixel of a hard shadow, a layer `class_LIGHT`. The first one by default."""
    layer = layer or _first(run, "class_")
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    axes = axes or _figure(0.75 * width)
    colors = ["#f0f0f0", *_causes.values(), "#c8c8c8", "#ffffff"]
    names = ["correct", *_cause_names.values(), "not counted", "background"]
    axes.imshow(run.layers[layer], cmap=ListedColormap(colors), vmin=-0.5, vmax=6.5, interpolation="nearest")
    axes.legend(handles=[Patch(facecolor=color, edgecolor="#777777", linewidth=0.5, label=name)
                         for color, name in zip(colors, names, strict=True)],
                loc="upper center", bbox_to_anchor=(0.5, 0), ncol=3, handlelength=1, columnspacing=1, borderaxespad=0.2)
    _frame(axes)
    return axes


def _figure(height: float) -> Axes:
    import matplotlib.pyplot as pyplot

    return pyplot.subplots(figsize=(width, height))[1]


def _keyword(name: str) -> str:
    return name.replace(".", "_").replace("-", "_")


def _axis(run: Run, name: str, usual: str = "") -> str:
    """Full name of an axis, from its keyword or full name."""
    names = list(run.axes)
    if not name:
        return usual if usual in names else names[0]
    found = [each for each in names if name in (each, _keyword(each))]
    if not found:
        raise ValueError(f"'{name}' is no axis of the sweep: {', '.join(names)}")
    return found[0]


def _others(run: Run, over: str, fixed: Mapping[str, Any]) -> list[str]:
    known = {_keyword(name) for name in run.axes}
    if unknown := set(fixed) - known:
        raise ValueError(f"'{unknown.pop()}' is no axis of the sweep: {', '.join(sorted(known))}")
    return [name for name in run.axes if name != over and _keyword(name) not in fixed]


def _position(run: Run, name: str, fixed: Mapping[str, Any]) -> int:
    values: list[Any] = run.axes[name].tolist()
    if _keyword(name) not in fixed:
        if len(values) > 1:
            raise ValueError(f"give a value of {_keyword(name)}: {', '.join(map(str, values))}")
        return 0
    if fixed[_keyword(name)] not in values:
        raise ValueError(f"{_keyword(name)} has no value {fixed[_keyword(name)]!r}: {', '.join(map(str, values))}")
    return values.index(fixed[_keyword(name)])


def _lines(run: Run, over: str, fixed: Mapping[str, Any]) -> list[tuple[str, Column]]:
    """Label and rows of each combination of the axes that are neither drawn over nor fixed."""
    others = _others(run, over, fixed)
    rows = np.arange(len(run.columns[over])).reshape([len(values) for values in run.axes.values()])
    names = list(run.axes)
    index: Any = tuple(_position(run, name, fixed) if _keyword(name) in fixed else slice(None) for name in names)
    rows = rows[index]
    left = [name for name in names if _keyword(name) not in fixed]
    rows = np.moveaxis(rows, left.index(over), -1).reshape(-1, len(run.axes[over]))
    return [(", ".join(_number(run.columns[name][line[0]]) for name in others), line) for line in rows]


def _shown(run: Run, name: str) -> Column:
    """In per cent where it is a share."""
    if name not in run.columns:
        raise ValueError(f"the sweep has no column '{name}': {', '.join(run.columns)}")
    return run.columns[name] * (100.0 if run.quantities[name].unit == "1" else 1.0)


def _label(run: Run, name: str) -> str:
    quantity = run.quantities[name]
    words = {"mae": "mean absolute error", "rmse": "RMS error", **_cause_names}
    text = name.split(".")[-1].replace("-", " ") if "." in name else words.get(name, name.replace("_", " "))
    unit = {"1": "%" if "." not in name else "", "degrees": "°"}.get(quantity.unit, quantity.unit)
    return f"{text} [{unit}]" if unit else text


def _number(value: Any) -> str:
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def _scale(axes: Axes, which: str, values: Column) -> None:
    """Logarithmic, with plain numbers, where all values are above 0 and span more than a factor of 8."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    finite = values[np.isfinite(values)] if values.dtype.kind in "fi" else np.zeros(0)
    if finite.size and finite.min() > 0 and finite.max() > 8 * finite.min():
        getattr(axes, f"set_{which}scale")("log")
        axis = getattr(axes, f"{which}axis")
        axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(NullFormatter())


def _legend(axes: Axes, title: str, lines: int) -> None:
    """Below the axes, where there is more than one line."""
    if lines > 1:
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.23), ncol=2 if lines == 4 else min(lines, 3), title=title)


def _first(run: Run, *prefixes: str) -> str:
    found = [name for prefix in prefixes for name in run.layers if name.startswith(prefix)]
    if not found:
        raise ValueError(f"{run.folder} has no layer {prefixes[-1]}…: {', '.join(run.layers)}")
    return found[0]


def _frame(axes: Axes) -> None:
    axes.grid(False)
    axes.set(xticks=[], yticks=[])
    for spine in axes.spines.values():
        spine.set(visible=True, color="#777777")
