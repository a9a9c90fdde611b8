"""The program's commands as functions: compare, trace, raster, sweep, tune, evaluate, diff, report, info.

Parameters are keyword arguments (`shadow_constant_bias=0.02`), as `parameters` lists them, or have their full names in
`settings={"shadow.constant-bias": 0.02}`. A length is a number of metres or a text with its unit, "1.5texels".
"""
from __future__ import annotations

import contextlib
import hashlib
import json
import os
import pathlib
import shutil
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
import numpy.typing as npt

from .exr import write_pfm
from .parameters import Value, flags, name_of, text_of
from .program import run
from .results import Path, Run, Runs, folders_of

if TYPE_CHECKING:
    from .keywords import Keywords

    class ObjectiveOptions(Keywords, total=False):
        """What everything that measures takes, beside the parameters."""

        settings: Mapping[str, Value]
        """parameters by full name; the place for `engine.*`"""
        config: str | os.PathLike[str]
        """experiment file (TOML); the other arguments override it"""
        engine: str
        """engine to measure in place of our techniques"""
        cache: bool
        """read and write the cache of references; default True"""
        threads: int
        """threads; 0 for all cores"""
        gl_device: str
        """OpenGL device: index, part of its name, or "software\""""
        arguments: Sequence[str]
        """further words of the command line"""
        progress: bool | None
        """show progress; None: in a terminal and in a notebook"""

    class Options(ObjectiveOptions, total=False):
        """What every command that writes a folder takes, beside the parameters."""

        force: bool
        """replace an earlier run in the folder"""
        figures: bool
        """draw figures; default True"""
else:
    Options = ObjectiveOptions = dict[str, Any]

#: A file, or an array that is written as one: height x width (x 3), row 0 is the first row of the file.
Image = str | os.PathLike[str] | npt.NDArray[Any]
#: Values of an axis: its text ("0:0.2:129", "first:last:count:log") or a list of values.
Axis = str | Sequence[Value] | npt.NDArray[Any]


def compare(scene: Path, output: Path | None = None, **options: Unpack[Options]) -> Run:
    """Measure one configuration: `umbrameter compare`.

    `scene` is a .gltf or .glb file or the name of a built-in scene. Without an `output` folder the results lie in a
    temporary one, which is removed with the Run. Raises Error with the program's line, TypeError for an unknown parameter.
    """
    return _measure("compare", [scene], output, [], options)


def trace(scene: Path, output: Path | None = None, **options: Unpack[Options]) -> Run:
    """Trace the reference alone: `umbrameter trace`. Needs no OpenGL; arguments and errors are those of compare.

    `layers` has the reference, `truth_visibility_LIGHT` and `truth_ao`, height x width, 0 to 1. There are no statistics.
    """
    return _measure("trace", [scene], output, [], options)


def raster(scene: Path, output: Path | None = None, **options: Unpack[Options]) -> Run:
    """Draw the rasterised technique alone: `umbrameter raster`. It traces no rays; arguments and errors are those of compare.

    `layers` has what was drawn, `raster_visibility_LIGHT` and `raster_ao`, height x width, 0 to 1. There are no statistics.
    """
    return _measure("raster", [scene], output, [], options)


def sweep(scene: Path, output: Path | None = None, *, vary: Mapping[str, Axis], **options: Unpack[Options]) -> Run:
    """Measure all combinations of varied parameters: `umbrameter sweep`.

    `vary` has an axis for each parameter, by keyword or full name; the last one varies fastest. Call it again with the same
    folder to resume an interrupted sweep.
    """
    return _measure("sweep", [scene], output, _assignments("--vary", vary), options)


def tune(scenes: Path | Sequence[Path], output: Path | None = None, *, vary: Mapping[str, Axis], minimize: str = "",
         constraints: Sequence[str] = (), over: Mapping[str, Axis] | None = None, held_out: Mapping[str, Axis] | None = None,
         worst_case: bool = False, relative: bool = False, evaluations: int | None = None, minutes: float | None = None,
         **options: Unpack[Options]) -> Run:
    """Find the best parameters over scenes, cameras and lights: `umbrameter tune`.

    `vary` has the searched ranges ("0:0.2", "256:4096:log") or lists; `minimize` is a statistic or a sum of statistics,
    `mae` if it is empty; `constraints` are conditions such as "acne<0.1%"; `over` and `held_out` list the values of
    the cases that are measured and that the result is checked on. `summary["tuning"]` has the result with its intervals.
    """
    words = _assignments("--vary", vary) + _assignments("--over", over or {}) + _assignments("--held-out", held_out or {})
    words += ["--minimize", minimize] if minimize else []
    words += [word for each in constraints for word in ("--constraint", each)]
    words += ["--worst-case"] if worst_case else []
    words += ["--relative"] if relative else []
    words += ["--evaluations", str(evaluations)] if evaluations is not None else []
    words += ["--minutes", repr(minutes)] if minutes is not None else []
    listed = [scenes] if isinstance(scenes, str | os.PathLike) else list(scenes)
    return _measure("tune", listed, output, words, options)


def evaluate(scene: Path, output: Path | None = None, *, visibility: Image | None = None, lit: Image | None = None,
             unshadowed: Image | None = None, ao: Image | None = None, occluded: Image | None = None,
             open: Image | None = None, position: Image | None = None, depth: Image | None = None, convention: str = "",
             **options: Unpack[Options]) -> Run:
    """Measure a frame of an engine: `umbrameter evaluate`.

    Each image is a file or an array. `visibility` (share of the light that arrives, 0 to 1), `ao` (1 where open) and `depth`
    (as `frame_depth_kind` or `convention` says) are height x width; `position` is height x width x 3, in the coordinates of
    the scene file, metres; `lit` with `unshadowed` and `occluded` with `open` are linear frames, height x width (x 3).
    The size of the first array is the default of `view_size`. `convention` is opengl, direct3d, vulkan, reversed-z or blender:
    the first row of an array is where it says, the bottom for OpenGL. Arrays are written to the folder `frame` of the output.
    """
    images = {"visibility": visibility, "lit": lit, "unshadowed": unshadowed, "ao": ao, "occluded": occluded, "open": open,
              "position": position, "depth": depth}
    words = ["--convention", convention] if convention else []
    arrays = [image for image in images.values() if isinstance(image, np.ndarray)]
    given = {name_of(word) for word in _settings(options)}
    if arrays and "view.size" not in given and "config" not in options:
        words += ["--view.size", f"{arrays[0].shape[1]}x{arrays[0].shape[0]}"]
    with _output_folder(output) as folder:
        written = []
        for name, image in images.items():
            if isinstance(image, np.ndarray):
                path, is_new = _write_array(folder / "frame", name, image)
                written += [path] if is_new else []
                words += [f"--{name}", str(path)]
            elif image is not None:
                words += [f"--{name}", os.fspath(image)]
        try:
            return _measure("evaluate", [scene], folder, words, options, is_temporary=output is None)
        except BaseException:
            for path in written:
                path.unlink()
            for empty in (folder / "frame", folder):
                with contextlib.suppress(OSError):
                    empty.rmdir()
            raise


@dataclass(frozen=True)
class Difference:
    """Difference of two images."""

    scores: dict[str, float | None]  #: score of each metric; None where it is undefined
    summary: dict[str, Any]  #: all that `umbrameter diff --json` prints: units, ranges, percentiles


def diff(test: Image, reference: Image, *, metrics: Sequence[str] = (), layer: str = "", reference_layer: str = "",
         mask: Image | None = None, data: bool = False, error_map: Path | None = None, map: str = "",
         arguments: Sequence[str] = (), progress: bool | None = None) -> Difference:
    """Measure the difference of two images by metrics of images: `umbrameter diff`.

    Images are EXR, PNG, HDR or PFM files, or arrays of height x width (x 3) of linear values; `data` compares values from 0
    to 1 (visibility, AO) as they are. Counted are the pixels where `mask` is not black. `error_map` is a .png to write.
    """
    with tempfile.TemporaryDirectory(prefix="umbrameter-") as folder:
        def file(name: str, image: Image) -> str:
            if isinstance(image, np.ndarray):
                return str(_write_array(pathlib.Path(folder), name, image)[0])
            return os.fspath(image)

        words = ["diff", file("test", test), file("reference", reference), "--json", *arguments]
        words += ["--metrics", ",".join(metrics)] if metrics else []
        words += ["--mask", file("mask", mask)] if mask is not None else []
        words += ["--data"] if data else []
        for flag, value in (("--layer", layer), ("--reference-layer", reference_layer), ("--map", map),
                            ("-o", os.fspath(error_map) if error_map else "")):
            words += [flag, value] if value else []
        summary = json.loads(run(words, progress))
    return Difference({name: each["score"] for name, each in summary["metrics"].items()}, summary)


def report(runs: Runs, output: Path | None = None, *, latex: bool = False, force: bool = False, figures: bool = True,
           arguments: Sequence[str] = (), progress: bool | None = None) -> Run:
    """Make one page of finished runs, the first is what the others are compared with: `umbrameter report`.

    `runs` is one or several, each a Run or its folder; of one, the page is its own again. The table has a row for each
    statistic and run: value, half width of its interval, difference to the first run with its interval, and verdict.
    `latex` writes the tables as .tex files, too. `arguments` are further words, such as ["--figure-style", "column"].
    Raises Error with the program's line, for runs of different scenes for example.
    """
    words = [word for word, given in (("--latex", latex), ("--force", force), ("--no-figures", not figures)) if given]
    with _output_folder(output) as folder:
        answer = run(["report", *folders_of(runs), "-o", str(folder), *words, *arguments], progress)
        return Run(folder, answer.strip(), output is None)


def info(scene: Path | None = None, *, arguments: Sequence[str] = (), progress: bool | None = None) -> dict[str, Any]:
    """Describe a scene, or without one the program and its OpenGL devices: `umbrameter info --json`.

    Of a scene: triangles, bounds, cameras, lights, materials, memory and whether its unit is credible, with the keys of
    docs/info.md; lengths in metres, angles in degrees, sizes in bytes. Without one: version, embree, gl_devices.
    Raises Error with the program's line for a scene that cannot be read.
    """
    given = [] if scene is None else [os.fspath(scene)]
    found = json.loads(run(["info", *given, "--json", *arguments], progress))
    described: dict[str, Any] = found if scene is None else found["scene"]
    return described


_not_parameters = {"settings", "config", "force", "engine", "figures", "cache", "threads", "gl_device", "arguments", "progress"}


def _measure(command: str, scenes: Sequence[Path], output: Path | None, words: Sequence[str], options: Mapping[str, Any],
             is_temporary: bool = False) -> Run:
    settings = command_words(options)
    with _output_folder(output) as folder:
        line = [command, *(os.fspath(scene) for scene in scenes), "-o", str(folder), *words, *settings]
        line += ["--force"] if options.get("force") else []
        line += [] if options.get("figures", True) else ["--no-figures"]
        answer = run(line, options.get("progress"))
        return Run(folder, answer.strip(), is_temporary or output is None)


def command_words(options: Mapping[str, Any]) -> list[str]:
    """Words of the command line for the parameters and other keywords of ObjectiveOptions."""
    words = flags(_settings(options))
    for key in ("config", "engine", "threads", "gl_device"):
        if key in options:
            words += [f"--{key.replace('_', '-')}", str(options[key])]
    words += [] if options.get("cache", True) else ["--no-cache"]
    return [*words, *options.get("arguments", ())]


def _settings(options: Mapping[str, Any]) -> dict[str, Any]:
    """Parameters by keyword or full name."""
    keywords = {key: value for key, value in options.items() if key not in _not_parameters}
    return {**options.get("settings", {}), **keywords}


@contextlib.contextmanager
def _output_folder(output: Path | None) -> Iterator[pathlib.Path]:
    """The folder, or a temporary one, which is removed where the command fails."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="umbrameter-") if output is None else output)
    try:
        yield folder
    except BaseException:
        if output is None:
            shutil.rmtree(folder, True)
        raise


def _assignments(flag: str, axes: Mapping[str, Axis]) -> list[str]:
    return [word for name, axis in axes.items()
            for word in (flag, f"{name if name == 'scene' else name_of(name)}={text_of(axis)}")]


def _write_array(folder: pathlib.Path, name: str, image: npt.NDArray[Any]) -> tuple[pathlib.Path, bool]:
    """Named by its content, so that an array of an earlier run in the folder stays as it is; and whether it is new."""
    content = np.ascontiguousarray(image, dtype="<f4")
    path = folder / f"{name}-{hashlib.sha256(repr(content.shape).encode() + content.tobytes()).hexdigest()[:12]}.pfm"
    is_new = not path.exists()
    if is_new:
        folder.mkdir(parents=True, exist_ok=True)
        write_pfm(path, image)
    return path, is_new
