#!/usr/bin/env python3
"""An engine adapter that does one thing wrong: hostile_adapter.py FAULT [STATE FILE]."""
import json
import os
import signal
import struct
import sys
import time

FAULT = sys.argv[1]
DESCRIPTION = {
    "protocol": 1, "name": "hostile", "version": "1", "outputs": ["visibility", "position"], "lights": ["directional"],
    "parameters": [{"name": "bias", "type": "number", "default": 0, "min": -1, "max": 1, "meaning": "bias"}],
}


def once():
    """True in the first process alone; the state file tells."""
    if os.path.exists(sys.argv[2]):
        return False
    open(sys.argv[2], "w").close()
    return True


def say(reply):
    print(json.dumps(reply), flush=True)


def pfm(path, width, height, value, channels):
    kind = b"PF" if channels == 3 else b"Pf"
    with open(path, "wb") as file:
        file.write(kind + b"\n%d %d\n-1.0\n" % (width, height) + struct.pack("<f", value) * (width * height * channels))


def render(request, load):
    folder, width, height = load["folder"], load["width"], load["height"]
    if FAULT == "crash" or (FAULT == "crash-once" and once()):
        print("out of texture memory", file=sys.stderr, flush=True)
        os.kill(os.getpid(), signal.SIGKILL)
    if FAULT == "silent":
        time.sleep(600)
    if FAULT == "refuse":
        return {"error": "the driver\nlost the device\x1b[31m"}
    frames = []
    for number, values in enumerate(request["frames"]):
        files = {}
        for output in request["outputs"]:
            name = f"{number}-{output}.pfm"
            path = os.path.join(folder, name)
            channels = 3 if output == "position" else 1
            if FAULT == "size":
                pfm(path, width + 1, height, 1.0, channels)
            elif FAULT == "nan":
                pfm(path, width, height, float("nan"), channels)
            elif FAULT == "range":
                pfm(path, width, height, 7.0, channels)
            elif FAULT == "traversal":
                name = "../scene.glb"
            elif FAULT == "absolute":
                name = "/etc/passwd"
            elif FAULT == "link":
                os.symlink("/etc/passwd", path)
            elif FAULT == "fifo":
                os.mkfifo(path)
            elif FAULT == "no-image":
                open(path, "w").write("not an image")
            elif FAULT != "missing":
                pfm(path, width, height, 0.5 + values["bias"] / 4, channels)
            files[output] = name
        frames.append({"files": files, "milliseconds": 1.5})
    if FAULT == "few":
        frames = frames[:-1]
    return {"frames": frames}


def main():
    load = None
    for line in sys.stdin:
        request = json.loads(line)
        kind = request["request"]
        if kind == "describe":
            if FAULT == "endless":
                while True:
                    sys.stdout.write("x" * 65536)
            if FAULT == "protocol":
                DESCRIPTION["protocol"] = 2
            if FAULT == "twins":
                DESCRIPTION["parameters"] *= 2
            if FAULT == "garbage":
                print("Loading shaders...", flush=True)
            if FAULT == "depth":
                DESCRIPTION.update(outputs=["visibility", "depth"], depth="window")
            reply = DESCRIPTION
        elif kind == "load":
            load = request
            reply = {"warnings": ["it has no cameras"]} if FAULT == "warn" else {}
        else:
            reply = render(request, load)
        say({"id": request["id"] + (1 if FAULT == "id" else 0), **reply})
    if FAULT == "stays":
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        time.sleep(600)


main()
