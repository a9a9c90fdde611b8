"""What can be set in EEVEE that changes its shadows or its ambient occlusion, under the names of Blender's Python API.

An entry is a parameter of the protocol, and `where`: the object and the property that it sets.
"""
import math

SIZES = ["64", "128", "256", "512", "1024", "2048", "4096"]


def described(where, kind, default, for_, meaning, name=None, **limits):
    name = name or where.split(".")[1].replace("_", "-")
    return {"name": name, "type": kind, "default": default, "for": for_, "meaning": meaning, "where": where, **limits}


def shadow(where, kind, default, meaning, **limits):
    return described(where, kind, default, "shadow", meaning, **limits)


def ao(where, kind, default, meaning, **limits):
    return described(where, kind, default, "ao", meaning, **limits)


LENGTH = {"min": 0, "max": 1e6, "unit": "m"}
SHARE = {"min": 0, "max": 1}

ALL = [
    shadow("eevee.shadow_cube_size", "choice", "512", "side of the cube maps of spot and point lights, texels", choices=SIZES),
    shadow("eevee.shadow_cascade_size", "choice", "1024", "side of each cascade of a sun, texels", choices=SIZES),
    shadow("eevee.use_shadow_high_bitdepth", "boolean", False, "32-bit instead of 16-bit shadow maps"),
    shadow("eevee.use_soft_shadows", "boolean", False, "jitter the light over its size in each sample; Blender's default: on"),
    shadow("eevee.light_threshold", "number", 0.01, "power per area below which a lamp without a range ends",
           min=0, max=1e6),
    shadow("eevee.taa_render_samples", "integer", 1, "samples per pixel, all at its centre; Blender's default: 64", min=1,
           max=4096),
    shadow("light.shadow_buffer_bias", "number", 1, "Bias of the light", min=0, max=1e6, bias="up"),
    shadow("light.shadow_buffer_clip_start", "number", 0.05, "where the maps of a spot or point light begin", min=1e-6,
           max=1e6, unit="m"),
    shadow("light.shadow_soft_size", "number", 0.25, "radius of a spot or point light", **LENGTH),
    shadow("light.angle", "number", 0.526, "angular diameter of a sun", min=0, max=180, unit="degrees"),
    shadow("light.use_contact_shadow", "boolean", False, "screen-space shadows near the caster"),
    shadow("light.contact_shadow_distance", "number", 0.2, "length of the ray of a contact shadow", min=0, max=9999, unit="m"),
    shadow("light.contact_shadow_bias", "number", 0.03, "Bias of contact shadows", min=0.001, max=9999),
    shadow("light.contact_shadow_thickness", "number", 0.2, "thickness of the casters of contact shadows", min=0, max=9999,
           unit="m"),
    shadow("light.shadow_cascade_count", "integer", 4, "cascades of a sun", min=1, max=4),
    shadow("light.shadow_cascade_exponent", "number", 0.8, "distribution of the cascades: 0 uniform, 1 logarithmic", **SHARE),
    shadow("light.shadow_cascade_max_distance", "number", 200, "where the cascades end, at most the camera's far plane",
           **LENGTH),
    shadow("light.shadow_cascade_fade", "number", 0.1, "share of a cascade that blends into the next", **SHARE),
    ao("eevee.gtao_distance", "number", 0.2, "distance of objects that occlude", min=0, max=1e5, unit="m"),
    ao("eevee.gtao_factor", "number", 1, "strength of the effect", min=0, max=1e6),
    ao("eevee.gtao_quality", "number", 0.25, "precision of the search for the horizon", **SHARE),
    ao("eevee.taa_render_samples", "integer", 8, "samples per pixel, all at its centre; Blender's default: 64",
       name="gtao-taa-render-samples", min=1, max=4096),
    ao("eevee.use_overscan", "boolean", False, "draw a margin around the image"),
    ao("eevee.overscan_size", "number", 3, "width of the margin, of the longer side", min=0, max=50, unit="%"),
]


def descriptions():
    return [{key: value for key, value in each.items() if key != "where"} for each in ALL]


def apply(values, for_, objects):
    """Sets everything but what belongs to the other result alone: the samples."""
    for each in ALL:
        owner, field = each["where"].split(".")
        target = objects[owner]
        # The cascades belong to suns alone, the radius to lamps.
        if not hasattr(target, field) or (field == "taa_render_samples" and each["for"] != for_):
            continue
        value = values[each["name"]]
        setattr(target, field, math.radians(value) if field == "angle" else value)
