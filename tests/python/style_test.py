"""mypy --strict and ruff, each where it is installed; docstrings of everything public."""
import ast
import inspect
import os
import shutil
import subprocess
import sys
import unittest

import support

import umbrameter as um


class Style(unittest.TestCase):
    def check(self, *command, folder="python"):
        if shutil.which(command[0]) is None:
            self.skipTest(f"{command[0]} is not installed")
        result = subprocess.run(command, cwd=support.root / folder, capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_mypy_finds_nothing(self):
        # What it keeps of numpy and pandas serves the next run.
        kept = os.environ.get("MYPY_CACHE_DIR") or str(support.work / "mypy")
        self.check("mypy", "--cache-dir", kept, "--python-executable", sys.executable)

    def test_ruff_finds_nothing(self):
        self.check("ruff", "check", "--no-cache", ".")
        # Tests and the adapters of engines are no library: they go without docstrings.
        self.check("ruff", "check", "--no-cache", "--config", "python/pyproject.toml", "--ignore", "D1", "tests/python",
                   "engines", folder=".")

    def test_the_package_imports_nothing_of_ours(self):
        allowed = sys.stdlib_module_names | {"numpy", "pandas", "xarray", "matplotlib", "bundle"}  # the last beside backend.py
        for path in (support.root / "python").glob("**/*.py"):
            for node in ast.walk(ast.parse(path.read_text())):
                names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
                if isinstance(node, ast.ImportFrom) and node.level == 0:
                    names = [node.module]
                self.assertEqual({name.split(".")[0] for name in names} - allowed, set(), path)

    def test_everything_public_has_a_docstring_and_hints(self):
        for name in um.__all__:
            thing = getattr(um, name)
            if inspect.isfunction(thing) or inspect.isclass(thing):
                self.assertTrue(thing.__doc__, name)
                self.assertNotIn("Initialize self", thing.__doc__)
            if inspect.isclass(thing):
                for member, each in inspect.getmembers(thing, lambda x: inspect.isfunction(x) or isinstance(x, property)):
                    if not member.startswith("_"):
                        self.assertTrue(each.__doc__, f"{name}.{member}")


if __name__ == "__main__":
    unittest.main()
