"""The notebooks of python/examples: each runs from its first cell to its last, and holds no output."""
import json
import os
import unittest

from support import require_driver, root, work

try:
    import matplotlib
except ImportError:
    import sys

    print("skipped: matplotlib is missing; install python3-matplotlib")
    sys.exit(77)
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

expected = {"ambient_occlusion_methods": 1, "bias_of_my_scene": 4, "my_engine_against_the_reference": 2}  # figures


class Notebooks(unittest.TestCase):
    def test_each_runs_in_order_and_draws_its_figures(self):
        paths = sorted((root / "python" / "examples").glob("*.ipynb"))
        self.assertEqual([path.stem for path in paths], list(expected))
        os.chdir(work)
        for path in paths:
            plt.close("all")
            variables = {}
            for number, cell in enumerate(json.loads(path.read_text())["cells"]):
                if cell["cell_type"] == "code":
                    exec(compile("".join(cell["source"]), f"{path.name}, cell {number}", "exec"), variables)
            self.assertEqual(len(plt.get_fignums()), expected[path.stem], path.name)
            for figure in plt.get_fignums():
                plt.figure(figure).savefig(work / f"{path.stem}-{figure}.png", dpi=150)

    def test_none_holds_output(self):
        for path in (root / "python" / "examples").glob("*.ipynb"):
            for cell in json.loads(path.read_text())["cells"]:
                if cell["cell_type"] == "code":
                    self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None), path.name)


if __name__ == "__main__":
    require_driver()
    unittest.main()
