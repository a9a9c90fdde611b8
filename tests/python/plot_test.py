"""Plots: what they draw, and that it can be read."""
import unittest

import numpy as np
from support import compared, require_driver, swept, work

try:
    import matplotlib
except ImportError:
    import sys

    print("skipped: matplotlib is missing; install python3-matplotlib")
    sys.exit(77)
matplotlib.use("Agg")
from umbrameter import plot  # noqa: E402


class Plots(unittest.TestCase):
    def test_bias_curves_draw_the_error_in_per_cent_with_a_circle_at_the_minimum(self):
        axes = plot.bias_curves(swept(), shadow_filter="nearest")
        lines = axes.get_lines()
        error = swept().over_axes("mae")[:, :, 0]
        np.testing.assert_allclose(lines[0].get_ydata(), 100 * error[:, 0])
        np.testing.assert_allclose(lines[2].get_ydata(), 100 * error[:, 1])
        self.assertAlmostEqual(np.ravel(lines[3].get_ydata())[0], 100 * error[:, 1].min())
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("constant bias [texels]", "mean absolute error [%]"))
        self.assertEqual([text.get_text() for text in axes.get_legend().get_texts()], ["256", "512"])
        self.assertEqual(axes.get_legend().get_title().get_text(), "resolution [texels]")
        self.assertNotEqual(lines[0].get_linestyle(), lines[2].get_linestyle())

    def test_causes_need_one_combination_and_draw_four_lines(self):
        with self.assertRaisesRegex(ValueError, "give values of shadow.resolution, shadow.filter"):
            plot.causes(swept())
        axes = plot.causes(swept(), shadow_resolution=512, shadow_filter="box")
        np.testing.assert_allclose(axes.get_lines()[2].get_ydata(), 100 * swept().over_axes("peter_panning")[:, 1, 1])

    def test_a_heat_map_has_the_first_axis_across(self):
        axes = plot.heat_map(swept(), shadow_filter="nearest")
        drawn = axes.collections[0].get_array().reshape(2, 5)
        np.testing.assert_allclose(drawn, 100 * swept().over_axes("mae")[:, :, 0].T)
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("constant bias [texels]", "resolution [texels]"))
        across = plot.heat_map(swept(), over=("shadow_resolution", "shadow_constant_bias"), shadow_filter="nearest")
        np.testing.assert_allclose(across.collections[0].get_array().reshape(5, 2), drawn.T)

    def test_no_cell_beats_one_of_the_pareto_front(self):
        every, front = plot.pareto_front(swept()).get_lines()
        x, y = np.array(every.get_data())
        for a, b in zip(*front.get_data(), strict=True):
            self.assertFalse(np.any((x <= a) & (y <= b) & ((x < a) | (y < b))))
        on_front = set(zip(*front.get_data(), strict=True))
        for a, b in zip(x, y, strict=True):
            self.assertTrue((a, b) in on_front or np.any((x <= a) & (y <= b) & ((x < a) | (y < b))))

    def test_maps_draw_the_layers(self):
        np.testing.assert_array_equal(plot.error_map(compared()).images[0].get_array(), compared().layers["error_visibility_sun"])
        axes = plot.cause_map(compared())
        np.testing.assert_array_equal(axes.images[0].get_array(), compared().layers["class_sun"])
        axes.figure.savefig(work / "causes.pdf")
        ink = axes.figure.get_window_extent()
        legend = axes.get_legend().get_window_extent()
        self.assertTrue(ink.x0 <= legend.x0 and legend.x1 <= ink.x1, "the legend is cut off")

    def test_an_unknown_axis_or_value_is_refused_by_name(self):
        for arguments, words in (({"shadow_technique": "vsm"}, "'shadow_technique' is no axis"),
                                 ({"shadow_filter": "tent"}, "has no value 'tent': nearest, box"),
                                 ({"over": "ao.radius"}, "'ao.radius' is no axis"), ({"statistic": "ssim"}, "no column 'ssim'")):
            with self.assertRaisesRegex(ValueError, words):
                plot.bias_curves(swept(), **arguments)

    def test_the_style_ends_with_the_call(self):
        before = matplotlib.rcParams["font.size"]
        plot.bias_curves(swept())
        self.assertEqual(matplotlib.rcParams["font.size"], before)


if __name__ == "__main__":
    require_driver()
    unittest.main()
