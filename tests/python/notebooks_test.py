"""The notebooks of python/examples: each runs from its first cell to its last, its page is up to date, and it holds no output."""
import json
import re
import sys
import unittest

from support import require_driver, root, work

try:
    import matplotlib  # noqa: F401
except ImportError:
    print("skipped: matplotlib is missing; install python3-matplotlib")
    sys.exit(77)
sys.path.insert(0, str(root / "tests" / "documentation"))
from notebook_page import write_page  # noqa: E402

expected = {"ambient_occlusion_methods": 1, "bias_of_my_scene": 4, "my_engine_against_the_reference": 2}  # figures


def without_output(page):
    """What cells print depends on the machine, by a digit."""
    return re.sub(r"^```text\n.*?^```\n", "```text\n```\n", page, flags=re.MULTILINE | re.DOTALL)


class Notebooks(unittest.TestCase):
    def test_each_runs_in_order_draws_its_figures_and_has_a_page_of_its_cells(self):
        paths = sorted((root / "python" / "examples").glob("*.ipynb"))
        self.assertEqual([path.stem for path in paths], list(expected))
        pages = root / "docs" / "notebooks"
        for path in paths:
            images = write_page(path, work)
            self.assertEqual(len(images), expected[path.stem], path.name)
            page = f"{path.stem}.md"
            self.assertEqual(without_output((work / page).read_text()), without_output((pages / page).read_text()),
                             f"{page} is out of date: scripts/docs --notebooks writes it")
            self.assertEqual([image.name for image in images if not (pages / image.name).is_file()], [])

    def test_none_holds_output(self):
        for path in (root / "python" / "examples").glob("*.ipynb"):
            for cell in json.loads(path.read_text())["cells"]:
                if cell["cell_type"] == "code":
                    self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None), path.name)


if __name__ == "__main__":
    require_driver()
    unittest.main()
