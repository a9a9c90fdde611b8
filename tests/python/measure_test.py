"""compare, sweep, tune, evaluate and diff against the program."""
import unittest

import numpy as np
from support import compared, require_driver, small, work

import umbrameter as um


class Measure(unittest.TestCase):
    def test_keywords_and_full_names_set_parameters(self):
        run = um.compare("contact-box", work / "set", **small, shadow_resolution=512, settings={"shadow.filter": "box"})
        expected = {"shadow.resolution": 512, "shadow.filter": "box", "view.size": "96x54"}
        self.assertEqual({name: run.summary["parameters"][name] for name in expected}, expected)
        self.assertEqual(run.figures, {})

    def test_without_a_folder_the_results_live_as_long_as_the_run(self):
        run = um.compare("contact-box", **small)
        folder = run.folder
        self.assertEqual(run.layers["error_visibility_sun"].shape, (54, 96))
        del run
        self.assertFalse(folder.exists())

    def test_a_refused_value_is_an_error_with_the_line_of_the_program(self):
        with self.assertRaisesRegex(um.Error, "shadow.resolution.*1 to 16384") as raised:
            um.compare("contact-box", work / "refused", shadow_resolution=0)
        self.assertEqual(raised.exception.exit_code, 2)

    def test_a_folder_is_replaced_only_by_force(self):
        um.compare("contact-box", work / "twice", **small)
        with self.assertRaisesRegex(um.Error, "--force"):
            um.compare("contact-box", work / "twice", **small, shadow_resolution=256)
        um.compare("contact-box", work / "twice", **small, shadow_resolution=256, force=True)


class Evaluate(unittest.TestCase):
    def test_the_arrays_of_our_own_rasteriser_have_its_error(self):
        layers = compared().layers
        run = um.evaluate("contact-box", work / "evaluate", visibility=layers["raster_visibility_sun"],
                          position=layers["gbuffer_position"], view_light="sun", figures=False)
        self.assertEqual(run.summary["parameters"]["view.size"], "96x54")
        ours, theirs = compared().summary["shadows"][0]["statistics"], run.summary["shadows"][0]["statistics"]
        # A pixel on a silhouette may be left out, and the reference is traced at positions of 32-bit floats.
        self.assertAlmostEqual(theirs["pixels"], ours["pixels"], delta=2)
        self.assertAlmostEqual(theirs["mae"], ours["mae"], delta=3 / ours["pixels"])
        self.assertEqual(sorted(path.name.split("-")[0] for path in (run.folder / "frame").iterdir()), ["position", "visibility"])

    def test_depths_and_rows_go_the_way_that_the_convention_says(self):
        layers = compared().layers
        run = um.evaluate("contact-box", visibility=layers["raster_visibility_sun"][::-1], depth=layers["Z"][::-1],
                          frame_depth_kind="axis", frame_rows="bottom", view_light="sun", figures=False)
        self.assertAlmostEqual(run.summary["shadows"][0]["statistics"]["mae"],
                               compared().summary["shadows"][0]["statistics"]["mae"], delta=2 / 2000)

    def test_a_refused_frame_leaves_no_files(self):
        layers = compared().layers
        with self.assertRaises(um.Error):
            um.evaluate("contact-box", work / "wrong", visibility=layers["raster_visibility_sun"],
                        position=layers["gbuffer_position"][::-1], view_light="sun", figures=False)
        self.assertFalse((work / "wrong").exists())


class Diff(unittest.TestCase):
    def test_the_error_of_two_arrays_is_the_mean_of_their_difference(self):
        generator = np.random.default_rng(1)
        a, b = generator.random((2, 20, 30), dtype=np.float32)
        difference = um.diff(a, b, data=True, metrics=["mae", "rmse"])
        self.assertEqual(set(difference.scores), {"mae", "rmse"})
        self.assertAlmostEqual(difference.scores["mae"], abs(a.astype(float) - b).mean(), 6)
        mask = np.zeros_like(a)
        mask[:10] = 1
        self.assertAlmostEqual(um.diff(a, b, data=True, mask=mask).scores["mae"], abs(a.astype(float) - b)[:10].mean(), 6)

    def test_an_error_map_is_written(self):
        um.diff(np.zeros((16, 16)), np.ones((16, 16)), data=True, error_map=work / "map.png")
        self.assertEqual((work / "map.png").read_bytes()[1:4], b"PNG")


if __name__ == "__main__":
    require_driver()
    unittest.main()
