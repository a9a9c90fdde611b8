"""Opening runs: summary, table, cells, layers, figures."""
import csv
import importlib.util
import json
import math
import shutil
import sqlite3
import subprocess
import sys
import unittest

import numpy as np
from support import compared, environment, require_driver, root, small, swept, work

import umbrameter as um


class Sweep(unittest.TestCase):
    def test_the_table_is_that_of_sweep_csv_with_units(self):
        table = um.load(swept().folder).table
        rows = list(csv.DictReader((swept().folder / "sweep.csv").read_text().splitlines()))
        self.assertEqual(list(table.columns), list(rows[0]))
        self.assertEqual(table["mae"].tolist(), [float(row["mae"]) for row in rows])
        self.assertEqual(table["shadow.filter"].tolist(), [row["shadow.filter"] for row in rows])
        self.assertEqual(table["pixels"].dtype, np.int64)
        expected = {"shadow.constant-bias": "texels", "mean_texel": "m", "mae": "1", "pixels": "px"}
        self.assertEqual({name: table.attrs["units"][name] for name in expected}, expected)
        self.assertIn("mean absolute error", table.attrs["meanings"]["mae"])

    def test_cells_lie_over_the_axes_and_the_last_varies_fastest(self):
        run = swept()
        self.assertEqual([len(values) for values in run.axes.values()], [5, 2, 2])
        self.assertEqual(run.axes["shadow.filter"].tolist(), ["nearest", "box"])
        self.assertEqual(run.over_axes("mae")[3, 1, 0], run.columns["mae"][3 * 4 + 1 * 2 + 0])

    def test_cells_are_a_dataset_of_xarray(self):
        try:
            import xarray  # noqa: F401
        except ImportError:
            self.skipTest("python3-xarray is not installed")
        run = swept()
        cells = run.cells
        self.assertEqual(dict(cells.sizes), {"shadow.constant-bias": 5, "shadow.resolution": 2, "shadow.filter": 2})
        self.assertEqual(list(cells.data_vars), [name for name in run.columns if name not in run.axes])
        for name, values in run.axes.items():
            np.testing.assert_array_equal(cells.coords[name], values, name)
        for name in run.columns:
            described = {"units": run.quantities[name].unit, "long_name": run.quantities[name].meaning}
            self.assertEqual(cells[name].attrs, described, name)
        self.assertEqual([cells[name].attrs["units"] for name in ("mean_texel", "shadow.constant-bias")], ["m", "texels"])
        self.assertEqual(cells.attrs, {"title": "contact-box: sweep", "source": f"umbrameter {um.program_version}"})
        # The row of sweep.csv that has the values of the axes.
        row = run.table.iloc[3 * 4 + 1 * 2 + 0]
        cell = cells.sel({name: row[name] for name in run.axes})
        self.assertEqual({name: cell[name].item() for name in cells.data_vars}, {name: row[name] for name in cells.data_vars})

    def test_figures_are_found_in_three_formats(self):
        figures = swept().figures
        self.assertIn("mae_0", figures)
        self.assertTrue(all(path.is_file() for each in figures.values() for path in (each.svg, each.pdf, each.png)))
        self.assertTrue(figures["mae_0"]._repr_svg_().lstrip().startswith("<"))

    def test_undefined_numbers_are_nan_and_an_incomplete_sweep_shows_its_cells(self):
        folder = work / "partial"
        shutil.copytree(swept().folder, folder)
        facts = folder / ".umbrameter-run.json"
        facts.write_text(json.dumps({**json.loads(facts.read_text()), "complete": False}))
        (folder / "summary.json").unlink()
        (folder / "results.sqlite").rename(folder / "results.partial.sqlite")
        with sqlite3.connect(folder / "results.partial.sqlite") as database:
            database.execute("DELETE FROM cells WHERE cell > 12")
            database.execute("UPDATE cells SET mae = NULL WHERE cell = 4")
        run = um.load(folder)
        self.assertEqual(len(run.table), 13)
        self.assertTrue(math.isnan(run.columns["mae"][4]))
        with self.assertRaisesRegex(ValueError, "an incomplete sweep"):
            _ = run.axes
        with self.assertRaisesRegex(FileNotFoundError, "rerun its command"):
            _ = run.summary


class Other(unittest.TestCase):
    def test_compare_has_a_row_for_each_light_and_one_for_ambient_occlusion(self):
        run = compared()
        self.assertEqual(run.table["measured"].tolist(), ["visibility", "ao"])
        self.assertEqual(run.table["light"].tolist(), ["sun", ""])
        measured = (run.summary["shadows"][0], run.summary["ao"])
        self.assertEqual(run.table["mae"].tolist(), [each["statistics"]["mae"] for each in measured])
        self.assertTrue(math.isnan(run.table["acne"][1]))
        self.assertEqual(run.table.attrs["units"]["mean_texel"], "m")
        self.assertIn("sun: ", run.answer)

    def test_tune_has_a_row_for_each_point(self):
        run = um.tune("contact-box", work / "tune", vary={"shadow_slope_bias": "0:4"}, evaluations=6, **small)
        self.assertEqual(len(run.table), run.summary["tuning"]["evaluations"])
        self.assertEqual(run.table.attrs["units"]["shadow.slope-bias"], "texels")
        self.assertEqual(run.table.attrs["units"]["mae_0"], "1")
        self.assertEqual(run.table["cost"].min(), run.summary["tuning"]["best"]["cost"])

    def test_another_folder_is_refused(self):
        with self.assertRaisesRegex(FileNotFoundError, "not a folder of umbrameter"):
            um.load(work)

    def test_a_later_summary_is_refused(self):
        folder = work / "later"
        shutil.copytree(compared().folder, folder)
        summary = json.loads((folder / "summary.json").read_text())
        (folder / "summary.json").write_text(json.dumps({**summary, "schema_version": "99"}))
        with self.assertRaisesRegex(ValueError, "version 99"):
            _ = um.load(folder).summary


class Large(unittest.TestCase):
    def test_98304_cells_open_within_300_mb_and_six_times_a_plain_read(self):
        folder = work / "large"
        folder.mkdir()
        shutil.copy(swept().folder / ".umbrameter-run.json", folder)
        shutil.copy(swept().folder / "results.sqlite", folder)
        with sqlite3.connect(folder / "results.sqlite") as database:
            names = [row[1] for row in database.execute("PRAGMA table_info(cells)")]
            row = list(database.execute("SELECT * FROM cells").fetchone())
            database.execute("DELETE FROM cells")
            axes = [names.index(name) for name in ("shadow.constant-bias", "shadow.resolution")]

            def cells():
                for cell in range(98304):
                    row[0], row[axes[0]], row[axes[1]] = cell, 0.1 + cell // 192, 64 + cell % 192
                    yield row
            database.executemany(f"INSERT INTO cells VALUES ({','.join('?' * len(names))})", cells())
        shutil.copy(swept().folder / "summary.json", folder)
        opened = {"table": "assert len(run.table) == 98304 and run.over_axes('mae').shape == (512, 192, 1)"}
        if importlib.util.find_spec("xarray"):
            opened["cells"] = "assert dict(run.cells.sizes) == dict(zip(run.axes, (512, 192, 1)))"
        for what, line in opened.items():
            # The plain read is what the machine takes now; other work on it slows both.
            script = (f"import time, resource, sqlite3\nimport umbrameter as um\nrun = um.load({str(folder)!r})\n{line}\n"
                      "opened = time.process_time()\n"
                      "megabytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024\n"
                      f"sqlite3.connect({str(folder / 'results.sqlite')!r}).execute('SELECT * FROM cells').fetchall()\n"
                      "print(opened, time.process_time() - opened, megabytes)")
            with environment(PYTHONPATH=root / "python", GLIBC_TUNABLES=""):
                result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
            seconds, plain, megabytes = map(float, result.stdout.split())
            print(f"98,304 cells as {what}, imports included: {seconds:.2f} s of CPU time, {seconds / plain:.1f} times a plain "
                  f"read, {megabytes:.0f} MB")
            self.assertLess(megabytes, 300)
            self.assertLess(seconds, 6 * plain)


if __name__ == "__main__":
    require_driver()
    unittest.main()
