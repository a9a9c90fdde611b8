"""Parameters: keywords, values, and the generated files."""
import json
import unittest

import numpy as np
from support import root

import umbrameter as um
from umbrameter.parameters import flags, text_of
from umbrameter.program import run


class Parameters(unittest.TestCase):
    def test_they_are_those_of_the_program(self):
        listed = json.loads(run(["parameters", "--json"], progress=False))
        self.assertEqual(um.program_version, listed["version"])
        self.assertEqual([each["name"] for each in listed["parameters"]], list(um.parameters))
        self.assertEqual(um.parameters["shadow.resolution"].maximum, 16384)

    def test_the_package_and_the_program_have_one_version(self):
        self.assertIn(f'version = "{um.program_version}"', (root / "python" / "pyproject.toml").read_text())

    def test_each_keyword_means_one_parameter(self):
        self.assertEqual(len({each.keyword for each in um.parameters.values()}), len(um.parameters))
        self.assertTrue(all(each.keyword.isidentifier() for each in um.parameters.values()))

    def test_values_are_written_as_the_program_reads_them(self):
        self.assertEqual([text_of(each) for each in (True, 0.05, 3, "2cm", np.float32(0.5), np.int64(7), np.bool_(False))],
                         ["true", "0.05", "3", "2cm", "0.5", "7", "false"])
        self.assertEqual(text_of(np.array([256, 512])), "256,512")
        self.assertEqual(flags({"view_size": (320, 180), "shadow.constant-bias": "1.5texels", "engine.map-size": 2048}),
                         ["--view.size", "320x180", "--shadow.constant-bias", "1.5texels", "--engine.map-size", "2048"])

    def test_an_unknown_keyword_is_refused_with_the_nearest_ones(self):
        with self.assertRaisesRegex(TypeError, "no parameter 'shadow_constant_bais': did you mean shadow_constant_bias"):
            um.compare("courtyard", shadow_constant_bais=1)


if __name__ == "__main__":
    unittest.main()
