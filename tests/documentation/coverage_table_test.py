"""Checks the tables of docs/reference.md that say how often 95 % intervals hold: shares of 92 to 98 %, or of at least 92 %
for bounds of absolute errors, each of 200 seeds or more, and among them the case of few rays.

usage: coverage_table_test.py ROOT [unittest arguments]
"""

import pathlib
import re
import sys
import unittest

BOUNDS = {"mae", "false_blocked", "false_lit", "penumbra_mae"}  # they may hold more often
# Over the choice of pixels, absolute errors and costs with one of them are bounds where rays sample the reference.
BOUNDS_OF_VIEWS = {"mae", "difference: mae", "tune: cost", "difference"}
SAMPLED = {"sun of 4°", "AO"}
LEAST, MOST = 92.0, 98.0
FEWEST_SEEDS = 200


def cells_of(row):
    return [cell.strip().replace("`", "") for cell in row.strip().strip("|").split("|")]


def tables_of(text):
    """Heads and rows of each table."""
    for table in re.findall(r"(?:^\|.*\n)+", text, re.MULTILINE):
        head, _, *rows = map(cells_of, table.splitlines())
        yield head, rows


def shares_of(cell):
    """Without what is in parentheses, a number of seeds."""
    return [float(number) for number in re.findall(r"\d+(?:\.\d+)?", re.sub(r"\(.*?\)", "", cell))]


class StatedCoverage(unittest.TestCase):
    def setUp(self):
        page = (pathlib.Path(ROOT) / "docs" / "reference.md").read_text()
        section = re.search(r"^### How often these intervals hold\n(.*?)(?=^## |\Z)", page, re.MULTILINE | re.DOTALL)
        self.assertIsNotNone(section, "docs/reference.md does not say how often its intervals hold")
        self.tables = list(tables_of(section[1]))

    def test_every_share_is_92_to_98_percent(self):
        checked = 0
        for head, rows in self.tables:
            is_of_rays = "seeds" in head
            for row in rows:
                for name, cell in zip(head[1:], row[1:]):
                    if name == "seeds":
                        self.assertGreaterEqual(int(cell), FEWEST_SEEDS, row[0])
                        continue
                    is_bound = name in BOUNDS if is_of_rays else name in BOUNDS_OF_VIEWS and row[0] in SAMPLED
                    most = 100.0 if is_bound else MOST
                    for share in shares_of(cell):
                        checked += 1
                        self.assertTrue(LEAST <= share <= most, f"{row[0]}, {name}: {share} %")
        self.assertGreater(checked, 100)

    def test_few_rays_are_among_the_cases(self):
        few = {row[0]: dict(zip(head, row)) for head, rows in self.tables for row in rows if "64 rays" in row[0]}
        self.assertIn("contact-box, sun of 8°, 64 rays", few)
        for name in ("lit", "mean_error", "false_lit"):
            self.assertTrue(shares_of(few["contact-box, sun of 8°, 64 rays"][name]), name)


if __name__ == "__main__":
    ROOT = sys.argv.pop(1)
    unittest.main()
