"""docs/python.md as a reader follows it: a fresh environment without a network, then each block in order.

A block that imports what this Python lacks (SciPy, Optuna, matplotlib) is left out; the others need NumPy and pandas.
"""
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from support import require_driver, root, work

guide = (root / "docs" / "python.md").read_text()


class Guide(unittest.TestCase):
    def test_its_commands_and_its_code_work_when_pasted(self):
        folder = work / "reader"
        folder.mkdir()
        shutil.copytree(root / "python", folder / "python", ignore=shutil.ignore_patterns("__pycache__"))
        program = pathlib.Path(os.environ["UMBRAMETER"])
        # The Python of the test comes first, and the program is found on PATH. pip may ask no index.
        paths = [str(pathlib.Path(sys.executable).parent), str(program.parent), os.environ["PATH"]]
        environment = {**os.environ, "PATH": ":".join(paths), "PIP_NO_INDEX": "1", "PIP_FIND_LINKS": ""}
        environment.pop("UMBRAMETER", None)
        for block in re.findall(r"^```sh\n(.*?)^```", guide, re.MULTILINE | re.DOTALL):
            self.run_in(folder, environment, "bash", "-euc", block)
        before = sorted((folder / "python").rglob("*"))
        blocks = re.findall(r"^```python\n(.*?)^```", guide, re.MULTILINE | re.DOTALL)
        lacking = {block: missing for block in blocks if (missing := self.missing_in(block))}
        print("left out:", ", ".join(lacking.values()) or "nothing")
        self.assertLessEqual(set(lacking.values()), {"matplotlib", "optuna", "scipy", "xarray"})
        code = "\n".join(block for block in blocks if block not in lacking)
        output = self.run_in(folder, environment, "venv/bin/python", "-B", "-c", code)
        self.assertIn("sun: ", output)
        self.assertEqual(before, sorted((folder / "python").rglob("*")), "the installation left files in python/")
        where = self.run_in(folder / "out", environment, "../venv/bin/python", "-c",
                            "import umbrameter; print(umbrameter.__file__)")
        self.assertIn("site-packages", where)

    def missing_in(self, block):
        modules = re.findall(r"^(?:import|from) (\w+)", block, re.MULTILINE)
        return next((each for each in modules if each != "umbrameter" and not importlib.util.find_spec(each)), "")

    def run_in(self, folder, environment, *command):
        result = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, stdin=subprocess.DEVNULL)
        self.assertEqual(result.returncode, 0, f"{command}\n{result.stdout}{result.stderr}")
        return result.stdout


if __name__ == "__main__":
    require_driver()
    unittest.main()
