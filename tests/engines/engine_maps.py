"""Where engines lay the shadow maps of suns, and the same maps in our parameters."""
import json
import math
import struct
from dataclasses import dataclass

aspect = 480 / 270


@dataclass
class Scene:
    name: str
    file: str             # the name, or a file whose sun is turned
    low: list
    high: list
    camera: dict
    sun: dict             # right, up and forward: the axes of the engine's map

    @property
    def center(self):
        return [(a + b) / 2 for a, b in zip(self.low, self.high)]

    @property
    def radius(self):
        return math.dist(self.low, self.high) / 2


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def area(center, size, resolution):
    place = [flag for axis, value in zip("xyz", center) for flag in (f"--shadow.fit-{axis}", f"{value:.8g}")]
    return ["--shadow.fit", "bounds", *place, "--shadow.fit-size", f"{size:.8g}", "--shadow.resolution", str(resolution)]


def threejs(kind):
    """The adapter's shadow-camera fit: the sphere around the bounds, near 0, far its diameter."""
    def setting(scene):
        flags = ["--engine.type", kind, "--engine.map-size", "2048"]
        return flags, area(scene.center, 2 * scene.radius, 2048), lambda bias: f"{-bias * 2 * scene.radius:.6g}"
    return setting


def babylon(share, *more, depth_format="16f"):
    """A square of shadow-frustum-size around the light, which the adapter puts one radius before the bounds' centre."""
    def setting(scene):
        size = f"{2 * scene.radius:.8g}"
        flags = ["--engine.map-size", "2048", "--engine.shadow-frustum-size", size, "--engine.shadow-min-z", "0.001",
                 "--engine.shadow-max-z", size]
        ours = area(scene.center, 2 * scene.radius, 2048)
        return ([*flags, *more], [*ours, "--shadow.fit-depth", size, "--shadow.depth-format", depth_format],
                lambda bias: f"{share * bias * 2 * scene.radius:.6g}")
    return setting


def playcanvas(kind):
    """The sphere around the frustum up to shadow-distance, about the mean of its corners, moved in steps of two texels."""
    def setting(scene):
        distance, resolution = {"courtyard": (40, 2048), "city": (200, 4096), "room": (8, 2048)}[scene.name]
        near = scene.camera["near_m"]
        diagonal = math.tan(math.radians(scene.camera["vertical_fov_deg"]) / 2) * math.hypot(aspect, 1)
        middle = (near + distance) / 2
        radius = math.hypot(diagonal * distance, distance - middle)
        center = [a + b * middle for a, b in zip(scene.camera["position_m"], scene.camera["direction"])]
        step = 4 * radius / resolution
        along = dot(center, scene.sun["forward"])
        up, right = (step * math.ceil(dot(center, scene.sun[axis]) / step) for axis in ("up", "right"))
        center = [u * up + r * right + f * along
                  for u, r, f in zip(scene.sun["up"], scene.sun["right"], scene.sun["forward"])]
        flags = ["--engine.shadow-type", kind, "--engine.shadow-resolution", str(resolution),
                 "--engine.shadow-distance", str(distance)]
        return flags, area(center, 2 * radius, resolution), lambda bias: f"{10 * bias:.6g}"
    return setting


def filament(scene):
    """A stable map: the sphere of shadowFar around the camera. A border of one texel is not drawn."""
    distance, resolution = {"courtyard": (40, 2048), "city": (200, 2048), "room": (8, 1024)}[scene.name]
    flags = ["--engine.stable", "true", "--engine.shadow-far", str(distance), "--engine.map-size", str(resolution)]
    return flags, area(scene.camera["position_m"], 2 * distance, resolution - 2), "{:.6g}".format


def filament_by_default(scene):
    """A warped map, which the preset fits."""
    return [], [], "{:.6g}".format


def axes_in_playcanvas(forward, _):
    """Right and up of a light that its adapter turns by the shortest rotation from -Y to the direction."""
    # Rodrigues' formula for the x axis: v + k × v + k × (k × v) / (1 + c), k = (-y) × forward, c = (-y) · forward.
    axis = cross([0, -1, 0], forward)
    once = cross(axis, [1, 0, 0])
    right = [x + a + b / (1 - forward[1]) for x, a, b in zip([1, 0, 0], once, cross(axis, once))]
    return right, cross(right, forward)


def axes_in_filament(forward, camera):
    """Right and up of a map whose vertical is the camera's right, as far as it lies across the light."""
    across = cross(camera["direction"], [0, 1, 0])
    up = [a - dot(across, forward) * f for a, f in zip(across, forward)]
    up = [a / math.hypot(*up) for a in up]
    return cross(forward, up), up


map_axes = {"playcanvas": axes_in_playcanvas, "filament": axes_in_filament}


def turned(file, axes_of, camera):
    """Turns sun and spot lights about their axes, so that our maps, which are aligned with them, lie as the engine's;
    gives the sun's axes."""
    sun = {}
    data = file.read_bytes()
    length = struct.unpack("<I", data[12:16])[0]
    document = json.loads(data[20:20 + length])
    lights = document["extensions"]["KHR_lights_punctual"]["lights"]
    for node in document["nodes"]:
        light = node.get("extensions", {}).get("KHR_lights_punctual")
        if light is None or lights[light["light"]]["type"] == "point":
            continue
        forward = [-x for x in node["matrix"][8:11]]
        right, up = axes_of(forward, camera)
        node["matrix"][:12] = [*right, 0, *up, 0, *(-x for x in forward), 0]
        if lights[light["light"]]["name"] == "sun":
            sun = {"right": right, "up": up, "forward": forward}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + length:]
    file.write_bytes(struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(rest)) +
                     struct.pack("<I4s", len(text), b"JSON") + text + rest)
    return sun
