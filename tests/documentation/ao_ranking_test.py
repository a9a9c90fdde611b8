"""Checks that docs/ambient-occlusion/table.md ranks the AO methods by their own published denoisers, by one blur for all, and by
one budget of reads: the same methods in each, the least mean RMSE first.

usage: ao_ranking_test.py ROOT [unittest arguments]
"""

import pathlib
import re
import sys
import unittest

ROOT = sys.argv.pop(1)


class Ranking(unittest.TestCase):
    def test_each_has_the_same_methods_and_the_least_mean_first(self):
        page = (pathlib.Path(ROOT) / "docs" / "ambient-occlusion" / "table.md").read_text()
        parts = re.split(r"^### ", page.split("\n## Ranking\n")[1].split("\n## ")[0], flags=re.MULTILINE)[1:]
        titles = " ".join(part.split("\n")[0] for part in parts)
        for words in ("Default: published denoisers", "box blur for all", "64 reads per pixel"):
            self.assertIn(words, titles)
        methods = []
        for part in parts:
            rows = [[cell.strip() for cell in row.strip("|").split("|")] for row in re.findall(r"^\|.*", part, re.MULTILINE)][2:]
            self.assertGreater(len(rows), 5)
            means = [float(row[-1]) for row in rows]
            self.assertEqual(means, sorted(means))
            methods.append({row[0] for row in rows} - {"ray-marched SSAO"})  # it has no budget of reads
        self.assertEqual(methods, [methods[0]] * len(methods))


if __name__ == "__main__":
    unittest.main()
