"""Inside Blender: answers the requests of the engine protocol. Started by adapter, with two descriptors after `--`."""
import json
import math
import os
import sys
import time
from pathlib import Path

import bpy
import mathutils
import numpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
import glb  # noqa: E402
import images  # noqa: E402
import parameters  # noqa: E402

LIGHTS = {"directional": "SUN", "spot": "SPOT", "point": "POINT"}
OUTPUTS = ["visibility", "ao", "position"]


def one_line(text):
    return " ".join(str(text).split())


class Renderer:
    light = None

    def load(self, request):
        self.light = None  # until everything is there
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.width, self.height = request["width"], request["height"]
        self.folder = Path(request["folder"])
        self.scene = bpy.context.scene
        self.set_up_passes()
        bounds = request["bounds"]
        extent = max(abs(value) for corner in (bounds["min"], bounds["max"]) for value in corner)
        self.quantum = 2.0 ** math.ceil(math.log2(max(extent, 1e-30) / 1024))
        file = glb.Glb(request["scene"])
        file.build(self.scene.collection, self.quantum)
        self.add_camera(request["camera"])
        light = self.make_light(request["light"])
        self.light = light
        return {"warnings": sorted(file.warnings)} if file.warnings else {}

    def set_up_passes(self):
        scene, render = self.scene, self.scene.render
        render.engine = "BLENDER_EEVEE"
        render.resolution_x, render.resolution_y, render.resolution_percentage = self.width, self.height, 100
        render.filter_size = 0  # each sample at the pixel's centre
        render.dither_intensity = 0
        render.film_transparent = True
        render.use_file_extension = False
        render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
        render.image_settings.color_depth = "32"
        render.image_settings.exr_codec = "NONE"
        scene.view_settings.view_transform = "Raw"
        scene.world = bpy.data.worlds.new("dark")
        scene.world.use_nodes = False
        scene.world.color = (0, 0, 0)
        layer = scene.view_layers[0]
        layer.use_pass_shadow = layer.use_pass_ambient_occlusion = True
        for name in ("whole", "rest"):
            output = layer.aovs.add()
            output.name, output.type = name, "COLOR"

    def add_camera(self, source):
        camera = bpy.data.cameras.new("camera")
        camera.sensor_fit = "VERTICAL"
        if source["kind"] == "orthographic":
            camera.type = "ORTHO"
            camera.ortho_scale = 2 * source["half_height"]
        else:
            camera.lens = camera.sensor_height / 2 / math.tan(source["vertical_fov"] / 2)
        camera.clip_start, camera.clip_end = source["near"], source["far"]
        placed = bpy.data.objects.new("camera", camera)
        placed.matrix_world = glb.matrix(source["world_from_camera"])
        self.scene.collection.objects.link(placed)
        self.scene.camera = placed

    def make_light(self, source):
        light = bpy.data.lights.new("light", LIGHTS[source["kind"]])
        light.color = source["color"]
        light.use_shadow = True
        light.specular_factor = 0
        light.energy = source["intensity"]  # of a sun: W/m²
        placed = bpy.data.objects.new("light", light)
        if source["kind"] != "directional":
            light.energy *= 4 * math.pi  # W of a lamp that shines into all directions
            if source.get("range", 0) > 0:
                light.use_custom_distance = True
                light.cutoff_distance = source["range"]
            placed.location = source["position"]
        if source["kind"] == "spot":
            inner, outer = math.cos(source["inner_cone"]), math.cos(source["outer_cone"])
            light.spot_size = 2 * source["outer_cone"]
            light.spot_blend = (inner - outer) / (1 - outer)
        if source["kind"] != "point":
            placed.rotation_euler = (-mathutils.Vector(source["direction"])).to_track_quat("Z", "Y").to_euler()
        self.scene.collection.objects.link(placed)
        return light

    def draw(self, values, result):
        """The passes of one frame, and its milliseconds."""
        self.scene.eevee.use_gtao = result == "ao"
        parameters.apply(values, result, {"eevee": self.scene.eevee, "light": self.light})
        path = self.folder / "passes.exr"
        self.scene.render.filepath = str(path)
        start = time.perf_counter()
        bpy.ops.render.render(write_still=True)
        milliseconds = 1000 * (time.perf_counter() - start)
        try:
            return images.read_passes(path), milliseconds
        finally:
            path.unlink()

    def render(self, outputs, values):
        """The images by output, and the milliseconds."""
        wanted, spent = {}, 0.0
        for result, output, channel in (("shadow", "visibility", "Shadow.R"), ("ao", "ao", "AO.R")):
            if output not in outputs and (result == "ao" or "ao" in outputs):
                continue
            passes, milliseconds = self.draw(values, result)
            spent += milliseconds
            wanted[output] = passes[channel]
        whole, rest = (numpy.stack([passes[f"{name}.{axis}"] for axis in "RGB"], -1).astype(numpy.float64)
                       for name in ("whole", "rest"))
        position = (numpy.rint(whole) + rest) * self.quantum
        position[passes["Combined.A"] == 0] = numpy.nan
        wanted["position"] = position
        return {output: wanted[output] for output in outputs}, spent


class Adapter:
    def __init__(self):
        self.renderer = Renderer()

    def describe(self, request):
        return {"protocol": 1, "name": "Blender EEVEE", "version": bpy.app.version_string, "outputs": OUTPUTS,
                "lights": list(LIGHTS), "cameras": ["perspective", "orthographic"],
                "parameters": parameters.descriptions()}

    def load(self, request):
        return self.renderer.load(request)

    def render(self, request):
        if self.renderer.light is None:
            raise ValueError("no scene is loaded")
        unknown = [output for output in request["outputs"] if output not in OUTPUTS]
        if unknown:
            raise ValueError(f"there is no output '{unknown[0]}'")
        frames = []
        for number, values in enumerate(request["frames"]):
            drawn, milliseconds = self.renderer.render(request["outputs"], values)
            files = {output: f"{number}-{output}.pfm" for output in drawn}
            for output, name in files.items():
                images.write_pfm(self.renderer.folder / name, drawn[output])
            frames.append({"files": files, "milliseconds": milliseconds})
        return {"frames": frames}

    def serve(self, requests, replies):
        for line in requests:
            request = json.loads(line)
            try:
                answer = {"describe": self.describe, "load": self.load, "render": self.render}[request["request"]](request)
            except Exception as error:  # one line for whatever fails; the adapter goes on
                answer = {"error": one_line(f"{type(error).__name__}: {error}")}
            print(json.dumps({"id": request["id"], **answer}), file=replies, flush=True)


if __name__ == "__main__":
    first, second = (int(word) for word in sys.argv[sys.argv.index("--") + 1 :])
    Adapter().serve(os.fdopen(first, encoding="utf-8"), os.fdopen(second, "w", encoding="utf-8"))
    os._exit(0)  # Blender would free its memory first
