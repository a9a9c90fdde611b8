// The biases of every preset in its engine's numbers, and back: by the conversion of --from, --to and --for.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "experiments/measure/bias_terms.h"
#include "store/preset.h"
#include "techniques/shadow/cascades.h"

namespace umbrameter {
namespace {

constexpr double rounding = 1e-12;    // of doubles, relative
constexpr double of_a_preset = 1e-5;  // presets hold six digits

struct NoNumbers {
  const char* engine;  // of bias_engines()
  const char* why;
};
const std::map<std::string, NoNumbers> without_numbers = {
    {"bgfx", {"bgfx", "an example with a table for each kind of map"}},
    {"eevee", {"eevee", "its bias is automatic"}},
    {"playcanvas-pcf1-point", {"playcanvas", "shadowBias is no polygon offset there, but metres"}},
    {"unity-urp-point", {"unity-urp", "its faces are widened by a table of resolutions"}},
};

// Ground at depths of 1 to 40 m below a camera that looks along −z.
GBuffer seen_ground() {
  GBuffer gbuffer(40, 3);
  for (std::size_t i = 0; i < gbuffer.depth.size(); ++i) {
    const float depth = static_cast<float>(1 + i % 40);
    gbuffer.instance[i] = gbuffer.triangle[i] = 0;
    gbuffer.depth[i] = depth;
    gbuffer.position[i] = vec3(0.5f * depth * (static_cast<float>(i / 40) - 1.0f), 0, -depth);
    gbuffer.geometric_normal[i] = vec3(0, 1, 0);
  }
  return gbuffer;
}

dmat4 looking_down(const dvec3& position) {
  return {dvec4(1, 0, 0, 0), dvec4(0, 0, -1, 0), dvec4(0, 1, 0, 0), dvec4(position, 1)};
}

// A sun from above, or a lamp 5 m above the ground: URP's spot light has 30°.
Light light_of(const std::string& kind) {
  Light light;
  light.world_from_light = looking_down({0, 5, -2});
  if (kind == "directional") light.shape = DirectionalLight{};
  if (kind == "spot") light.shape = SpotLight{.outer_cone_angle = 15.0 * pi / 180.0};
  if (kind == "point") light.shape = PointLight{};
  return light;
}

// A preset on the map that it lays over that ground; depths reach the 10 km of Babylon.js's default camera.
struct Mapped {
  Experiment experiment;
  MapLayout layout;
  std::vector<MapPlace> places;
  explicit Mapped(const Preset& preset) {
    apply_preset(preset, describe(experiment));
    const GBuffer surfels = seen_ground();
    View view;
    view.width = view.height = 40;
    view.camera.projection = PerspectiveProjection{.near_plane = 0.1, .far_plane = 1e5};
    Bounds bounds;
    bounds.include({-30, -9995, -50});
    bounds.include({30, 1, 10});
    const ShadowParams& shadow = experiment.shadow;
    const Light light = light_of(preset.kind);
    layout = with_depth_encoding(fit_map(light, bounds, shadow.map, {surfels, view}, shadow.fit), shadow.map_depth);
    places = places_of(light, layout, surfels);
  }
  std::vector<BiasTerms> terms() const { return terms_of(experiment, layout, places); }
};

std::vector<BiasTerms> terms_at(const BiasSpec& numbers, const std::vector<MapPlace>& places) {
  std::vector<BiasTerms> terms;
  for (const MapPlace& place : places) terms.push_back(terms_of(numbers, place));
  return terms;
}

void expect_close(double value, double expected, double relative) {
  EXPECT_NEAR(value, expected, relative * std::abs(expected));
}

// The terms for which the engine has a number are alike at every place.
void expect_same(const BiasEngine& engine, const std::vector<BiasTerms>& terms, const std::vector<BiasTerms>& expected,
                 double relative) {
  for (const BiasNumber& number : engine.numbers) {
    const auto term = number.term == BiasTerm::constant ? &BiasTerms::constant
                      : number.term == BiasTerm::normal ? &BiasTerms::normal
                                                        : &BiasTerms::slope;
    for (std::size_t i = 0; i < terms.size(); ++i) expect_close(terms[i].*term, expected[i].*term, relative);
    if (number.term != BiasTerm::normal) continue;
    for (std::size_t i = 0; i < terms.size() && expected[i].normal != 0.0; ++i) {
      EXPECT_EQ(terms[i].offset, expected[i].offset);
    }
  }
}

// From the terms to these numbers at each place.
void expect_numbers(const std::vector<BiasTerms>& terms, const BiasSpec& spec, const std::vector<MapPlace>& places,
                    double relative) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const BiasConversion converted = convert(terms[i], spec, places[i]);
    for (std::size_t n = 0; n < spec.numbers.size(); ++n) {
      ASSERT_TRUE(converted.numbers[n].value) << spec.engine->numbers[n].name << ": " << converted.numbers[n].reason;
      expect_close(*converted.numbers[n].value, spec.numbers[n], relative);
    }
    // A part without a number is one that the engine adds to every bias.
    EXPECT_TRUE(converted.missing.empty() || !spec.engine->note.empty());
  }
}

TEST(PresetBias, Every_preset_is_its_engines_numbers_and_these_are_it) {
  int converted = 0;
  for (const Preset& preset : installed_presets()) {
    if (preset.kind == "ao" || without_numbers.contains(preset.name)) continue;
    SCOPED_TRACE(preset.name);
    const Mapped own(preset);
    ASSERT_GE(own.places.size(), 1u);
    BiasSpec spec = at_light(parse_bias_source(preset.numbers), own.places.front());
    expect_numbers(own.terms(), spec, own.places, of_a_preset);
    expect_same(*spec.engine, terms_at(spec, own.places), own.terms(), of_a_preset);
    ++converted;

    // Other numbers, in our parameters, and back. The defaults may be 0.
    for (double& number : spec.numbers) number += 0.375;
    std::string reason;
    Mapped other = own;
    const std::vector<BiasTerms> terms = terms_at(spec, own.places);
    const std::optional<Experiment> set = with_terms(own.experiment, own.layout, own.places, terms, reason);
    ASSERT_TRUE(set) << reason;
    other.experiment = *set;
    expect_same(*spec.engine, other.terms(), terms, rounding);
    expect_numbers(other.terms(), spec, own.places, rounding);
  }
  EXPECT_GE(converted, 27);
}

TEST(PresetBias, The_numbers_of_a_preset_are_the_defaults_that_convert_has) {
  for (const Preset& preset : installed_presets()) {
    if (preset.numbers.empty()) continue;
    const MapPlace place = Mapped(preset).places.front();
    const BiasSpec spec = at_light(parse_bias_source(preset.numbers), place);
    EXPECT_EQ(spec.numbers, at_light(default_target(*spec.engine), place).numbers) << preset.name;
  }
}

TEST(PresetBias, Presets_without_numbers_are_listed_and_have_no_formula) {
  std::set<std::string> found;
  for (const Preset& preset : installed_presets()) {
    const auto listed = without_numbers.find(preset.name);
    EXPECT_EQ(preset.numbers.empty(), preset.kind == "ao" || listed != without_numbers.end()) << preset.name;
    if (listed == without_numbers.end()) continue;
    found.insert(preset.name);
    const BiasEngine& engine = require_bias_engine(listed->second.engine);
    const MapPlace place = Mapped(preset).places.front();
    const BiasSpec defaults = default_target(engine);
    EXPECT_TRUE(engine.numbers.empty() || !has_terms(defaults, place))
        << preset.name << ": no longer " << listed->second.why;
  }
  EXPECT_EQ(found.size(), without_numbers.size());
}

}  // namespace
}  // namespace umbrameter
