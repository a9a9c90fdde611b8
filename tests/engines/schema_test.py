"""The replies of our own adapter and of the example fit engines/protocol.schema.json; sweep_test.py holds the others."""
import json
import subprocess
import sys
from pathlib import Path

try:
    import jsonschema  # noqa: F401
except ImportError:
    print("python3-jsonschema is missing")
    sys.exit(77)

root, program = Path(sys.argv[1]), sys.argv[2]
held = [sys.executable, "-B", Path(__file__).with_name("held_adapter.py"), root / "engines/protocol.schema.json"]
requests = [{"id": 1, "request": "describe", "protocol": 1}, {"id": 2, "request": "render", "outputs": ["visibility"], "frames": [{}]}]
for name, command in {"umbrameter": [program, "engine", "serve"], "example": [root / "engines/example/adapter"]}.items():
    lines = "".join(json.dumps(request) + "\n" for request in requests)
    done = subprocess.run([*held, *command], input=lines, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, f"{name}: {done.stderr}"
    description, refusal = map(json.loads, done.stdout.splitlines())
    assert refusal["id"] == 2 and "error" in refusal, name
    names = [parameter["name"] for parameter in description["parameters"]]
    assert len(names) == len(set(names)), name
    print(f"{name}: {len(names)} parameters")

# A reply that lacks what the schema asks for is noticed.
nameless = [sys.executable, "-c", "import sys; sys.stdin.readline(); print('{\"id\": 1, \"protocol\": 1}', flush=True)"]
done = subprocess.run([*held, *nameless], input=json.dumps(requests[0]) + "\n", capture_output=True, text=True, timeout=60)
assert done.returncode == 1 and "'name' is a required property" in done.stderr, done.stderr
