// What a program of someone else does with the installed libraries: measure one run, sweep a bias, write it down.
#include <iostream>

#include "core/error.h"
#include "experiments/measure/measure.h"
#include "experiments/sweep/sweep_table.h"
#include "reports/files/data.h"
#include "scenes/builtin.h"

using namespace umbrameter;

int main() try {
  Stages stages(load_scene("contact-box"), {}, Console{});
  Experiment experiment;
  experiment.view.size = {64, 36};
  const ShadowMeasurement shadow = measure_shadow(stages, experiment, 0, {});
  const Table table = sweep_table(stages, experiment, {"shadow.constant-bias=0:4texels:5"});
  std::cout << to_csv(table);

  const VisibilityStatistics& single = *by_cause(shadow);
  return table.rows.size() == 5 && single.lit > 0.0 && single.blocked > 0.0 ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return static_cast<int>(error.code());
}
