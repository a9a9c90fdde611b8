"""The examples for engines of many machines: each finds the shards of a plan and leaves the merged sweep.

usage: shards_test.py PROGRAM     scripts/test-cluster runs them on a real Slurm
"""
import json
import os
import pathlib
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

root = pathlib.Path(__file__).resolve().parents[2] / "integrations"
program = pathlib.Path(sys.argv.pop(1)).resolve()
sweep = ["corner", "--light", "0", "--size", "32x18", "--vary", "shadow.resolution=16,32,64"]
tuning = ["corner", "--size", "32x18", "--truth.spp", "4", "--minimize", "rmse", "--evaluations", "6",
          "--vary", "ao.radius=1%:8%", "--vary", "ao.power=0.5:4"]


class Shards(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "bin").mkdir()

    def run_command(self, *words, **variables):
        path = f"{self.folder / 'bin'}:{program.parent}:{os.environ['PATH']}"
        environment = {**os.environ, "PATH": path, "XDG_CACHE_HOME": str(self.folder / "cache"), **variables}
        return subprocess.run(words, cwd=self.folder, env=environment, capture_output=True, text=True)

    def plan(self):
        result = self.run_command("umbrameter", "plan", "sweep", *sweep, "--shards", "3", "-o", "plan")
        self.assertEqual(result.returncode, 0, result.stderr)

    def put_command(self, name, script):
        file = self.folder / "bin" / name
        file.write_text("#!/usr/bin/env bash\n" + script)
        file.chmod(0o755)

    def status(self):
        return json.loads(self.run_command("umbrameter", "status", "plan", "--json").stdout)

    @unittest.skipUnless(shutil.which("parallel"), "GNU parallel is not installed")
    def test_parallel_runs_and_merges_what_is_missing(self):
        self.plan()
        self.run_command("umbrameter", "run", "plan", "--shard", "1")
        result = self.run_command(root / "parallel/umbrameter-parallel", "plan", "out", "-j2")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue((self.folder / "out/sweep.csv").exists())

    @unittest.skipUnless(shutil.which("parallel"), "GNU parallel is not installed")
    def test_parallel_runs_the_rounds_of_a_tuning_until_it_has_ended(self):
        planned = self.run_command("umbrameter", "plan", "tune", *tuning, "--shards", "3", "-o", "plan")
        self.assertEqual(planned.returncode, 0, planned.stderr)
        result = self.run_command(root / "parallel/umbrameter-parallel", "plan", "out", "-j2")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("round 3 of about", result.stdout)
        alone = self.run_command("umbrameter", "tune", *tuning, "-o", "alone")
        self.assertEqual(alone.returncode, 0, alone.stderr)
        for name in ("summary.json", "evaluations.csv", "index.html"):
            self.assertEqual((self.folder / "out" / name).read_bytes(), (self.folder / "alone" / name).read_bytes(), name)

    def test_slurm_submits_the_next_round_of_a_tuning_although_no_try_is_left(self):
        self.run_command("umbrameter", "plan", "tune", *tuning, "--shards", "3", "-o", "plan")
        self.run_command("umbrameter", "run", "plan", "--shard", "0-2")
        self.put_command("scontrol", "echo 'MaxArraySize            = 1001'\n")
        self.put_command("sbatch", 'echo "$UMBRAMETER_SHARDS" >> log; wc -l < log\n')
        script = root / "slurm/umbrameter-slurm"
        merged = self.run_command(script, "plan", "out", "1", UMBRAMETER_SLURM_MERGE="yes", UMBRAMETER_SLURM_TRIES="3")
        self.assertEqual(merged.returncode, 0, merged.stderr)
        self.assertTrue((self.folder / "log").read_text().startswith("3,4"), "the shards of round 2")

    @unittest.skipUnless(shutil.which("snakemake"), "Snakemake is not installed")
    def test_snakemake_plans_runs_and_merges(self):
        result = self.run_command("snakemake", "-j2", "-s", root / "snakemake/Snakefile", "--config",
                                  "sweep=" + " ".join(sweep), "shards=3")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue((self.folder / "out/sweep.csv").exists())

    def test_slurm_submits_arrays_within_the_limit_and_a_merge_after_them(self):
        self.plan()
        self.run_command("umbrameter", "run", "plan", "--shard", "1")
        self.put_command("scontrol", "echo 'MaxArraySize            = 1'\n")
        self.put_command("sbatch", 'echo "$UMBRAMETER_SHARDS|$UMBRAMETER_SLURM_MERGE|$*" >> log; wc -l < log\n')
        result = self.run_command(root / "slurm/umbrameter-slurm", "plan", "out", UMBRAMETER_SBATCH="--time=60")
        self.assertEqual(result.returncode, 0, result.stderr)
        first, second, merge = (self.folder / "log").read_text().splitlines()
        self.assertTrue(first.startswith("0||"), "shard 1 is done")
        self.assertTrue(second.startswith("2||"))
        self.assertIn("--array=0-0 --time=60", first)
        self.assertTrue(merge.startswith("|yes|"))
        self.assertIn("--dependency=afterany:1:2 --time=60", merge)

    def test_slurm_without_arrays_is_refused_in_one_line(self):
        self.plan()
        self.put_command("scontrol", "echo 'MaxArraySize            = 0'\n")
        result = self.run_command(root / "slurm/umbrameter-slurm", "plan", "out")
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stderr.count("\n"), 1)
        self.assertIn("MaxArraySize is 0", result.stderr)

    def test_kubernetes_gives_each_index_its_shard(self):
        self.plan()
        job = yaml.safe_load((root / "kubernetes/job.yaml").read_text())
        self.assertEqual(job["spec"]["completionMode"], "Indexed")
        command = job["spec"]["template"]["spec"]["containers"][0]["command"]
        words = [word.replace("/data/plan", "plan") for word in command]
        self.assertEqual(self.run_command(*words, JOB_COMPLETION_INDEX="2").returncode, 0)
        self.assertEqual(self.status()["done"], [2])

    def test_aws_batch_submits_an_array_of_the_missing_shards_and_a_merge_after_it(self):
        self.plan()
        self.run_command("umbrameter", "run", "plan", "--shard", "0")
        self.put_command("aws", 'printf "%s\\n" "$*" >> log; echo job-1\n')
        result = self.run_command(root / "aws-batch/submit", "plan", "out", "queue", "definition")
        self.assertEqual(result.returncode, 0, result.stderr)
        array, merge = (self.folder / "log").read_text().splitlines()
        self.assertIn("--array-properties size=2", array)
        overrides = json.loads(array.split("--container-overrides ")[1])
        self.assertEqual(overrides["environment"], [{"name": "UMBRAMETER_SHARDS", "value": "1-2"}])
        self.assertIn("--depends-on jobId=job-1", merge)
        variables = {each["name"]: each["value"] for each in overrides["environment"]}
        self.run_command(*overrides["command"], AWS_BATCH_JOB_ARRAY_INDEX="1", **variables)
        self.assertEqual(self.status()["done"], [0, 2])

    def submit_missing(self, shards):
        self.put_command("umbrameter", f"for k in {shards}; do echo umbrameter run plan --shard $k; done\n")
        self.put_command("aws", 'printf "%s\n" "$*" >> log; echo job-1\n')
        return self.run_command(root / "aws-batch/submit", "plan", "out", "queue", "definition")

    def test_aws_batch_takes_at_most_ten_thousand_shards_and_a_list_that_fits(self):
        for shards, why in (("{0..10000}", "10001 shards are to run"), ("{0..8000..2}", "longer than AWS Batch takes")):
            result = self.submit_missing(shards)
            self.assertEqual(result.returncode, 2)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            self.assertIn(why, result.stderr)
        self.assertFalse((self.folder / "log").exists(), "nothing is submitted")
        self.assertEqual(self.submit_missing("{0..9998} 10001").returncode, 0)
        self.assertIn('"value":"0-9998,10001"', (self.folder / "log").read_text())


if __name__ == "__main__":
    devices = json.loads(subprocess.run([program, "info", "--json"], capture_output=True, check=True).stdout)["gl_devices"]
    if not devices:
        print("skipped: no OpenGL driver")
        sys.exit(77)
    unittest.main()
