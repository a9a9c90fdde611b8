#include "experiments/tune/tune_judgement.h"

#include <algorithm>
#include <utility>

#include "core/interrupt.h"

namespace umbrameter {
namespace {

using AtCase = std::function<Experiment(const TuneCase&)>;

AtCase at(const JudgeInput& in, const std::vector<Value>& values) {
  return [&in, values](const TuneCase& each) { return at_point(each, in.axes, values); };
}

AtCase as_given() {
  return [](const TuneCase& each) { return each.experiment; };
}

std::vector<CaseValues> measure_all(const std::vector<TuneCase>& cases, const TuneGoal& goal, const AtCase& at) {
  std::vector<CaseValues> values;
  for (const TuneCase& each : cases) {
    throw_if_interrupted();
    values.push_back(measure_case(each, at(each), goal));
  }
  return values;
}

std::optional<Estimate> moved(std::optional<Estimate> estimate, double by) {
  if (estimate) *estimate = {estimate->value + by, estimate->lower + by, estimate->upper + by};
  return estimate;
}

std::optional<Estimate> negated(std::optional<Estimate> estimate) {
  if (estimate) *estimate = {-estimate->value, -estimate->upper, -estimate->lower};
  return estimate;
}

// In the unit of the cost: the default's costs are those of other cases.
HeldOut check_held_out(const JudgeInput& in) {
  const TuneGoal goal = not_relative(in.goal);
  const auto measure = [&](const std::vector<Value>& values, const AtCase& at) {
    TunePoint point{values, measure_all(in.unseen, goal, at), {}};
    point.score = score_of(goal, point.values, point.cases);
    return point;
  };
  const AtCase best = at(in, in.result.best.values);
  HeldOut held{titles_of(in.unseen), measure(in.result.before.values, as_given()),
               measure(in.result.best.values, best)};
  const LeftOutBlocks of_before = leave_out_blocks(in.unseen, goal, as_given());
  const auto difference = [&](const TunePoint& point, const AtCase& at) {
    return cost_difference(goal, point.cases, leave_out_blocks(in.unseen, goal, at), held.before.cases, of_before);
  };
  held.difference = difference(held.best, best);
  held.few_blocks = few_blocks(of_before);
  if (in.result.recommended) {
    const AtCase recommended = at(in, in.result.recommended->values);
    held.recommended = measure(in.result.recommended->values, recommended);
    held.recommended_difference = difference(*held.recommended, recommended);
  }
  return held;
}

}  // namespace

TuneJudgement judge(const JudgeInput& in, const std::function<void(double)>& progress) {
  const TuneResult& result = in.result;
  const bool shows_more = in.shown.columns.size() > in.goal.columns.size();
  const double steps = 4.0 + static_cast<double>(result.of_words.size());
  double done = 0.0;
  const auto step = [&] { progress(++done / steps); };
  const auto shown_at = [&](const TunePoint& point, const AtCase& at) {
    return shows_more ? measure_all(in.cases, in.shown, at) : point.cases;
  };

  TuneJudgement judgement;
  judgement.covers_rays = std::ranges::any_of(in.cases, [](const TuneCase& each) {
    return each.quantity != SweptQuantity::visibility || each.stages->is_sampled(each.experiment, each.light);
  });
  const AtCase best = at(in, result.best.values);
  const LeftOutBlocks of_best = leave_out_blocks(in.cases, in.goal, best);
  judgement.few_blocks = few_blocks(of_best);
  step();
  const LeftOutBlocks of_before = leave_out_blocks(in.cases, in.goal, as_given());
  judgement.best = cost_interval(in.goal, result.best.cases, of_best, of_before);
  // Of a relative goal the default costs 1, whichever pixels are chosen.
  judgement.against_before = in.goal.is_relative
                                 ? moved(judgement.best, -1.0)
                                 : cost_difference(in.goal, result.best.cases, of_best, result.before.cases, of_before);
  step();
  // The best point's cost minus that of another.
  const auto against = [&](const TunePoint& point) {
    if (point.cases == result.before.cases) return judgement.against_before;
    return cost_difference(in.goal, result.best.cases, of_best, point.cases,
                           leave_out_blocks(in.cases, in.goal, at(in, point.values)), of_before);
  };
  if (result.runner_up) judgement.against_runner_up = against(*result.runner_up);
  step();
  if (!result.of_words.empty() || shows_more) {
    judgement.compared.push_back(
        {{}, result.before, shown_at(result.before, as_given()), negated(judgement.against_before)});
  }
  for (const WordPoint& word : result.of_words) {
    const TunePoint& point = word.point;
    ComparedPoint compared{
        word.axis, point, shown_at(point, at(in, point.values)), {}, point.values == result.best.values};
    if (!compared.is_best) compared.difference = negated(against(point));
    judgement.compared.push_back(std::move(compared));
    step();
  }
  if (result.of_words.empty() && shows_more) {
    judgement.compared.push_back({{}, result.best, shown_at(result.best, best), {}, true});
  }
  if (!in.unseen.empty()) judgement.held_out = check_held_out(in);
  step();
  return judgement;
}

}  // namespace umbrameter
