// A field of boxes at random places, seen by many cameras that share no part of it. Each view is measured by itself;
// its interval should hold the mean of all.
#include <map>

#include "core/random.h"
#include "coverage.h"
#include "experiments/measure/measure.h"
#include "experiments/tune/tune_significance.h"
#include "results/layers.h"
#include "store/run_comparison.h"
#include "tests/support/shapes.h"

namespace umbrameter::coverage {
namespace {

constexpr double cell_width = 9.0;  // metres; a view is 8 m wide
constexpr double cell_depth = 7.0;
constexpr int boxes_of_a_cell = 300;

// Boxes of 6 to 20 cm anywhere on the ground, turned about the vertical: small beside the blocks of `report` and
// `tune`, which are one metre wide.
Mesh make_boxes(int count, double width, double depth) {
  Mesh all;
  for (int i = 0; i < count; ++i) {
    const auto random = [i](std::uint32_t of, double low, double high) {
      return low + (high - low) * static_cast<double>(to_unit_float(hash(static_cast<std::uint32_t>(i), of)));
    };
    const vec3 half(dvec3(random(0, 0.03, 0.1), random(1, 0.03, 0.1), random(2, 0.03, 0.1)));
    const dvec3 at(random(3, 0.0, width), half.y, random(4, 0.0, depth));
    const double turn = random(5, 0.0, pi);
    const dmat3 turned(dvec3(std::cos(turn), 0, -std::sin(turn)), dvec3(0, 1, 0),
                       dvec3(std::sin(turn), 0, std::cos(turn)));
    const Mesh box = shapes::box(-half, half);
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    for (const vec3& point : box.positions) all.positions.emplace_back(at + turned * dvec3(point));
    for (const uvec3& triangle : box.triangles) all.triangles.push_back(triangle + first);
  }
  return all;
}

Scene make_field(int views) {
  Scene scene = shapes::empty_scene();
  const int columns = static_cast<int>(std::ceil(std::sqrt(views)));
  const double width = columns * cell_width;
  const double depth = columns * cell_depth;
  shapes::add_mesh(scene, shapes::quad(vec3(0), vec3(dvec3(0, 0, depth)), vec3(dvec3(width, 0, 0))));
  shapes::add_mesh(scene, make_boxes(boxes_of_a_cell * columns * columns, width, depth));
  for (int i = 0; i < views; ++i) {
    const dvec3 target(cell_width * (i % columns + 0.5), 0.0, cell_depth * (i / columns + 0.5));
    const dvec3 back(0.0, std::sin(pi / 3.0), std::cos(pi / 3.0));
    const dmat4 placed(dvec4(1, 0, 0, 0), dvec4(0, back.z, -back.y, 0), dvec4(back, 0), dvec4(target + 20.0 * back, 1));
    PerspectiveProjection narrow;
    narrow.vertical_fov = 0.224;  // 8 m × 4.5 m at 20 m
    scene.cameras.push_back({fmt::format("view {}", i), placed, narrow});
  }
  scene.lights.push_back(shapes::directional(dvec3(0.5, 1.0, 0.35)));
  return scene;
}

// Two techniques of one quantity.
struct Case {
  const char* name;
  SweptQuantity quantity;
  Experiment first;
  Experiment second;
};

std::vector<Case> all_cases() {
  Experiment shadow;
  shadow.view.size = {160, 90};
  shadow.view.surfels = SurfelSource::traced;
  shadow.shadow.map.resolution = 4096;
  shadow.truth.spp = 16;
  Experiment box = shadow;
  box.shadow.pcf.filter = ShadowFilter::box;
  Experiment soft = shadow;
  soft.light.angle = 4.0;
  Experiment soft_box = box;
  soft_box.light.angle = 4.0;
  Experiment ssao = shadow;
  ssao.ao.sampling.radius = 0.1;
  ssao.ao.bias.depth = 0.005;
  Experiment gtao = ssao;
  gtao.ao.technique = AoTechniques::choice<Gtao>;
  return {{"field, hard shadow", SweptQuantity::visibility, shadow, box},
          {"field, sun of 4°, 16 rays", SweptQuantity::visibility, soft, soft_box},
          {"field, AO, 16 rays", SweptQuantity::ao, ssao, gtao}};
}

double value_of(const Statistic& statistic) {
  if (const auto* const* estimate = std::get_if<Estimate*>(&statistic.field)) return (*estimate)->value;
  if (const auto* const* number = std::get_if<double*>(&statistic.field)) return **number;
  return static_cast<double>(*std::get<std::uint64_t*>(statistic.field));
}

StoredRun run_of(Stages& stages, const Experiment& experiment, SweptQuantity quantity) {
  StoredRun run;
  run.scene = "field";
  Measurement measurement{.experiment = experiment, .surfels = *stages.surfels(experiment)};
  MeasuredStatistic measured;
  CellStatistics statistics;
  if (quantity == SweptQuantity::ao) {
    measurement.ao = measure_ao(stages, experiment, {});
    measured.kind = "ao";
    measured.degrees_of_freedom = measurement.ao->truth->degrees_of_freedom;
    statistics = *measurement.ao->statistics;
  } else {
    measurement.shadows.push_back(measure_shadow(stages, experiment, 0, {}));
    measured.kind = "shadow";
    measured.degrees_of_freedom = measurement.shadows.front().truth->degrees_of_freedom;
    measured.light = stages.title(0);
    run.layers[measured.light] = stages.layer(0);
    std::visit([&](const auto& each) { statistics = each; }, *measurement.shadows.front().statistics);
  }
  for (const Statistic& each : describe(statistics)) {
    measured.name = each.name;
    measured.value = value_of(each);
    run.statistics.push_back(measured);
  }
  measurement.picture = picture_of(stages, measurement);
  move_to_layers(stages.facts(), measurement);
  run.images = std::move(measurement.layers);
  return run;
}

// Intervals of single views, and the mean of the answers of all views. Noise raises an absolute error, so that answers
// are of many rays.
struct OfViews {
  std::vector<Estimate> estimates;
  double sum = 0.0;
  int answers = 0;
};

void print_about_mean(const std::string& name, const std::string& statistic, const OfViews& of) {
  print_row(name, statistic, of.estimates, of.sum / of.answers);
}

Experiment of_view(Stages& stages, const Experiment& given, int view) {
  Experiment experiment = stages.in_metres(given);
  experiment.view.camera = std::to_string(view);
  return experiment;
}

Experiment with_many_rays(Experiment experiment) {
  experiment.truth.spp = 1024;
  return experiment;
}

// As `report` compares two runs of each view.
void measure_report(const Case& of, Stages& stages, int views) {
  std::map<std::string, OfViews> values, differences;
  for (int view = 0; view < views; ++view) {
    std::vector<StoredRun> runs, exact;
    // One reference after the other, of which one is kept.
    for (const Experiment& given : {of.first, of.second}) {
      runs.push_back(run_of(stages, of_view(stages, given, view), of.quantity));
    }
    for (const Experiment& given : {of.first, of.second}) {
      exact.push_back(run_of(stages, with_many_rays(of_view(stages, given, view)), of.quantity));
    }
    const std::vector<ComparedStatistic> answers = compare_runs(exact);
    const std::vector<ComparedStatistic> compared = compare_runs(runs);
    const auto add = [](OfViews& all, const Estimate& estimate, double answer) {
      all.estimates.push_back(estimate);
      all.sum += answer;
      ++all.answers;
    };
    for (std::size_t i = 0; i < compared.size(); ++i) {
      const ComparedStatistic& each = compared[i];
      const std::vector<ComparedValue>& answer = answers[i].values;
      const ComparedValue& first = each.values.front();
      if (first.interval == IntervalOf::pixels) {
        add(values[each.name], estimate_of(first), answer.front().measured.value);
      }
      if (each.values.size() > 1 && each.values[1].blocks > 0) {
        add(differences[each.name], each.values[1].difference, answer[1].measured.value - answer[0].measured.value);
      }
    }
  }
  for (const auto& [name, each] : values) print_about_mean(fmt::format("report: {}", of.name), name, each);
  for (const auto& [name, each] : differences) {
    print_about_mean(fmt::format("report, difference: {}", of.name), name, each);
  }
}

// As `tune` judges two points in one view.
void measure_tune(const Case& of, Stages& stages, int views) {
  const TuneGoal goal = make_goal("mae + 0.5*rmse", {}, of.quantity == SweptQuantity::ao ? "ao" : "shadow", {}, false);
  OfViews costs, differences;
  for (int view = 0; view < views; ++view) {
    std::vector<CaseValues> values[2], answers[2];
    LeftOutBlocks blocks[2];
    for (const int point : {0, 1}) {
      const Experiment experiment = of_view(stages, point == 0 ? of.first : of.second, view);
      const TuneCase tuned{&stages, experiment, of.quantity, 0, {}};
      values[point].push_back(measure_case(tuned, experiment, goal));
      blocks[point].push_back(measure_without_blocks(tuned, experiment, goal));
    }
    for (const int point : {0, 1}) {
      const Experiment experiment = with_many_rays(of_view(stages, point == 0 ? of.first : of.second, view));
      answers[point].push_back(measure_case({&stages, experiment, of.quantity, 0, {}}, experiment, goal));
    }
    costs.estimates.push_back(*cost_interval(goal, values[0], blocks[0]));
    costs.sum += total_cost(goal, answers[0]);
    differences.estimates.push_back(*cost_difference(goal, values[0], blocks[0], values[1], blocks[1]));
    differences.sum += total_cost(goal, answers[0]) - total_cost(goal, answers[1]);
    ++costs.answers;
    ++differences.answers;
  }
  print_about_mean(fmt::format("tune: {}", of.name), goal.text, costs);
  print_about_mean(fmt::format("tune, difference: {}", of.name), goal.text, differences);
}

}  // namespace

void measure_views(const Options& options) {
  for (const Case& each : all_cases()) {
    if (!options.selects(each.name)) continue;
    Stages stages(make_field(options.seeds), {}, {.quiet = true});
    measure_report(each, stages, options.seeds);
    measure_tune(each, stages, options.seeds);
  }
}

}  // namespace umbrameter::coverage
