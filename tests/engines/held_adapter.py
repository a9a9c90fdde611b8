"""Stands before an adapter, passes requests on, and fails at a reply that does not fit engines/protocol.schema.json.

usage: held_adapter.py SCHEMA ADAPTER [ARGUMENTS]
"""
import json
import subprocess
import sys
from pathlib import Path

from jsonschema import Draft202012Validator

schema = json.loads(Path(sys.argv[1]).read_text())
Draft202012Validator.check_schema(schema)
with subprocess.Popen(sys.argv[2:], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1) as adapter:
    for request in sys.stdin:
        adapter.stdin.write(request)
        answer = adapter.stdout.readline()
        if answer == "":  # it has ended
            break
        reply = json.loads(answer)
        kind = "error" if "error" in reply else json.loads(request)["request"]
        one = {"$ref": f"#/$defs/{kind}", "$defs": schema["$defs"]}
        for error in Draft202012Validator(one).iter_errors(reply):
            adapter.kill()
            sys.exit(f"the reply to '{kind}' does not fit the schema: {error.message}")
        sys.stdout.write(answer)
        sys.stdout.flush()
    adapter.stdin.close()
    sys.exit(adapter.wait())
