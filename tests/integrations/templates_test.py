"""The templates for continuous integration: they parse, and their shell lines do what docs/check.md says.

usage: templates_test.py PROGRAM
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    import yaml
except ImportError:
    print("skipped: no PyYAML; install python3-yaml")
    sys.exit(77)

root = pathlib.Path(__file__).resolve().parents[2]
program = pathlib.Path(sys.argv.pop(1)).resolve()
action = yaml.safe_load((root / "integrations/github/action.yml").read_text())
job = yaml.safe_load((root / "integrations/gitlab/umbrameter.yml").read_text())[".umbrameter"]
measured = ["--size", "96x54", "--light", "sun", "--measure", "shadows", "--no-figures"]


class Templates(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.run_shell(f"umbrameter compare contact-box -o kept {' '.join(measured)}")
        self.run_shell("umbrameter check kept --budget kept.toml --update")
        broken = '[[budget]]\nstatistic = "mae"\nbound = "<= 0.0001%"\n'
        (self.folder / "broken.toml").write_text(broken)

    def run_shell(self, script, shell=("bash", "--noprofile", "--norc", "-eo", "pipefail"), **variables):
        path = f"{program.parent}:{os.environ['PATH']}"
        environment = {**os.environ, "PATH": path, "XDG_CACHE_HOME": str(self.folder / "cache"), **variables}
        return subprocess.run([*shell, "-c", script], cwd=self.folder, env=environment, capture_output=True, text=True)

    def run_action(self, **inputs):
        given = {name: each.get("default") for name, each in action["inputs"].items()} | inputs
        for step in action["runs"]["steps"]:
            if step["name"] not in ("Measure", "Check"):
                continue
            variables = {name: re.sub(r"\$\{\{ inputs\.(\w+) \}\}", lambda match: given[match[1]], text)
                         for name, text in step["env"].items()}
            result = self.run_shell(step["run"], GITHUB_STEP_SUMMARY=str(self.folder / "summary.md"), **variables)
            if result.returncode:
                break
        return result

    def expect(self, kept, broken, out, summary):
        self.assertEqual(kept.returncode, 0, kept.stderr)
        self.assertTrue((self.folder / out / "index.html").exists())
        self.assertIn("<testsuite", (self.folder / out / "junit.xml").read_text())
        self.assertEqual(broken.returncode, 1, broken.stderr)
        self.assertIn("| mae |", (self.folder / summary).read_text())
        self.assertIn("<failure", (self.folder / out / "junit.xml").read_text())

    def test_the_action_keeps_and_breaks_a_budget(self):
        inputs = {"scene": "contact-box", "arguments": " ".join(measured), "folder": "out folder"}
        self.expect(self.run_action(**inputs, budget="kept.toml"), self.run_action(**inputs, budget="broken.toml"),
                    "out folder", "summary.md")
        size = json.loads((self.folder / "out folder/summary.json").read_text())["parameters"]["view.size"]
        self.assertEqual(size, "96x54", "the arguments reach compare")

    def test_the_action_ends_where_the_scene_cannot_be_measured(self):
        self.assertEqual(self.run_action(scene="no-such-scene", budget="kept.toml").returncode, 4)

    def test_the_job_of_gitlab_keeps_and_breaks_a_budget(self):
        def run(budget):
            variables = {**job["variables"], "UMBRAMETER_SCENE": "contact-box", "UMBRAMETER_ARGUMENTS": " ".join(measured),
                         "UMBRAMETER_BUDGET": budget}
            return self.run_shell("\n".join(job["script"]), ("sh", "-e"), **variables)

        self.expect(run("kept.toml"), run("broken.toml"), "umbrameter-out", "umbrameter-out/summary.md")

    def test_pages_are_kept_where_a_bound_is_broken_too(self):
        last = action["runs"]["steps"][-1]
        self.assertEqual((last["if"], last["with"]["path"]), ("always()", "${{ inputs.folder }}"))
        self.assertEqual((job["artifacts"]["when"], job["artifacts"]["paths"]), ("always", ["umbrameter-out/"]))

    def test_no_input_is_pasted_into_a_script(self):
        for step in action["runs"]["steps"]:
            self.assertNotIn("${{", step.get("run", ""))

    @unittest.skipUnless(shutil.which("shellcheck"), "shellcheck is not installed")
    def test_shell_lines_pass_shellcheck(self):
        scripts = [(step["run"], "bash") for step in action["runs"]["steps"] if "run" in step]
        scripts.append(("\n".join(job["script"]), "sh"))
        for script, shell in scripts:
            command = ["shellcheck", f"--shell={shell}", "--severity=warning", "--exclude=SC2154", "-"]
            result = subprocess.run(command, input=script, capture_output=True, text=True)
            self.assertEqual(result.returncode, 0, result.stdout)


if __name__ == "__main__":
    devices = json.loads(subprocess.run([program, "info", "--json"], capture_output=True, check=True).stdout)["gl_devices"]
    if not devices:
        print("skipped: no OpenGL driver")
        sys.exit(77)
    unittest.main()
