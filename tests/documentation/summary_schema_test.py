"""Runs the program and holds the summaries against docs/summary.schema.json.

usage: summary_schema_test.py PROGRAM SCHEMA [unittest arguments]
"""

import copy
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import jsonschema

SMALL = ["--size", "64x36", "--shadow.resolution", "128", "--truth.spp", "16", "--no-figures", "--quiet", "--force"]
BIASES = "shadow.constant-bias=0.02:0.4:33:log"
RUNS = {
    "compare": ["compare", "courtyard", "--shimmer", "--run.ao-stages", "true", "--run.metrics", "all of the schema",
                "--for", "three"],
    "pcss": ["compare", "contact-box", "--light.angle", "2", "--shadow.technique", "pcss"],
    "point, area light": ["compare", "courtyard", "--light", "lantern", "--light.radius", "0.1"],
    "rectangle": ["trace", "courtyard", "--light", "lantern", "--light.width", "0.2", "--light.height", "0.1"],
    "vsm": ["compare", "courtyard", "--light", "sun", "--shadow.technique", "vsm"],
    "screen space": ["compare", "courtyard", "--light", "sun", "--shadow.technique", "screen-space"],
    "cascades": ["compare", "long-posts", "--view.camera", "near", "--view.light", "sun", "--shadow.cascades", "4", "--shimmer",
                 "--for", "godot,unity-hdrp"],
    "image": ["compare", "courtyard", "--measure", "image", "--shading.path", "deferred"],
    "nothing counted": ["compare", "courtyard", "--light", "sun", "--shadow.fit", "bounds", "--shadow.fit-x", "1000"],
    "engine": ["compare", "contact-box", "--engine", "umbrameter"],
    "sweep of an engine": ["sweep", "contact-box", "--engine", "umbrameter", "--vary", "engine.shadow-constant-bias=0,1"],
    "trace": ["trace", "courtyard"],
    "raster": ["raster", "courtyard"],
    "raster, image": ["raster", "courtyard", "--measure", "image"],
    "sweep of biases": ["sweep", "courtyard", "--light", "sun", "--vary", BIASES, "--vary", "shadow.slope-bias=0,0.5,1",
                        "--vary", "shadow.resolution=64,128,256", "--for", "three"],
    "sweep with a formula": ["sweep", "tilted-plane", "--light", "sun-60", "--shadow.filter", "box", "--vary",
                             "shadow.constant-bias=0.02texels:9texels:450", "--vary", "shadow.resolution=2048,4096",
                             "--vary", "shadow.filter-size=1,3", "--vary", "shadow.depth-format=24,16"],
    "sweep of techniques": ["sweep", "courtyard", "--light", "sun", "--vary", "shadow.technique=pcf,vsm"],
    "sweep of a soft shadow": ["sweep", "courtyard", "--light", "sun", "--light.angle", "2", "--vary", "shadow.slope-bias=0,1"],
    "sweep of AO": ["sweep", "courtyard", "--vary", "ao.radius=1%:4%:3"],
    "sweep of images": ["sweep", "courtyard", "--measure", "image", "--vary", "shadow.constant-bias=0.01,0.02", "--run.metrics", "ssim"],
    "tune": ["tune", "courtyard", "--light", "sun", "--minimize", "acne+peter_panning", "--vary",
             "shadow.constant-bias=0.5texels:8texels:9", "--vary", "shadow.filter=nearest,box", "--for", "three"],
    "tune a bias": ["tune", "courtyard", "--light", "sun", "--vary", "shadow.constant-bias=0texels:8texels"],
}
# Keys that need a scene or a failure that is not worth a run here.
RARE = {"missed_px", "front_is_thinned", "not_measured"}


def nodes_of(schema):
    """Every subschema."""
    if isinstance(schema, dict):
        yield schema
        for each in schema.values():
            yield from nodes_of(each)
    elif isinstance(schema, list):
        for each in schema:
            yield from nodes_of(each)


def objects_of(value):
    """Every object in a document, the outermost first."""
    if isinstance(value, dict):
        yield value
        for each in value.values():
            yield from objects_of(each)
    elif isinstance(value, list):
        for each in value:
            yield from objects_of(each)


class SummarySchema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.schema = json.loads(pathlib.Path(schema_file).read_text())
        jsonschema.Draft202012Validator.check_schema(cls.schema)
        cls.validator = jsonschema.Draft202012Validator(cls.schema)
        cls.summaries = {}
        with tempfile.TemporaryDirectory() as folder:
            environment = {**os.environ, "XDG_CACHE_HOME": folder}
            # The other units of a metric come with it.
            names = cls.schema["$defs"]["metrics"]["properties"]
            metrics = ",".join(name for name in names if not name.endswith(("-texels", "-m")))
            for name, arguments in RUNS.items():
                arguments = [metrics if each == "all of the schema" else each for each in arguments]
                out = pathlib.Path(folder) / name.replace(" ", "-")
                run = subprocess.run([program, *arguments, *SMALL, "-o", str(out)], capture_output=True, text=True,
                                     env=environment)
                if run.returncode == 3:
                    print(run.stderr)
                    sys.exit(77)  # no OpenGL
                assert run.returncode == 0, f"{arguments}: {run.stderr}"
                cls.summaries[name] = json.loads((out / "summary.json").read_text())

    def errors(self, summary):
        return [f"{each.json_path}: {each.message[:300]}" for each in self.validator.iter_errors(summary)]

    def test_every_run_keeps_the_schema(self):
        for name, summary in self.summaries.items():
            with self.subTest(name):
                self.assertEqual(self.errors(summary), [])

    def test_an_unknown_key_breaks_the_schema_wherever_it_is(self):
        for name, summary in self.summaries.items():
            count = sum(1 for _ in objects_of(summary))
            for i in range(0, count, max(1, count // 12)):
                broken = copy.deepcopy(summary)
                list(objects_of(broken))[i]["no_such_key"] = 1.0
                with self.subTest(name, object=i):
                    self.assertFalse(self.validator.is_valid(broken))

    def test_a_missing_key_breaks_the_schema(self):
        for keys in (["program"], ["shadows", 0, "map"], ["shadows", 0, "statistics", "mae"],
                     ["ao", "truth", "mean_samples"], ["parameters", "shadow.filter"]):
            broken = copy.deepcopy(self.summaries["compare"])
            parent = broken
            for key in keys[:-1]:
                parent = parent[key]
            del parent[keys[-1]]
            with self.subTest(keys):
                self.assertFalse(self.validator.is_valid(broken))

    def test_every_key_has_a_description_and_every_number_a_unit(self):
        for node in nodes_of(self.schema):
            for key, child in node.get("properties", {}).items() if isinstance(node.get("properties"), dict) else []:
                with self.subTest(key):
                    self.assertTrue(child.get("description"))
                    kinds = child.get("type", [])
                    if "number" in kinds or kinds == "integer":
                        if key not in self.schema["$defs"]["parameters"]["properties"]:
                            self.assertTrue(child.get("unit"))

    def test_every_described_key_occurs_in_a_run(self):
        seen = {key for summary in self.summaries.values() for each in objects_of(summary) for key in each}
        described = {key for node in nodes_of(self.schema) if isinstance(node.get("properties"), dict)
                     for key in node["properties"]}
        tuned = set(self.schema["$defs"]["tune_statistics"]["properties"])
        self.assertEqual(described - seen - tuned - RARE, set())


if __name__ == "__main__":
    program, schema_file = sys.argv[1:3]
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
