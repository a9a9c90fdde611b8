"""docs/python.md as a reader follows it: a fresh environment without a network, then each block in order."""
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
        for variable in ("UMBRAMETER", "PYTHONPATH"):
            environment.pop(variable, None)
        for block in re.findall(r"^```sh\n(.*?)^```", guide, re.MULTILINE | re.DOTALL):
            self.run_in(folder, environment, "bash", "-euc", block)
        before = sorted((folder / "python").rglob("*"))
        code = "\n".join(re.findall(r"^```python\n(.*?)^```", guide, re.MULTILINE | re.DOTALL))
        output = self.run_in(folder, environment, "venv/bin/python", "-B", "-c", code)
        self.assertIn("sun: ", output)
        self.assertEqual(before, sorted((folder / "python").rglob("*")), "the installation left files in python/")
        where = self.run_in(folder / "out", environment, "../venv/bin/python", "-c",
                            "import umbrameter; print(umbrameter.__file__)")
        self.assertIn("site-packages", where)

    def run_in(self, folder, environment, *command):
        result = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, stdin=subprocess.DEVNULL)
        self.assertEqual(result.returncode, 0, f"{command}\n{result.stdout}{result.stderr}")
        return result.stdout


if __name__ == "__main__":
    require_driver()
    unittest.main()
