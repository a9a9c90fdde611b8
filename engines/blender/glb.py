"""Reads a .glb that Umbrameter wrote, and builds its meshes and materials in Blender, in the file's own coordinates.

Blender's Z up is a custom of its user interface: EEVEE draws a scene whose Y points up just as well.
"""
import json
import math
import os
import struct
import tempfile
from pathlib import Path

import bpy
import mathutils
import numpy

IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
CLAMP, MIRRORED = 33071, 33648


def matrix(values):
    """From a glTF matrix: 16 numbers, column by column."""
    return mathutils.Matrix([values[row::4] for row in range(4)])


class Glb:
    def __init__(self, path):
        data = Path(path).read_bytes()
        length = struct.unpack_from("<I", data, 12)[0]
        self.json = json.loads(data[20 : 20 + length])
        self.binary = data[28 + length :]
        self.warnings = set()

    def bytes(self, index):
        view = self.json["bufferViews"][index]
        start = view.get("byteOffset", 0)
        return self.binary[start : start + view["byteLength"]]

    def numbers(self, index):
        accessor = self.json["accessors"][index]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[accessor["type"]]
        kind = {5123: "<u2", 5125: "<u4", 5126: "<f4"}[accessor["componentType"]]
        flat = numpy.frombuffer(self.bytes(accessor["bufferView"]), kind, width * accessor["count"])
        return flat.reshape(-1, width) if width > 1 else flat

    def build(self, collection, quantum):
        """Adds all objects; `quantum` as in make_material."""
        materials = [self.make_material(source, quantum) for source in self.json.get("materials", [])]
        meshes = {}
        for node in self.json["nodes"]:
            if "mesh" not in node:
                continue
            place = matrix(node.get("matrix", IDENTITY))
            location, rotation, scale = place.decompose()
            rebuilt = mathutils.Matrix.LocRotScale(location, rotation, scale)
            size = max(abs(value) for row in place for value in row)
            is_sheared = any(abs(rebuilt[r][c] - place[r][c]) > 1e-6 * size for r in range(4) for c in range(4))
            for number, primitive in enumerate(self.json["meshes"][node["mesh"]]["primitives"]):
                if is_sheared:  # An object of Blender has no shear, so that its vertices take it.
                    mesh = self.make_mesh(primitive, materials, place)
                else:
                    key = (node["mesh"], number)
                    if key not in meshes:
                        meshes[key] = self.make_mesh(primitive, materials)
                    mesh = meshes[key]
                placed = bpy.data.objects.new(mesh.name, mesh)
                if not is_sheared:
                    placed.matrix_world = place
                collection.objects.link(placed)

    def make_mesh(self, primitive, materials, place=None):
        attributes = primitive["attributes"]
        points = self.numbers(attributes["POSITION"]).astype(numpy.float64)
        corners = self.numbers(primitive["indices"]).astype(numpy.int32).reshape(-1, 3)
        normals = self.numbers(attributes["NORMAL"]).astype(numpy.float64) if "NORMAL" in attributes else None
        if place is not None:
            linear = numpy.array(place)[:3, :3]
            points = points @ linear.T + numpy.array(place)[:3, 3]
            if normals is not None:
                cofactors = numpy.array(mathutils.Matrix(linear.tolist()).adjugated()).T
                normals = normals @ cofactors.T * numpy.sign(numpy.linalg.det(linear))
            if numpy.linalg.det(linear) < 0:
                corners = corners[:, ::-1]
        is_whole = (corners[:, 0] != corners[:, 1]) & (corners[:, 1] != corners[:, 2]) & (corners[:, 2] != corners[:, 0])
        corners = corners[is_whole].copy()

        mesh = bpy.data.meshes.new("mesh")
        mesh.vertices.add(len(points))
        mesh.vertices.foreach_set("co", points.astype(numpy.float32).ravel())
        mesh.loops.add(corners.size)
        mesh.loops.foreach_set("vertex_index", corners.ravel())
        mesh.polygons.add(len(corners))
        mesh.polygons.foreach_set("loop_start", numpy.arange(0, corners.size, 3, dtype=numpy.int32))
        mesh.polygons.foreach_set("loop_total", numpy.full(len(corners), 3, dtype=numpy.int32))
        if "TEXCOORD_0" in attributes:
            uv = self.numbers(attributes["TEXCOORD_0"])[corners.ravel()].astype(numpy.float32)
            uv[:, 1] = 1 - uv[:, 1]  # Blender's images begin at the bottom.
            mesh.uv_layers.new(name="uv").data.foreach_set("uv", uv.ravel())
        mesh.update(calc_edges=True)
        if normals is not None and len(corners) > 0:
            mesh.polygons.foreach_set("use_smooth", numpy.ones(len(corners), dtype=bool))
            mesh.use_auto_smooth = True
            mesh.auto_smooth_angle = math.pi
            lengths = numpy.linalg.norm(normals, axis=1, keepdims=True)
            mesh.normals_split_custom_set_from_vertices((normals / numpy.where(lengths > 0, lengths, 1)).tolist())
        mesh.materials.append(materials[primitive["material"]])
        return mesh

    def make_material(self, source, quantum):
        """White and matte, with the alpha mask. Writes the position in units of `quantum` to two more passes.

        EEVEE's passes have 16 bits: the whole part goes to `whole`, the rest to `rest`, 22 bits together.
        """
        material = bpy.data.materials.new(source.get("name", "material"))
        material.use_nodes = True
        material.use_backface_culling = not source.get("doubleSided", False)
        nodes, links = material.node_tree.nodes, material.node_tree.links
        nodes.clear()
        surface = nodes.new("ShaderNodeBsdfDiffuse")
        surface.inputs["Color"].default_value = (1, 1, 1, 1)
        surface = surface.outputs[0]
        if source.get("alphaMode") == "MASK":
            mask = self.make_mask(nodes, links, source)
            mix = nodes.new("ShaderNodeMixShader")
            links.new(mask, mix.inputs[0])
            links.new(nodes.new("ShaderNodeBsdfTransparent").outputs[0], mix.inputs[1])
            links.new(surface, mix.inputs[2])
            surface = mix.outputs[0]
            material.blend_method = material.shadow_method = "CLIP"
            material.alpha_threshold = 0.5
        links.new(surface, nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])

        def combined(operation, first, second):
            node = nodes.new("ShaderNodeVectorMath")
            node.operation = operation
            links.new(first, node.inputs[0])
            if isinstance(second, float):
                node.inputs[1].default_value = (second,) * 3
            elif second is not None:
                links.new(second, node.inputs[1])
            return node.outputs[0]

        units = combined("DIVIDE", nodes.new("ShaderNodeNewGeometry").outputs["Position"], quantum)
        whole = combined("FLOOR", combined("ADD", units, 0.5), None)
        for name, value in (("whole", whole), ("rest", combined("SUBTRACT", units, whole))):
            output = nodes.new("ShaderNodeOutputAOV")
            output.name = name
            links.new(value, output.inputs["Color"])
        return material

    def make_mask(self, nodes, links, source):
        """1 where the surface is, 0 in its holes."""
        surface = source.get("pbrMetallicRoughness", {})
        factor = surface.get("baseColorFactor", [1, 1, 1, 1])[3]
        alpha = nodes.new("ShaderNodeMath")
        alpha.operation = "MULTIPLY"
        alpha.inputs[0].default_value = alpha.inputs[1].default_value = factor
        if "baseColorTexture" in surface:
            texture = self.json["textures"][surface["baseColorTexture"]["index"]]
            sampler = self.json["samplers"][texture["sampler"]] if "sampler" in texture else {}
            image = nodes.new("ShaderNodeTexImage")
            image.image = self.load_image(self.json["images"][texture["source"]])
            image.extension = "EXTEND" if sampler.get("wrapS") == CLAMP else "REPEAT"
            if MIRRORED in (sampler.get("wrapS"), sampler.get("wrapT")):
                self.warnings.add("mirrored textures are repeated")
            image.interpolation = "Closest" if sampler.get("magFilter") == 9728 else "Linear"
            links.new(image.outputs["Alpha"], alpha.inputs[0])
        else:
            alpha.inputs[0].default_value = 1
        # At the cutoff itself the surface is there.
        above = nodes.new("ShaderNodeMath")
        above.operation = "SUBTRACT"
        above.inputs[0].default_value = 1
        below = nodes.new("ShaderNodeMath")
        below.operation = "LESS_THAN"
        below.inputs[1].default_value = source.get("alphaCutoff", 0.5)
        links.new(alpha.outputs[0], below.inputs[0])
        links.new(below.outputs[0], above.inputs[1])
        return above.outputs[0]

    def load_image(self, source):
        handle, path = tempfile.mkstemp(suffix=".png" if source.get("mimeType") == "image/png" else ".jpg")
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(self.bytes(source["bufferView"]))
            image = bpy.data.images.load(path)
            image.colorspace_settings.name = "Non-Color"
            image.alpha_mode = "CHANNEL_PACKED"
            image.pack()
        finally:
            os.unlink(path)
        return image
