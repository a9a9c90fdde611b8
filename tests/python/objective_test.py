"""um.objective: the error of a scene as a function of parameters, and optimisers that minimise it."""
import gc
import math
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy as np
from support import environment, fake_program, require_driver, root, work

import umbrameter as um

try:
    from scipy import optimize
except ImportError:
    optimize = None

small = {"view_size": (96, 54), "view_light": "sun"}
courtyard = {"view_size": (640, 360), "view_light": "sun"}


def least(function, first, last):
    """Where a function with one minimum has it: golden-section search."""
    golden = (math.sqrt(5) - 1) / 2
    values = {}

    def at(x):
        return values.setdefault(x, function(x))

    while last - first > 1e-4:
        lower, upper = last - golden * (last - first), first + golden * (last - first)
        first, last = (first, upper) if at(lower) < at(upper) else (lower, last)
    return min(values, key=values.get)


def process_of(objective):
    return objective._program.process


class Calls(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.error = um.objective("contact-box", ["shadow_constant_bias", "shadow.slope-bias"], **small)

    @classmethod
    def tearDownClass(cls):
        cls.error.close()

    def test_a_call_is_the_error_that_compare_reports(self):
        run = um.compare("contact-box", **small, run_measure="visibility", shadow_constant_bias=0.03, shadow_slope_bias=1.5,
                         figures=False)
        expected = run.summary["shadows"][0]["statistics"]
        self.assertAlmostEqual(self.error([0.03, 1.5]), expected["mae"], 12)
        measured = self.error.evaluate([0.03, 1.5])
        self.assertGreater(measured.milliseconds, 0)
        self.assertEqual(set(measured.statistics), set(expected))
        for name, value in expected.items():
            self.assertAlmostEqual(measured.statistics[name], value, 12, name)

    def test_points_are_arrays_sequences_mappings_and_keywords(self):
        expected = self.error([0.03, 1.5])
        for value in (self.error(np.array([0.03, 1.5])), self.error((0.03, 1.5)),
                      self.error({"shadow.constant-bias": 0.03, "shadow_slope_bias": 1.5}),
                      self.error(shadow_constant_bias=0.03, shadow_slope_bias=np.float64(1.5)),
                      self.error([0.03, 0.0], shadow_slope_bias=1.5)):
            self.assertEqual(value, expected)
        self.assertIsInstance(expected, float)

    def test_other_values_than_numbers_are_those_of_the_command_line(self):
        at = {"shadow_filter": "box", "shadow_filter_size": 5, "shadow_constant_bias": "2texels"}
        self.assertEqual(self.error(at, view_size=(48, 27)), self.error(at, view_size="48x27"))
        self.assertNotEqual(self.error(at), self.error())

    def test_one_parameter_takes_a_plain_number_and_its_unit(self):
        with um.objective("contact-box", {"shadow_constant_bias": "texels"}, **small) as error:
            self.assertEqual(error.names, ("shadow.constant-bias",))
            for one in (2, 2.0, np.float64(2), np.array(2.0), [2.0]):
                self.assertEqual(error(one), error(shadow_constant_bias="2texels"))

    def test_the_description_says_what_is_measured(self):
        self.assertEqual(self.error.description["light"], "sun")
        self.assertEqual(self.error.description["scene"], "contact-box")
        self.assertEqual(self.error.statistic, "mae")
        self.assertEqual(self.error.quantities["mean_texel"].unit, "m")
        self.assertEqual(self.error.names, ("shadow.constant-bias", "shadow.slope-bias"))

    def test_a_refused_value_is_an_error_and_the_next_call_is_measured(self):
        for point, words in (({"shadow_resolution": 0}, "shadow.resolution.*1 to 16384"),
                             ({"shadow_filter_size": 3}, "does not read"), ({"ao_radius": 1.0}, "no effect on shadows"),
                             ({"scene_unit": "cm"}, "fixed")):
            with self.assertRaisesRegex(um.Error, words) as raised:
                self.error(point)
            self.assertIsNone(raised.exception.exit_code)
        with self.assertRaisesRegex(TypeError, "shadow_constant_bias"):
            self.error(shadow_constnt_bias=1)
        with self.assertRaisesRegex(TypeError, "3 values for 2 parameters"):
            self.error([1, 2, 3])
        with self.assertRaises(ValueError):
            self.error([float("nan"), 0])
        self.assertGreater(self.error([0.03, 0]), 0)

    def test_threads_have_the_replies_of_their_own_calls(self):
        biases = [0.01 * i for i in range(8)]
        expected = [self.error([bias, 0]) for bias in biases]
        found = [None] * len(biases)

        def measure(i):
            found[i] = self.error([biases[i], 0])

        threads = [threading.Thread(target=measure, args=(i,)) for i in range(len(biases))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, expected)


class Statistics(unittest.TestCase):
    def test_ambient_occlusion_has_intervals_and_metrics(self):
        with um.objective("contact-box", ["ao_radius"], **small, run_measure="ao", run_metrics="rmse,psnr",
                          statistic="psnr") as score:
            statistics = score.evaluate(0.4).statistics
            self.assertEqual(score(0.4), statistics["psnr"])
            self.assertLess(statistics["mae_lo"], statistics["mae"])
            self.assertLess(statistics["mae"], statistics["mae_hi"])

    def test_a_statistic_that_is_not_measured_is_refused_with_the_names_of_those_that_are(self):
        before = threading.active_count()
        with self.assertRaisesRegex(um.Error, "no statistic 'psnr'.*mae"):
            um.objective("contact-box", **small, statistic="psnr")
        self.assertEqual(threading.active_count(), before)


class Life(unittest.TestCase):
    def test_the_process_ends_with_the_block_and_with_the_object(self):
        with um.objective("contact-box", **small) as error:
            process = process_of(error)
            self.assertIsNone(process.poll())
        self.assertEqual(process.returncode, 0)
        with self.assertRaisesRegex(um.Error, "closed"):
            error()
        error.close()
        error = um.objective("contact-box", **small)
        process = process_of(error)
        del error
        gc.collect()
        self.assertEqual(process.returncode, 0)

    def test_a_scene_that_cannot_be_measured_is_an_error_with_the_line_of_the_program(self):
        for scene, code, words in (("no-such-scene", 4, "no-such-scene"), ("courtyard", 2, "3 lights")):
            with self.assertRaisesRegex(um.Error, f"^umbrameter: .*{words}") as raised:
                um.objective(scene)
            self.assertEqual(raised.exception.exit_code, code)
            self.assertEqual(raised.exception.command[1:3], ["serve", scene])

    def test_keywords_of_folders_are_refused(self):
        with self.assertRaisesRegex(TypeError, "writes no files.*figures"):
            um.objective("contact-box", figures=False)
        with self.assertRaisesRegex(TypeError, "list of names"):
            um.objective("contact-box", "shadow_constant_bias")

    def test_a_process_that_dies_is_an_error_with_its_last_line(self):
        with um.objective("contact-box", **small) as error:
            process_of(error).kill()
            with self.assertRaises(um.Error) as raised:
                error()
            self.assertEqual(raised.exception.exit_code, -signal.SIGKILL)
        described = '{"id": 1, "objective": "mae", "statistics": [{"name": "mae", "unit": "1", "meaning": ""}]}'
        body = f"read -r request; echo '{described}'; read -r request; echo 'umbrameter: the driver is gone' >&2; exit 3"
        with environment(UMBRAMETER=fake_program("losing", body)), um.objective("any") as error:
            with self.assertRaisesRegex(um.Error, "^umbrameter: the driver is gone$") as raised:
                error()
            self.assertEqual(raised.exception.exit_code, 3)

    def test_control_c_ends_a_call_and_the_process(self):
        described = '{"id": 1, "objective": "mae", "statistics": [{"name": "mae", "unit": "1", "meaning": ""}]}'
        body = f"cd {work}; read -r request; echo '{described}'; read -r request; echo $$ >asked; exec sleep 60"
        script = ("import umbrameter\nerror = umbrameter.objective('any')\ntry:\n error()\nexcept KeyboardInterrupt:\n"
                  " print('interrupted')\ntry:\n error()\nexcept umbrameter.Error as closed:\n print(closed)")
        with environment(UMBRAMETER=fake_program("slow-reply", body), PYTHONPATH=root / "python"):
            process = subprocess.Popen([sys.executable, "-B", "-c", script], stdout=subprocess.PIPE, text=True)
        asked = pathlib.Path(work / "asked")
        while not asked.exists() or not asked.read_text():
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.communicate(timeout=30)[0], "interrupted\numbrameter: the objective is closed\n")
        with self.assertRaises(ProcessLookupError):
            os.kill(int(asked.read_text()), 0)


class Optimisers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        run = um.tune("courtyard", vary={"shadow_constant_bias": "0:0.2"}, **courtyard, figures=False)
        cls.tuned = run.summary["tuning"]["best"]
        cls.error = um.objective("courtyard", ["shadow_constant_bias"], **courtyard)

    @classmethod
    def tearDownClass(cls):
        cls.error.close()

    def check(self, bias, cost):
        """tune knows the error at 16,000 biases; an optimiser of smooth functions ends beside a step of it."""
        self.assertAlmostEqual(bias, self.tuned["values"]["shadow.constant-bias"], delta=0.001)
        self.assertAlmostEqual(cost, self.tuned["cost"], delta=0.005 * self.tuned["cost"])

    def test_the_error_at_the_tuned_bias_is_the_tuned_cost(self):
        self.assertAlmostEqual(self.error(self.tuned["values"]["shadow.constant-bias"]), self.tuned["cost"], 12)

    def test_a_golden_section_search_finds_the_bias_of_tune(self):
        bias = least(self.error, 0, 0.2)
        self.check(bias, self.error(bias))

    @unittest.skipIf(optimize is None, "scipy is not installed")
    def test_scipy_finds_the_bias_of_tune(self):
        found = optimize.minimize_scalar(self.error, bounds=(0, 0.2), method="bounded", options={"xatol": 1e-4})
        self.check(found.x, found.fun)
        found = optimize.minimize(self.error, [0.06], method="Nelder-Mead", bounds=[(0, 0.2)],
                                  options={"xatol": 1e-4, "fatol": 1e-6})
        self.check(found.x[0], found.fun)

    def test_a_call_takes_less_than_20_ms_beyond_the_measurement(self):
        beyond = []
        for i in range(21):
            begin = time.perf_counter()
            measured = self.error.evaluate([0.03 + 0.001 * i])
            beyond.append(1000 * (time.perf_counter() - begin) - measured.milliseconds)
        # The median: a busy machine delays single calls.
        self.assertLess(sorted(beyond)[10], 20, beyond)


if __name__ == "__main__":
    require_driver()
    unittest.main()
