"""What the tests of python/ share. Ends with 77, a skip, where NumPy or pandas is missing."""
import atexit
import functools
import json
import os
import pathlib
import shutil
import sys
import tempfile

try:
    import numpy  # noqa: F401
    import pandas  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}; install python3-numpy and python3-pandas")
    sys.exit(77)

root = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(root / "python"))
work = pathlib.Path(tempfile.mkdtemp(prefix="umbrameter-python-"))
atexit.register(shutil.rmtree, work, True)

small = {"view_size": (96, 54), "view_light": "sun", "run_measure": "visibility", "figures": False}


def require_driver():
    """Ends with 77 where the program finds no OpenGL device."""
    from umbrameter.program import run

    if not json.loads(run(["info", "--json"], progress=False))["gl_devices"]:
        print("skipped: no OpenGL driver")
        sys.exit(77)


def fake_program(name, body, version=None):
    """A shell script that answers --version as the program does, and else runs the body."""
    import umbrameter

    path = work / name / "umbrameter"
    path.parent.mkdir()
    answer = f"umbrameter {version or umbrameter.program_version}"
    path.write_text(f'#!/bin/sh\nif [ "$1" = --version ]; then echo {answer}; exit; fi\n{body}\n')
    path.chmod(0o755)
    return path


class environment:
    """Variables for the time of a with block; None removes one."""

    def __init__(self, **values):
        self.values = values

    def __enter__(self):
        self.before = {name: os.environ.get(name) for name in self.values}
        self.set(self.values)

    def __exit__(self, *_):
        self.set(self.before)

    @staticmethod
    def set(values):
        for name, value in values.items():
            os.environ.pop(name, None)
            if value is not None:
                os.environ[name] = str(value)


@functools.cache
def swept():
    """A sweep of 5 biases, 2 resolutions and 2 filters."""
    import umbrameter as um

    return um.sweep("contact-box", work / "sweep", **{**small, "figures": True}, vary={
        "shadow_constant_bias": "0.25texels:8texels:5:log", "shadow.resolution": [256, 512], "shadow.filter": ["nearest", "box"]})


@functools.cache
def compared():
    """One configuration of the same scene, with ambient occlusion."""
    import umbrameter as um

    return um.compare("contact-box", work / "compare", view_size="96x54", view_light="sun", truth_spp=16)
