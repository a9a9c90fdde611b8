"""check and update_budget against the program."""
import math
import unittest
from xml.etree import ElementTree

import numpy as np
from support import compared, require_driver, swept, work

import umbrameter as um


class Check(unittest.TestCase):
    def test_a_broken_bound_is_a_result_and_says_by_how_much(self):
        mae = compared().summary["shadows"][0]["statistics"]["mae"]
        result = um.check(compared(), [{"statistic": "mae", "kind": "shadow", "light": "sun", "bound": mae / 2},
                                       {"statistic": "mae", "kind": "shadow", "light": np.int64(0), "bound": "<= 100%"}])
        self.assertFalse(result)
        self.assertEqual([each.kept for each in result.checks], [False, True])
        broken, = result.broken
        self.assertEqual((broken.run, broken.scene, broken.kind, broken.light, broken.statistic, broken.unit, broken.relation),
                         ("compare", "contact-box", "shadow", "sun", "mae", "1", "<="))
        self.assertEqual((broken.value, broken.bound, broken.excess), (mae, mae / 2, mae / 2))
        self.assertTrue(math.isnan(broken.excess_in_intervals))
        self.assertIn("FAILED  compare: contact-box, sun, mae: ", repr(result))
        self.assertIn("1 of 2 bounds kept", repr(result))

    def test_of_a_sampled_reference_the_excess_is_in_intervals_too(self):
        check, = um.check(compared(), [{"statistic": "ao.mae", "bound": 0.01}]).checks
        statistics = compared().summary["ao"]["statistics"]
        self.assertEqual(check.excess, statistics["mae"] - 0.01)
        self.assertAlmostEqual(check.excess_in_intervals, check.excess / (check.value - statistics["mae_lo"]), 9)

    def test_a_bound_that_no_run_measured_is_broken(self):
        check, = um.check(compared(), [{"statistic": "psnr", "kind": "image", "bound": ">= 30"}]).broken
        self.assertEqual((check.kind, check.bound, check.run), ("image", 30, ""))
        self.assertTrue(math.isnan(check.value))
        self.assertIn("not measured", str(check))

    def test_of_several_runs_each_bound_has_the_name_of_its_folder(self):
        result = um.check([compared(), swept().folder], [{"statistic": "shadow.mae", "bound": "<= 100%"}])
        self.assertEqual([each.run for each in result.checks], ["compare", "sweep"])
        self.assertEqual(result.table["run"].tolist(), ["compare", "sweep"])
        self.assertEqual(result.table["value"].tolist(), [each.value for each in result.checks])

    def test_a_notebook_and_a_server_get_the_tables_of_the_program(self):
        result = um.check(compared(), [{"statistic": "acne", "bound": "<= 100%"}], junit=work / "junit.xml")
        self.assertIn("| contact-box, sun | acne |", result._repr_markdown_())
        self.assertEqual(ElementTree.parse(work / "junit.xml").getroot().attrib["failures"], "0")

    def test_a_budget_that_is_not_understood_is_an_error_with_its_place(self):
        good = {"statistic": "acne", "bound": "<= 1%"}
        for budget, words in (([good, {"statistic": "acme", "bound": 1}], "budget:2: .*did you mean 'acne'"),
                              ([good, good, {"statistic": "acne", "bound": 'ü"'}], """budget:3 'ü"'.*there is no number"""),
                              ([], "holds no"), (work / "none.toml", "none.toml.*no such file")):
            with self.assertRaisesRegex(um.Error, words) as raised:
                um.check(compared(), budget)
            self.assertIn(raised.exception.exit_code, (2, 4))
        with self.assertRaisesRegex(um.Error, "give the folder of a finished"):
            um.check(work / "none", [good])
        with self.assertRaisesRegex(ValueError, "no run"):
            um.check([], [good])


class Update(unittest.TestCase):
    def test_what_a_run_measured_is_kept_by_its_own_budget(self):
        line = um.update_budget(compared(), work / "budget.toml")
        result = um.check(compared(), work / "budget.toml")
        self.assertTrue(result)
        self.assertEqual({each.kind for each in result.checks}, {"shadow", "ao"})
        self.assertIn(f"{len(result.checks)} bounds written", line)
        self.assertIn(f"{len(result.checks)} of {len(result.checks)} bounds updated",
                      um.update_budget([compared()], work / "budget.toml"))


if __name__ == "__main__":
    require_driver()
    unittest.main()
