#include "experiments/measure/engine_advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/lists.h"
#include "experiments/measure/bias_advice.h"
#include "experiments/measure/bias_terms.h"
#include "experiments/measure/measure_biases.h"

namespace umbrameter {
namespace {

double constant_besides_numbers(const BiasEngine& engine, const MapPlace& place) {
  return place.light == LightKind::directional ? engine.constant_of_range * place.range : 0.0;
}

// What `part` leaves of `whole`, a length of ours that was rounded to a float; 0 where `part` is larger.
double without(double whole, double part) { return whole <= part * (1.0 + 1e-6) ? std::min(whole, 0.0) : whole - part; }

class EnginesOfLight {
 public:
  explicit EnginesOfLight(const EngineCase& each)
      : stages_(each.stages),
        experiment_(each.experiment),
        recommended_(each.recommended),
        light_(each.light),
        layout_(layout_of(experiment_)),
        places_(places_of(stages_.light(experiment_, light_), layout_, stages_.surfels(experiment_)->gbuffer)) {}

  // The numbers; measure() completes them.
  EngineAdvice convert(const BiasSpec& given) {
    const BiasSpec target = at_light(given, places_.front());
    EngineAdvice advice;
    advice.target = convert_terms(terms_in(drawn_by(target, advice), target), target, places_);
    return advice;
  }

  void measure(EngineAdvice& advice) {
    const BiasSpec& target = advice.target.spec;
    if (is_complete(advice.target)) {
      advice.measured = measure(target, set_at_places(advice.target), advice.why_not_measured);
    }
    std::string reason;
    advice.by_default = measure(target, std::vector(places_.size(), target.numbers), reason);
  }

  bool is_same_light(const EnginesOfLight& other) const { return &stages_ == &other.stages_ && light_ == other.light_; }

 private:
  MapLayout layout_of(const Experiment& experiment) const {
    return with_depth_encoding(*stages_.layout(experiment, light_), experiment.shadow.map_depth);
  }

  // As the engine draws besides its numbers: nothing of that is the run's own, which may be a preset of another engine.
  // A unit draws as the run does.
  void draw_as(MapDepthParams& depth, const BiasSpec& target) const {
    const BiasEngine& engine = *target.engine;
    if (engine.is_unit) return;
    const bool has_factor = has_number(engine, BiasTerm::slope);
    depth.polygon_offset_factor = std::max(has_factor ? depth.polygon_offset_factor : 0.0, engine.polygon_factor);
    depth.polygon_offset_units =
        engine.polygon_units + engine.units_per_factor * (depth.polygon_offset_factor - engine.polygon_factor);
    depth.faces = faces_of(target);
  }

  // What the engine's numbers have to do: its own polygon offset and constant bias are there without them, and a unit's
  // other parts are ours.
  std::vector<BiasTerms> terms_in(const Experiment& drawn, const BiasSpec& target) const {
    std::vector<BiasTerms> terms = terms_of(drawn, layout_of(drawn), places_);
    const std::vector<MapPlace> own = places_for(target, places_);
    for (std::size_t i = 0; i < terms.size(); ++i) {
      BiasTerms& each = terms[i];
      each.slope = std::max(0.0, each.slope - target.engine->polygon_factor);
      each.constant = without(each.constant, constant_besides_numbers(*target.engine, own[i]));
      if (!target.engine->is_unit) continue;
      if (!has_number(*target.engine, BiasTerm::normal)) each.normal = 0.0;
      if (!has_number(*target.engine, BiasTerm::slope)) each.slope = 0.0;
    }
    return terms;
  }

  // Why the engine has no number for the normal offset; empty if it has one, or there is none.
  std::string why_no_offset(const Experiment& drawn, const BiasSpec& target) const {
    const std::vector<BiasTerms> terms = terms_in(drawn, target);
    if (std::ranges::all_of(terms, [](const BiasTerms& each) { return each.normal == 0.0; })) return {};
    for (const BiasNumber& number : target.engine->numbers) {
      if (number.term != BiasTerm::normal) continue;
      if (!has_other_offset(convert_terms(terms, target, places_))) return {};
      return fmt::format("its {} {}, the run {}", number.name, text_of(number.offset), text_of(terms.front().offset));
    }
    return "it has no normal offset";
  }

  // Our constant bias as an engine has it that sets one number for all places: the same at each of them up to a factor.
  // Nothing if `drawn` has it so, or none of ours is. A unit is converted as it is.
  std::optional<Experiment> with_one_number(const Experiment& drawn, const BiasSpec& target) const {
    if (target.engine->is_unit || sets_each_place({target, places_, {}})) return {};
    BiasSpec one = target;
    for (std::size_t n = 0; n < one.numbers.size(); ++n) {
      one.numbers[n] = one.engine->numbers[n].term == BiasTerm::constant ? 1.0 : 0.0;
    }
    Experiment of_one = drawn;
    of_one.shadow.bias.constant.number = 1.0;
    const std::vector<BiasTerms> ours = umbrameter::terms_of(of_one, layout_, places_);
    const std::vector<MapPlace> own = places_for(target, places_);
    std::vector<BiasTerms> terms(own.size());
    bool is_same = true;
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (has_terms(one, own[i])) terms[i].constant = std::abs(umbrameter::terms_of(one, own[i]).constant);
      if (terms[i].constant == 0.0) return {};
      const double factor = terms[i].constant / terms[0].constant * ours[0].constant / ours[i].constant;
      is_same = is_same && std::abs(factor - 1.0) <= 1e-9;
    }
    std::string reason;
    const std::optional<Experiment> said = with_terms(drawn, layout_, places_, terms, reason);
    if (is_same || !said || !takes_bias_unit(layout_, said->shadow.bias.constant.unit)) return {};
    of_one.shadow.bias.constant = said->shadow.bias.constant;
    of_one.shadow.fit.cascade_bias = said->shadow.fit.cascade_bias;
    return of_one;
  }

  // As the engine draws, without what it has no number for, and with the constant bias that is best then.
  Experiment drawn_by(const BiasSpec& target, EngineAdvice& result) {
    Experiment drawn = experiment_;
    const bool has_constant = has_number(*target.engine, BiasTerm::constant);
    if (recommended_ && has_constant) drawn.shadow.bias.constant.number = *recommended_;
    MapDepthParams& depth = drawn.shadow.map_depth;
    const MapDepthParams& own = experiment_.shadow.map_depth;
    draw_as(depth, target);
    result.own_faces = depth.faces != own.faces ? std::optional(depth.faces) : std::nullopt;
    // Units that come with a number are part of what that number does.
    const bool has_own_units =
        target.engine->units_per_factor == 0.0 && depth.polygon_offset_units != own.polygon_offset_units;
    result.has_own_offset = depth.polygon_offset_factor != own.polygon_offset_factor || has_own_units;
    result.lost_offset = why_no_offset(drawn, target);
    if (!result.lost_offset.empty()) {
      drawn.shadow.bias.normal_offset = {};
      depth.caster_offset = {};
    }
    if (!target.engine->is_unit) result.left_out_slope = std::exchange(drawn.shadow.bias.slope, 0.0);
    const std::optional<Experiment> with_one = with_one_number(drawn, target);
    result.has_one_number = with_one.has_value();
    const bool is_as_run = !result.has_one_number && !result.own_faces && !result.has_own_offset &&
                           result.lost_offset.empty() && result.left_out_slope == 0.0;
    if (is_as_run || !has_constant) return drawn;
    Experiment searched = with_one.value_or(drawn);
    searched.run.for_engines.clear();
    const BiasAdvice advice = advise_bias(stages_, searched, light_);
    if (advice.withheld) return drawn;
    // Not the run's own bias, however good: that was found under other conditions.
    searched.shadow.bias.constant.number = advice.plateau.recommended.constant;
    result.own_bias = searched.shadow.bias.constant;
    return searched;
  }

  // set_values() of all numbers, at each place; 0 where there is none.
  std::vector<std::vector<double>> set_at_places(const ConvertedTarget& target) const {
    const std::size_t count = target.spec.engine->numbers.size();
    std::vector<std::vector<double>> numbers(places_.size(), std::vector<double>(count));
    for (std::size_t n = 0; n < count; ++n) {
      const std::optional<std::vector<double>> values = set_values(target, n);
      for (std::size_t i = 0; values && i < places_.size(); ++i) numbers[i][n] = (*values)[i];
    }
    return numbers;
  }

  // The error with these numbers at each place; nothing if one of them is not known.
  std::optional<BiasCell> measure(BiasSpec spec, const std::vector<std::vector<double>>& numbers, std::string& reason) {
    const BiasEngine& engine = *spec.engine;
    const std::vector<MapPlace> own = places_for(spec, places_);
    std::vector<BiasTerms> terms = terms_of(experiment_, layout_, places_);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      spec.numbers = numbers[i];
      if (!has_terms(spec, own[i])) return {};
      BiasTerms of_numbers = umbrameter::terms_of(spec, own[i]);
      of_numbers.constant += constant_besides_numbers(engine, own[i]);
      if (engine.is_unit && !has_number(engine, BiasTerm::normal)) {
        of_numbers.normal = terms[i].normal;
        of_numbers.offset = terms[i].offset;
      }
      if (engine.is_unit && !has_number(engine, BiasTerm::slope)) of_numbers.slope = terms[i].slope;
      terms[i] = of_numbers;
    }
    std::optional<Experiment> experiment = with_terms(experiment_, layout_, places_, terms, reason);
    if (!experiment) return {};
    if (!takes_bias_unit(layout_, experiment->shadow.bias.constant.unit)) {
      reason = "its bias is a share of the depth that a cube's face stores, a unit which our bias does not have there";
      return {};
    }
    draw_as(experiment->shadow.map_depth, spec);
    if (engine.is_unit) experiment->shadow.bias.slope = experiment_.shadow.bias.slope;
    const VisibilityStatistics s =
        measure_biases(stages_, *experiment, light_, {experiment->shadow.bias.constant.number},
                       {experiment->shadow.bias.slope})
            .front()
            .front();
    return BiasCell{0.0, 0.0, s.mae, s.acne, s.false_occlusion, s.peter_panning, s.leak};
  }

  Stages& stages_;
  const Experiment& experiment_;
  std::optional<double> recommended_;
  std::uint32_t light_;
  MapLayout layout_;
  std::vector<MapPlace> places_;
};

}  // namespace

std::string no_engines_text(const Stages& stages, const Experiment& experiment, std::uint32_t light) {
  const bool has_curve =
      !stages.is_sampled(experiment, light) && stages.capabilities(experiment).taps_independent_of_bias;
  const char* needed =
      has_curve ? "counted pixels" : "PCF, whose acne can be counted, and a hard reference (--truth.shadow point)";
  return stages.title(light) + ": no bias in the numbers of engines; that needs " + needed;
}

std::vector<EngineAdvice> advise_engines(Stages& stages, const Experiment& experiment, std::uint32_t light) {
  return advise_engines({{stages, experiment, std::nullopt, light}}).front();
}

std::vector<std::vector<EngineAdvice>> advise_engines(const std::vector<EngineCase>& cases) {
  std::vector<std::vector<EngineAdvice>> advice(cases.size());
  if (cases.empty() || cases.front().experiment.run.for_engines.empty()) return advice;
  std::vector<EnginesOfLight> engines;
  for (const EngineCase& each : cases) engines.emplace_back(each);
  for (const BiasSpec& target : parse_bias_targets(cases.front().experiment.run.for_engines)) {
    for (std::size_t c = 0; c < cases.size(); ++c) advice[c].push_back(engines[c].convert(target));
    for (std::size_t c = 0; c < cases.size(); ++c) {
      std::vector<EngineAdvice*> of_light;
      for (std::size_t d = 0; d < cases.size(); ++d) {
        if (engines[d].is_same_light(engines[c])) of_light.push_back(&advice[d].back());
      }
      if (of_light.size() == 1 || of_light.front() != &advice[c].back()) continue;
      share_numbers(mapped(of_light, [](EngineAdvice* each) { return &each->target; }));
      for (EngineAdvice* each : of_light) each->is_shared = true;
    }
    for (std::size_t c = 0; c < cases.size(); ++c) engines[c].measure(advice[c].back());
  }
  return advice;
}

}  // namespace umbrameter
