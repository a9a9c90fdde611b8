"""A sweep of a bias of an engine in a browser that is killed half way: the axis that it must show, and replies that fit the schema."""
import csv
import importlib.util
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

root, program, engine = Path(sys.argv[1]), sys.argv[2], sys.argv[3]
if not (root / "engines" / engine / "node_modules").is_dir():
    print(f"not set up: run engines/{engine}/setup")
    sys.exit(77)
# From no bias, which gives acne, to one that loses the shadows.
cells = 6
axis = {"threejs": "engine.bias=-0.2:0", "babylon": "engine.bias=0:1", "playcanvas": "engine.shadow-bias=0:1",
        "filament": "engine.constant-bias=0:1"}[engine] + f":{cells}"

adapter = str(root / "engines" / engine / "adapter")
if importlib.util.find_spec("jsonschema"):
    words = [sys.executable, "-B", Path(__file__).with_name("held_adapter.py"), root / "engines/protocol.schema.json", adapter]
    adapter = " ".join(f"'{word}'" for word in words)


def children(pid):
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                status = (entry / "stat").read_text().rsplit(")", 1)[1].split()
                if int(status[1]) == pid:
                    yield int(entry.name)
                    yield from children(int(entry.name))
            except (OSError, IndexError):
                pass


def kill_browser(pid, folder, killed):
    """Once the first cell has been drawn."""
    for _ in range(20000):
        time.sleep(0.01)
        if not any(any(Path(folder).glob(f"umbrameter-engine-*/frames/*-{output}.pfm")) for output in ("visibility", "lit")):
            continue
        for child in children(pid):
            try:
                if "chrom" in Path(f"/proc/{child}/cmdline").read_text().split("\0")[0]:
                    os.kill(child, signal.SIGKILL)
                    killed.set()
            except OSError:
                pass
        return


with tempfile.TemporaryDirectory() as folder:
    command = [program, "sweep", "two-occluders", "--engine", adapter, "--light", "sun", "--size",
               "192x108", "--vary", axis, "--no-figures", "--no-cache", "-o", folder + "/out"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               env={**os.environ, "TMPDIR": folder})
    killed = threading.Event()
    threading.Thread(target=kill_browser, args=(process.pid, folder, killed), daemon=True).start()
    out, err = process.communicate(timeout=230)
    assert process.returncode == 0, err
    assert killed.is_set()
    assert "was started again" in err, err
    rows = list(csv.DictReader(open(folder + "/out/sweep.csv", encoding="utf-8")))
    assert len(rows) == cells, len(rows)
    acne = [float(row["acne"]) for row in rows]
    leak = [float(row["peter_panning"]) + float(row["leak"]) for row in rows]
    by_bias = sorted(zip((abs(float(next(iter(row.values())))) for row in rows), acne, leak))
    # A larger bias has less acne and loses more of the shadow; engines differ in how much.
    assert by_bias[0][1] > by_bias[-1][1], by_bias
    assert by_bias[0][2] < by_bias[-1][2], by_bias
    print(f"{engine}: acne {by_bias[0][1]:.4f} to {by_bias[-1][1]:.4f}, too bright {by_bias[0][2]:.4f} to {by_bias[-1][2]:.4f}")
