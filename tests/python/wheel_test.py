"""A wheel that carries the program, in a fresh environment without another one. usage: wheel_test.py CMAKE BUILD_FOLDER"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest
import zipfile

from support import require_driver, root, work

cmake, build = sys.argv[1:3]


class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        prefix = work / "prefix"
        cls.run_in(root, cmake, "--install", build, "--component", "program", "--prefix", prefix, "--strip")
        cls.environment = {name: value for name, value in os.environ.items() if name not in ("UMBRAMETER", "PYTHONPATH")}
        cls.environment |= {"PATH": "/usr/bin:/bin", "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
        cls.run_in(work, sys.executable, "-m", "venv", "--system-site-packages", "venv")
        shutil.copytree(root / "python", work / "python", ignore=shutil.ignore_patterns("__pycache__"))
        pip = work / "venv" / "bin" / "pip"
        cls.run_in(work, pip, "wheel", "--no-index", "--no-deps", "--quiet", "--config-settings", f"program={prefix}", "./python")
        cls.wheel, = work.glob("*.whl")
        cls.run_in(work, pip, "install", "--no-index", "--quiet", cls.wheel)
        where = cls.run_in(work, "venv/bin/python", "-c", "import umbrameter; print(umbrameter.find_program())").strip()
        cls.program = pathlib.Path(where)

    @classmethod
    def run_in(cls, folder, *command):
        environment = getattr(cls, "environment", None)
        result = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, stdin=subprocess.DEVNULL)
        assert result.returncode == 0, f"{command}\n{result.stdout}{result.stderr}"
        return result.stdout

    def test_it_measures_with_the_program_that_it_carries(self):
        self.assertIn("site-packages", self.program.parts)
        self.assertIsNone(shutil.which("umbrameter", path=self.environment["PATH"]))
        answer = self.run_in(work, "venv/bin/python", "-c", "import umbrameter as um\n"
                             "run = um.compare('contact-box', view_size=(96, 54), run_measure='visibility', view_light='sun')\n"
                             "print(run.answer, run.layers['error_visibility_sun'].shape, run.figures['picture'].png.is_file())")
        self.assertIn("sun: ", answer)
        self.assertIn("(54, 96) True", answer)
        self.assertIn("godot", self.run_in(work, "venv/bin/umbrameter", "presets"), "its data are missing")

    def test_only_the_runtime_libraries_are_those_of_the_system(self):
        linked = re.findall(r"=> (\S+)", self.run_in(work, "ldd", self.program.parent / "bin" / "umbrameter"))
        ours = [path for path in linked if pathlib.Path(path).is_relative_to(work)]
        self.assertGreater(len(ours), 30)
        others = {pathlib.Path(path).name for path in linked if path not in ours}
        self.assertLessEqual(others, {"libc.so.6", "libm.so.6", "libdl.so.2", "libpthread.so.0", "librt.so.1", "libgcc_s.so.1",
                                      "libstdc++.so.6"})

    def test_its_name_says_which_c_library_it_needs_and_it_has_the_licences(self):
        version, machine = re.fullmatch(r"umbrameter-\S+-py3-none-manylinux_2_(\d+)_(\w+)\.whl", self.wheel.name).groups()
        self.assertLessEqual(int(version), int(os.confstr("CS_GNU_LIBC_VERSION").split(".")[1]))
        self.assertEqual(machine, os.uname().machine)
        names = zipfile.ZipFile(self.wheel).namelist()
        for package in ("fonts-dejavu-core", "librsvg2-2", "libtbb12"):
            self.assertIn(f"umbrameter-0.1.0.dist-info/licenses/{package}", names)
        print(f"{self.wheel.name}: {self.wheel.stat().st_size / 1e6:.0f} MB")

    def test_a_folder_without_a_program_is_refused(self):
        command = ["venv/bin/pip", "wheel", "--no-index", "--no-deps", "--config-settings", "program=/nowhere", "./python"]
        result = subprocess.run(command, cwd=work, env=self.environment, capture_output=True, text=True)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("/nowhere/bin/umbrameter is missing", result.stdout + result.stderr)


if __name__ == "__main__":
    require_driver()
    if shutil.which("patchelf") is None:
        print("skipped: patchelf is missing; install patchelf")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
