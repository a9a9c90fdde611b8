"""compare, trace, raster, evaluate, diff, report and info against the program."""
import unittest

import numpy as np
from support import compared, require_driver, small, swept, work

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


    def test_a_condition_that_fails_is_an_error_with_the_answer(self):
        with self.assertRaisesRegex(um.Error, "^the bound is broken$") as raised:
            um.compare("contact-box", **small, arguments=["--fail-if", "lit<=100%"])
        self.assertEqual(raised.exception.exit_code, 1)


class OneSide(unittest.TestCase):
    def test_each_has_its_layers_and_they_are_those_of_compare(self):
        drawn = um.raster("contact-box", **small)
        np.testing.assert_array_equal(drawn.layers["raster_visibility_sun"], compared().layers["raster_visibility_sun"])
        self.assertNotIn("truth_visibility_sun", drawn.layers)
        traced = um.trace("contact-box", **small)
        self.assertNotIn("raster_visibility_sun", traced.layers)
        # It finds the surfels by rays: only silhouettes may differ.
        differ = traced.layers["truth_visibility_sun"] != compared().layers["truth_visibility_sun"]
        self.assertLess(differ.mean(), 0.01)


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


class Report(unittest.TestCase):
    def test_runs_side_by_side_have_their_differences_to_the_first(self):
        run = um.report([compared(), swept().folder], work / "report", figures=False)
        table = run.table
        rows = table[(table["statistic"] == "mae") & (table["light"] == "sun")].set_index("run")
        first, second = (each.summary["shadows"][0]["statistics"]["mae"] for each in (compared(), swept()))
        self.assertEqual(rows["value"].to_dict(), {"compare": first, "sweep": second})
        self.assertAlmostEqual(rows["difference"]["sweep"], second - first, 12)
        self.assertEqual(rows["verdict"]["compare"], "base")
        self.assertTrue((run.folder / "index.html").is_file())
        self.assertEqual(um.load(run.folder).table["value"].dtype, float)
        self.assertIn("sun, sweep, cell of least error: error", run.answer)

    def test_the_page_of_one_run_is_its_own_again(self):
        run = um.report(compared(), arguments=["--figure-style", "column"])
        self.assertEqual(run.summary, compared().summary)
        self.assertIn("error_visibility_sun", run.figures)

    def test_a_refused_report_is_an_error_with_the_line_of_the_program(self):
        with self.assertRaisesRegex(um.Error, "given twice"):
            um.report([compared(), compared()])


class Info(unittest.TestCase):
    def test_a_scene_has_its_lights_and_the_program_its_devices(self):
        scene = um.info("contact-box")
        self.assertIn("sun", [light["name"] for light in scene["lights"]])
        self.assertEqual(scene["triangles"], compared().summary["scene"]["triangles"])
        self.assertEqual(um.info()["version"], um.program_version)
        self.assertGreater(len(um.info()["gl_devices"]), 0)
        with self.assertRaisesRegex(um.Error, "no file and no built-in scene") as raised:
            um.info(work / "none.glb")
        self.assertEqual(raised.exception.exit_code, 4)


if __name__ == "__main__":
    require_driver()
    unittest.main()
