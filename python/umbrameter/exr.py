"""Reads the program's EXR files and writes PFM files that the program reads.

Only what the program writes: one part, scan lines, float or half channels without subsampling, uncompressed or ZIP.
"""
from __future__ import annotations

import json
import pathlib
import struct
import zlib
from collections.abc import Iterator, Mapping
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float32]

_rows_of_compression = {0: 1, 2: 1, 3: 16}  # none, ZIPS, ZIP: rows of a chunk
_dtypes: dict[int, np.dtype[Any]] = {1: np.dtype("<f2"), 2: np.dtype("<f4")}
_vectors = ("RGBA", "RGB", "XYZ")


class Layers(Mapping[str, FloatArray]):
    """Layers of an EXR file by name, read when they are asked for.

    A scalar layer is an array of height x width, a vector or colour of height x width x 3 (RGBA: 4), float32, row 0 at
    the top. "RGBA" is the picture, "Z" its depth in metres; the others have the names of docs/output.md, such as
    `error_visibility_sun` (-1 to 1) or `gbuffer_position` (metres, NaN on the background).
    """

    def __init__(self, path: str | pathlib.Path) -> None:
        self.path = pathlib.Path(path)
        with self.path.open("rb") as file:
            try:
                self._read_header(file)
            except (struct.error, IndexError, UnicodeDecodeError, KeyError) as error:
                raise ValueError(f"{self.path}: no EXR file that umbrameter writes: {error}") from error
        self._layers = _grouped(list(self._channels))
        self._read: dict[str, FloatArray] = {}

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width in pixels."""
        return self._shape

    @property
    def attributes(self) -> Mapping[str, str]:
        """Text attributes of the header, such as `umbrameter.scene` and `umbrameter.version`."""
        return self._attributes

    @property
    def descriptions(self) -> dict[str, dict[str, Any]]:
        """Title, unit, role and range of each layer that the run measured, by its name."""
        listed = json.loads(self._attributes.get("umbrameter.layers", "[]"))
        return {each["name"] or "RGBA": each for each in listed}

    def __iter__(self) -> Iterator[str]:
        """Names of the layers."""
        return iter(self._layers)

    def __len__(self) -> int:
        """Number of layers."""
        return len(self._layers)

    def __repr__(self) -> str:
        """File, size and names."""
        height, width = self.shape
        return f"<Layers of {self.path.name}, {width}x{height}: {', '.join(self)}>"

    def __getitem__(self, name: str) -> FloatArray:
        """Array of a layer; it is kept, so that it is read once."""
        if name not in self._layers:
            raise KeyError(f"{self.path} has no layer '{name}'; it has {', '.join(self)}")
        if name not in self._read:
            self.load(name)
        return self._read[name]

    def load(self, *names: str) -> None:
        """Read several layers with one pass over the file; all of them if none is named."""
        wanted = [name for name in names or self if name not in self._read]
        channels = [channel for name in wanted for channel in self._layers[name]]
        try:
            planes = self._decode(channels)
        except (struct.error, zlib.error) as error:
            raise ValueError(f"{self.path}: damaged: {error}") from error
        for name in wanted:
            parts = [planes[channel] for channel in self._layers[name]]
            self._read[name] = parts[0] if len(parts) == 1 else np.stack(parts, axis=-1)

    def _read_header(self, file: BinaryIO) -> None:
        magic, version = struct.unpack("<II", file.read(8))
        if magic != 20000630 or version & ~0x400 != 2:
            raise ValueError(f"{self.path}: no EXR file of one part with scan lines")
        self._attributes: dict[str, str] = {}
        window: tuple[int, ...] = (0, 0, -1, -1)
        compression = -1
        while name := _text(file):
            kind = _text(file)
            data = file.read(struct.unpack("<I", file.read(4))[0])
            if name == "channels":
                self._channels = _channels(data)
            elif name == "compression":
                compression = data[0]
            elif name == "dataWindow":
                window = struct.unpack("<4i", data)
            elif kind == "string":
                self._attributes[name] = data.decode()
        if compression not in _rows_of_compression:
            raise ValueError(f"{self.path}: compression {compression} is not one that umbrameter writes")
        self._rows = _rows_of_compression[compression]
        self._first = window[1]
        self._shape = (window[3] - window[1] + 1, window[2] - window[0] + 1)
        chunks = -(-self._shape[0] // self._rows)
        self._offsets = struct.unpack(f"<{chunks}Q", file.read(8 * chunks))

    def _decode(self, wanted: list[str]) -> dict[str, FloatArray]:
        height, width = self.shape
        planes = {name: np.empty((height, width), np.float32) for name in wanted}
        starts, row_bytes = {}, 0
        for name, dtype in self._channels.items():
            starts[name] = row_bytes
            row_bytes += dtype.itemsize * width
        with self.path.open("rb") as file:
            for offset in self._offsets:
                file.seek(offset)
                y, size = struct.unpack("<iI", file.read(8))
                first = y - self._first
                rows = min(self._rows, height - first)
                data = file.read(size)
                if size < rows * row_bytes:
                    data = _undo_prediction(zlib.decompress(data))
                if first < 0 or len(data) != rows * row_bytes:
                    raise ValueError(f"{self.path}: damaged: the chunk of row {y} has {len(data)} bytes")
                block = np.frombuffer(data, np.uint8).reshape(rows, row_bytes)
                for name, plane in planes.items():
                    dtype = self._channels[name]
                    part = block[:, starts[name]:starts[name] + dtype.itemsize * width]
                    plane[first:first + rows] = np.ascontiguousarray(part).view(dtype)
        return planes


def write_pfm(path: str | pathlib.Path, values: npt.ArrayLike) -> None:
    """Write an array of height x width, or of height x width x 3, as 32-bit floats; row 0 is the first row of the file's
    image. A PFM stores the last row first."""
    array = np.asarray(values, dtype="<f4")
    if array.ndim not in (2, 3) or array.ndim == 3 and array.shape[2] != 3 or array.size == 0:
        raise ValueError(f"an image is height x width or height x width x 3, not {array.shape}")
    head = f"{'Pf' if array.ndim == 2 else 'PF'}\n{array.shape[1]} {array.shape[0]}\n-1.0\n"
    pathlib.Path(path).write_bytes(head.encode() + np.ascontiguousarray(array[::-1]).tobytes())


def _text(file: BinaryIO) -> str:
    text = bytearray()
    while (byte := file.read(1)) != b"\0":
        if not byte:
            raise IndexError("the header ends early")
        text += byte
    return text.decode()


def _channels(data: bytes) -> dict[str, np.dtype[Any]]:
    """In the order of the file, with their types: name, type, linearity, x and y sampling."""
    channels: dict[str, np.dtype[Any]] = {}
    while data[0]:
        name, _, data = data.partition(b"\0")
        kind, _linear, x_sampling, y_sampling = struct.unpack("<iIii", data[:16])
        if (x_sampling, y_sampling) != (1, 1):
            raise ValueError(f"channel '{name.decode()}' is subsampled")
        channels[name.decode()] = _dtypes[kind]
        data = data[16:]
    return channels


def _undo_prediction(data: bytes) -> bytes:
    """Sums the differences of neighbouring bytes and interleaves the halves (OpenEXR file layout, ZIP compression)."""
    steps = np.frombuffer(data, np.uint8).copy()
    steps[1:] -= np.uint8(128)
    values = np.cumsum(steps, dtype=np.uint8)
    half = (len(values) + 1) // 2
    result = np.empty_like(values)
    result[0::2] = values[:half]
    result[1::2] = values[half:]
    return result.tobytes()


def _grouped(channels: list[str]) -> dict[str, list[str]]:
    """Layers with their channels in the order R, G, B, A or X, Y, Z; a lone channel is a scalar."""
    parts: dict[str, list[str]] = {}
    for channel in channels:
        layer, dot, component = channel.rpartition(".")
        parts.setdefault(layer, []).append(component)
    layers = {}
    for layer, components in parts.items():
        dot = "." if layer else ""
        vector = next((each for each in _vectors if set(each) <= set(components)), "")
        if vector:
            layers[layer or vector] = [layer + dot + component for component in vector]
        for component in components:
            if component not in vector:
                layers[layer if dot and len(components) == 1 else layer + dot + component] = [layer + dot + component]
    return layers
