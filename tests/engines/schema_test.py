"""The replies of our own adapter, of the example and of those that are set up fit engines/protocol.schema.json."""
import json
import subprocess
import sys
from pathlib import Path

try:
    from jsonschema import Draft202012Validator
except ImportError:
    print("python3-jsonschema is missing")
    sys.exit(77)

root, program = Path(sys.argv[1]), sys.argv[2]
schema = json.loads((root / "engines/protocol.schema.json").read_text())
Draft202012Validator.check_schema(schema)
commands = {"umbrameter": [program, "engine", "serve"], "example": [root / "engines/example/adapter"]}
for engine in ("threejs", "babylon", "playcanvas", "filament"):
    if (root / "engines" / engine / "node_modules").is_dir():
        commands[engine] = [root / "engines" / engine / "adapter"]
for name, command in commands.items():
    requests = [{"id": 1, "request": "describe", "protocol": 1}, {"id": 2, "request": "render", "outputs": ["visibility"], "frames": [{}]}]
    # As a caller does, stdin stays open until the replies are there: an adapter ends soon after it is closed.
    with subprocess.Popen([str(word) for word in command], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as adapter:
        adapter.stdin.write("".join(json.dumps(request) + "\n" for request in requests))
        adapter.stdin.flush()
        description, refusal = (json.loads(adapter.stdout.readline()) for _ in requests)
        adapter.stdin.close()
        assert adapter.wait(timeout=30) == 0, name
    for reply, kind in ((description, "describe"), (refusal, "error")):
        one = {"$ref": f"#/$defs/{kind}", "$defs": schema["$defs"]}
        errors = [error.message for error in Draft202012Validator(one).iter_errors(reply)]
        assert not errors, f"{name}, {kind}: {errors[0]}"
    assert refusal["id"] == 2, name
    names = [parameter["name"] for parameter in description["parameters"]]
    assert len(names) == len(set(names)), name
    print(f"{name}: {len(names)} parameters")
