"""Reads the passes of an uncompressed EXR that Blender wrote, and writes PFM."""
import struct
from pathlib import Path

import numpy


def read_passes(path):
    """The channels by name without the view layer, such as Shadow.R; each an array whose first row is the top one."""
    data = Path(path).read_bytes()
    attributes, at = {}, 8
    while data[at]:
        end = data.index(b"\0", at)
        name, at = data[at:end], data.index(b"\0", end + 1) + 1  # skips the type
        size = struct.unpack_from("<i", data, at)[0]
        attributes[name.decode()] = data[at + 4 : at + 4 + size]
        at += 4 + size
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    if attributes["compression"] != b"\0":
        raise ValueError("Blender wrote a compressed EXR")
    names, listed = [], attributes["channels"]
    while listed[0]:
        name, listed = listed.split(b"\0", 1)
        if struct.unpack_from("<i", listed)[0] != 2:
            raise ValueError(f"channel {name.decode()} of Blender's EXR has no 32-bit floats")
        names.append(name.decode().split(".", 1)[-1])
        listed = listed[16:]
    # After the table of offsets, each row has its number and its size, then its channels.
    row = numpy.dtype([("y", "<i4"), ("size", "<i4"), ("values", "<f4", (len(names), width))])
    rows = numpy.frombuffer(data, row, height, at + 1 + 8 * height)
    rows = rows[numpy.argsort(rows["y"])]
    return {name: rows["values"][:, i] for i, name in enumerate(names)}


def write_pfm(path, image):
    """`image`: height × width, or height × width × 3; PFM begins with the bottom row."""
    kind = "PF" if image.ndim == 3 else "Pf"
    header = f"{kind}\n{image.shape[1]} {image.shape[0]}\n-1.0\n".encode()
    Path(path).write_bytes(header + numpy.ascontiguousarray(image[::-1], "<f4").tobytes())
