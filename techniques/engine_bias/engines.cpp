// One entry for each engine. Each formula is the engine's own, from the source that the entry names; t is the size of a
// texel, R the depth range of the map, d the depth at a spot or point light, θ the angle between normal and light.
#include <algorithm>

#include "techniques/engine_bias/engine.h"

namespace umbrameter {
namespace {

using Place = MapPlace;
using Settings = BiasSettings;
using Result = std::optional<double>;

constexpr double no_limit = std::numeric_limits<double>::infinity();
constexpr double sqrt_2 = 1.41421356237309505;

bool is_sun(const Place& place) { return place.light == LightKind::directional; }

// A light other than a directional one has no formula here.
Result of_sun(const Place& place, double metres) { return is_sun(place) ? Result(metres) : std::nullopt; }

Result unless_point(const Place& place, double metres) {
  return place.light == LightKind::point ? std::nullopt : Result(metres);
}

// One unit of the depth, 0 to 1, of a camera with these planes: orthographic, or perspective at the depth d; 0 where d
// is outside, or the planes are in the wrong order.
double metres_of_depth(const Place& place, double near, double far) {
  if (place.is_range_given) return place.range;
  if (!(near < far) || (!is_sun(place) && !(near <= place.depth && place.depth <= far))) return 0.0;
  return is_sun(place) ? far - near : place.depth * place.depth * (far - near) / (near * far);
}

BiasNumber with_value_of_point(double value, BiasNumber number) {
  number.value_of_point = value;
  return number;
}

Result one_metre(const Place&, const Settings&) { return 1.0; }
Result one_texel(const Place& place, const Settings&) { return place.texel; }
Result one_depth(const Place& place, const Settings&) { return place.range; }

// A cascade of Godot is a square around the sphere of its split, and starts pancake metres before it.
double godot_range(const Place& place, const Settings& settings) {
  const double pancake = settings["pancake"];
  return place.is_range_given || !(pancake > 0.0) ? place.range : place.texel * place.resolution + pancake;
}

std::vector<BiasEngine> neutral_units() {
  return {
      {.name = "metres",
       .title = "metres along the light",
       .source = "",
       .numbers = {{"bias", "m", no_default, BiasTerm::constant, one_metre, "1 m", ""}},
       .is_unit = true},
      {.name = "texels",
       .title = "texels of the map, along the light",
       .source = "",
       .numbers = {{"bias", "texels", no_default, BiasTerm::constant, one_texel, "t", ""}},
       .is_unit = true},
      {.name = "map-depth",
       .title = "share of the map's depth range",
       .source = "",
       .numbers = {{"bias", "of depth", no_default, BiasTerm::constant, one_depth, "R", ""}},
       .is_unit = true},
      {.name = "umbrameter",
       .title = "this program's own parameters",
       .source = "techniques/shadow/parameters.h",
       .numbers = {{"constant-bias", "m", no_default, BiasTerm::constant, one_metre, "1 m",
                    "--shadow.constant-bias {}"},
                   {.name = "normal-offset",
                    .unit = "texels × profile",
                    .term = BiasTerm::normal,
                    .per_unit = one_texel,
                    .formula = "t",
                    .code = "--shadow.normal-offset {}",
                    .offset = {OffsetProfile::sine},
                    .takes_any_offset = true},
                   {"polygon-offset-factor", "texels × slope", 0.0, BiasTerm::slope,
                    [](const Place&, const Settings&) -> Result { return 1.0; }, "1",
                    "--shadow.polygon-offset-factor {}"}},
       .is_unit = true,
       .comment = "#"},
  };
}

BiasEngine godot() {
  return {
      .name = "godot",
      .title = "Godot 4",
      .source =
          "light_storage.cpp @006f039 (update_light_buffers), renderer_scene_cull.cpp (bias_scale, "
          "shadow_texel_size, pancake_size), scene_forward_clustered.glsl (BIAS_FUNC), light_3d.cpp (steps)",
      .numbers = {{"shadow_bias",
                   "1",
                   0.1,
                   BiasTerm::constant,
                   [](const Place& p, const Settings& s) -> Result {
                     if (p.light == LightKind::point) return 1.0;
                     return of_sun(p, godot_range(p, s) / 100.0 * s["blur"] * s["quality"]);
                   },
                   "(t · resolution + pancake) · blur · quality / 100; of point lights: 1 m",
                   "light.shadow_bias = {}",
                   {},
                   -no_limit,
                   no_limit,
                   0.001},
                  {"shadow_normal_bias",
                   "texels",
                   2.0,
                   BiasTerm::normal,
                   [](const Place& p, const Settings&) { return of_sun(p, p.texel); },
                   "t",
                   "light.shadow_normal_bias = {}",
                   {OffsetProfile::constant, OffsetSide::receiver, OffsetDirection::across},
                   -no_limit,
                   no_limit,
                   0.001}},
      .settings = {{"blur", 1.0, "1", "shadow_blur of the light"},
                   {"quality",
                    2.0,
                    "1",
                    "soft_shadow_filter_quality; hard if light_angular_distance is above 0",
                    {{"hard", 1.0}, {"very-low", 1.5}, {"low", 2.0}, {"medium", 2.0}, {"high", 3.0}, {"ultra", 4.0}}},
                   {"pancake", 20.0, "m", "directional_shadow_pancake_size; 0: R is that of our map"}},
      .unverified =
          "Godot has not been run against these formulas; the values of high and ultra quality are from a copy "
          "of its source",
      .note_of_lamps = "a point light's shadow_normal_bias and spot lights have no formula here",
      .comment = "#"};
}

BiasEngine three() {
  return {
      .name = "three",
      .title = "three.js 0.187.0",
      .source =
          "npm three 0.187.0: shadowmap_pars_fragment.glsl.js, shadowmap_vertex.glsl.js, "
          "DirectionalLightShadow.js, examples/jsm/csm/CSM.js",
      .numbers = {{"bias", "of its depth range", 0.0, BiasTerm::constant,
                   [](const Place& p, const Settings& s) -> Result { return -metres_of_depth(p, s["near"], s["far"]); },
                   "−(far − near); of spot and point lights: −d² (far − near) / (near · far)",
                   "light.shadow.bias = {};"},
                  {"normalBias",
                   "m",
                   0.0,
                   BiasTerm::normal,
                   one_metre,
                   "1 m",
                   "light.shadow.normalBias = {};",
                   {.facing = OffsetFacing::front}}},
      .settings = {{"near", 0.5, "m", "shadow.camera.near"},
                   {"far", 500.0, "m", "shadow.camera.far; of a spot light its distance, if that is set"},
                   {.name = "shadowSide",
                    .value = static_cast<double>(CasterFaces::back),
                    .unit = "1",
                    .meaning = "of front-sided meshes; no part of the formula",
                    .choices = {{"double", 0.0}, {"front", 1.0}, {"back", 2.0}},
                    .is_faces = true}},
      .sets_each_cascade = true,
      .faces = CasterFaces::back,
      .adapter = "threejs"};
}

BiasEngine babylon() {
  return {
      .name = "babylon",
      .title = "Babylon.js 9.35.0",
      .source =
          "npm @babylonjs/core 9.35.0: shadowMapVertexMetric.js, shadowMapVertexNormalBias.js, "
          "shadowGenerator.js, directionalLight.pure.js",
      .numbers =
          {{"bias", "of its depth range", 5e-5, BiasTerm::constant,
            [](const Place& p, const Settings& s) -> Result {
              const double near = s["minZ"];
              const double far = s["maxZ"];
              if (s["filter"] == 1.0 && p.light == LightKind::point) return std::nullopt;
              if (s["filter"] == 1.0) return 0.5 * metres_of_depth(p, near, far);
              if (p.is_range_given) return p.range;
              return p.light == LightKind::point ? near + far : std::max(far - near, 0.0);
            },
            "maxZ − minZ; filter pcf: half of it, of spot lights d² (maxZ − minZ) / (2 minZ · maxZ) at depth d; of "
            "point lights minZ + maxZ",
            "shadowGenerator.bias = {};"},
           {"normalBias",
            "m × sin θ",
            0.0,
            BiasTerm::normal,
            one_metre,
            "1 m",
            "shadowGenerator.normalBias = {};",
            {OffsetProfile::sine, OffsetSide::caster}}},
      .settings = {{"filter", 0.0, "1", "none for all but pcf and contact hardening", {{"none", 0.0}, {"pcf", 1.0}}},
                   {"minZ", 1.0, "m", "the light's shadowMinZ, else the camera's minZ"},
                   {"maxZ", 10000.0, "m", "the light's shadowMaxZ, else the camera's maxZ"}},
      .faces = CasterFaces::front};
}

BiasEngine playcanvas() {
  return {.name = "playcanvas",
          .title = "PlayCanvas 2.23.3",
          .source =
              "npm playcanvas 2.23.3: scene/light.js, framework/components/light/component.js, "
              "lightFunctionShadow.js",
          .numbers = {{"shadowBias",
                       "1",
                       0.05,
                       BiasTerm::slope,
                       [](const Place& p, const Settings&) { return unless_point(p, 10.0); },
                       "10 texels × slope; of point lights: none",
                       "light.shadowBias = {};",
                       {},
                       0.0,
                       1.0},
                      {"normalOffsetBias",
                       "m",
                       0.0,
                       BiasTerm::normal,
                       [](const Place& p, const Settings&) { return unless_point(p, 1.0); },
                       "1 m",
                       "light.normalOffsetBias = {};",
                       {OffsetProfile::constant},
                       0.0,
                       1.0}},
          .note =
              "whatever its numbers, under a sun the receiver moves by 0.0001 R, with R the depth range of the map. "
              "shadowBias v also adds 10 v of the smallest depth steps; a PCSS map has no polygon offset. With a VSM "
              "map normalOffsetBias is multiplied by (1 − cos θ), and by the distance of a spot light",
          .units_per_factor = 1.0,
          .faces = CasterFaces::front,
          .constant_of_range = 0.0001};
}

// A texel of half a spot light's map at its range, at every depth. Cube faces are widened by a table of resolutions.
Result urp_texel(const Place& place, const Settings& settings) {
  if (!is_sun(place) && place.depth > settings["lightRange"]) return 0.0;  // the light does not reach it
  const double share = is_sun(place) ? 1.0 : settings["lightRange"] / (2.0 * place.depth);
  return unless_point(place, settings["soft"] * share * place.texel);
}
constexpr std::string_view urp_formula = "t · soft; of spot lights: t · soft · lightRange / (2 d)";

std::vector<BiasEngine> unity() {
  return {
      {.name = "unity-urp",
       .title = "Unity URP",
       .source =
           "ShadowUtils.cs @0070610 (GetShadowBias, RenderShadowSlice); limits: ValidateShadowBias of the pipeline "
           "asset",
       .numbers = {{.name = "shadowBias",
                    .unit = "texels",
                    .value = 1.0,
                    .per_unit = urp_texel,
                    .formula = urp_formula,
                    .code = "light.shadowBias = {}f;",
                    .min = 0.0,
                    .max = 10.0},
                   {"shadowNormalBias",
                    "texels × (1 − cos θ)",
                    1.0,
                    BiasTerm::normal,
                    urp_texel,
                    urp_formula,
                    "light.shadowNormalBias = {}f;",
                    {OffsetProfile::one_minus_cosine, OffsetSide::caster},
                    0.0,
                    10.0}},
       .settings = {{"soft",
                     1.0,
                     "1",
                     "quality of soft shadows; off for hard ones",
                     {{"off", 1.0}, {"low", 1.5}, {"medium", 2.5}, {"high", 3.5}}},
                    {"lightRange", 10.0, "m", "range of a spot light, by default the file's, or 10 m", {}, true}},
       .note =
           "in addition every caster is drawn with polygon offset factor 2.5, units 1. The light's numbers are read "
           "only if its bias is set to Custom, else those of the pipeline asset",
       .unverified = "(1 − cos θ) of ApplyShadowBias is from copies of Shadows.hlsl, not from Unity's own source",
       .note_of_lamps = "point lights are not converted; the preset unity-urp-point has their formula",
       .polygon_factor = 2.5,
       .polygon_units = 1.0},
      {.name = "unity-hdrp",
       .title = "Unity HDRP",
       .source = "HDShadowAlgorithms.hlsl (EvalShadow_NormalBias), HDAdditionalLightData.cs "
                 "(SetCommonShadowRequestSettings), HDShadowUtils.cs (GetSlopeBias)",
       .numbers = {{"normalBias", "√2 texels", 0.75, BiasTerm::normal,
                    [](const Place& p, const Settings&) -> Result { return sqrt_2 * p.texel; }, "√2 t",
                    "hdLight.normalBias = {}f;"},
                   {"slopeBias", "5 texels × slope", 0.5, BiasTerm::slope,
                    [](const Place&, const Settings&) -> Result { return 5.0; }, "5 texels × slope",
                    "hdLight.slopeBias = {}f;"}},
       .note =
           "in addition every caster is drawn with polygon offset units 1, and receivers are compared with a bias of "
           "1/65536 of the depth; slopeBias counts 5 texels × slope, with filtering quality High more, up to 18, the "
           "larger the light",
       .note_of_lamps = "the errors of spot and point lights leave out the bias of 1/65536",
       .polygon_units = 1.0,
       .constant_of_range = 1.0 / 65536.0},
  };
}

std::vector<BiasEngine> other_engines() {
  return {
      {.name = "unreal",
       .title = "Unreal Engine, cascaded shadow maps",
       .source = "copies of ShadowRendering.cpp (FProjectedShadowInfo::UpdateShaderDepthBias) and of its console "
                 "variables",
       .numbers = {{"ShadowBias", "half texels × CSMDepthBias", 0.5, BiasTerm::constant,
                    [](const Place& p, const Settings& s) { return of_sun(p, 0.5 * s["CSMDepthBias"] * p.texel); },
                    "CSMDepthBias · t / 2", "LightComponent->SetShadowBias({}f);"}},
       .settings = {{"CSMDepthBias", 10.0, "half texels", "r.Shadow.CSMDepthBias"}},
       .note =
           "its slope term, r.Shadow.CSMSlopeScaleDepthBias × Shadow Slope Bias, and r.Shadow.CSMReceiverBias act in "
           "addition and are not included here; virtual shadow maps have other numbers",
       .unverified =
           "the formula and the default Shadow Bias of 0.5 are from copies of its source, not from Unreal's own"},
      {.name = "bevy",
       .title = "Bevy 0.20-dev",
       .source = "shadows.wesl @3f1f861, light.rs (factor √2), directional_light.rs",
       .numbers = {with_value_of_point(0.08, {"shadow_depth_bias", "m", 0.02, BiasTerm::constant, one_metre, "1 m",
                                              "shadow_depth_bias: {},"}),
                   with_value_of_point(0.6, {"shadow_normal_bias", "√2 texels", 1.8, BiasTerm::normal,
                                             [](const Place& p, const Settings&) -> Result { return sqrt_2 * p.texel; },
                                             "√2 t", "shadow_normal_bias: {},"})}},
      {.name = "filament",
       .title = "Filament",
       .source =
           "ShadowMap.cpp @0362f36 (constantBias), ShadowMapManager.cpp @003e500 (half a texel), common_shadowing.fs "
           "@376e69f, LightManager.cpp (limits)",
       .numbers = {{"constantBias",
                    "m",
                    0.001,
                    BiasTerm::constant,
                    one_metre,
                    "1 m",
                    "options.constantBias = {}f;",
                    {},
                    0.0,
                    2.0},
                   {"normalBias",
                    "half texels × sin θ",
                    1.0,
                    BiasTerm::normal,
                    [](const Place& p, const Settings&) { return of_sun(p, 0.5 * p.texel); },
                    "t / 2",
                    "options.normalBias = {}f;",
                    {OffsetProfile::sine},
                    0.0,
                    3.0},
                   {"polygonOffsetSlope", "texels × slope", 2.0, BiasTerm::slope,
                    [](const Place& p, const Settings&) { return of_sun(p, 1.0); }, "1",
                    "options.polygonOffsetSlope = {}f;"}},
       .note =
           "in addition every caster is drawn with polygon offset units 0.5; a VSM map ignores constantBias and "
           "normalBias; a map that is not `stable` is warped, with texels of other sizes; version 1.53.4 ignores the "
           "normalBias that you set and uses normalBias = 1 (half a texel) for every sun: to find a constantBias for "
           "this version, run compare with --shadow.normal-offset 0.5",
       .unverified = "the newest version, which scales normalBias by different factors along the map's x and y",
       .note_of_lamps =
           "normalBias and polygonOffsetSlope of spot and point lights have no formula here; a spot light's normalBias "
           "of 1 acts as 1.2 to 1.3 texels in 1.53.4",
       .polygon_units = 0.5,
       .faces = CasterFaces::front},
      {.name = "stride",
       .title = "Stride",
       .source = "ShadowMapReceiverBase.sdsl @3e83da5, LightShadowMap.cs (defaults)",
       .numbers = {{"DepthBias", "of the map's depth range", 0.01, BiasTerm::constant,
                    [](const Place& p, const Settings&) { return of_sun(p, p.range); }, "R",
                    "shadow.BiasParameters.DepthBias = {}f;"},
                   {"NormalOffsetScale",
                    "(2 m ÷ width of the shadow atlas in texels) × (1 − cos θ)",
                    10.0,
                    BiasTerm::normal,
                    [](const Place& p, const Settings& s) -> Result {
                      return is_sun(p) ? Result(2.0 / s["atlas"]) : std::nullopt;
                    },
                    "2 m ÷ width of the shadow atlas in texels",
                    "shadow.BiasParameters.NormalOffsetScale = {}f;",
                    {OffsetProfile::one_minus_cosine}}},
       .settings = {{"atlas", no_default, "texels", "side of the texture that holds all shadow maps"}}},
  };
}

}  // namespace

bool has_number(const BiasEngine& engine, BiasTerm term) {
  return std::ranges::any_of(engine.numbers, [&](const BiasNumber& number) { return number.term == term; });
}

const std::vector<BiasEngine>& bias_engines() {
  static const std::vector<BiasEngine> all = [] {
    std::vector<BiasEngine> engines = neutral_units();
    for (const BiasEngine& each : {godot(), three(), babylon(), playcanvas()}) engines.push_back(each);
    for (const auto& list : {unity(), other_engines(), engines_without_numbers()}) {
      engines.insert(engines.end(), list.begin(), list.end());
    }
    return engines;
  }();
  return all;
}

}  // namespace umbrameter
