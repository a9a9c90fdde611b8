#include "experiments/measure/scene_report.h"

#include <chrono>

#include "experiments/stages/costs.h"
#include "raster/gbuffer/uploaded_scene.h"
#include "raytrace/tracer.h"
#include "scenes/builtin.h"

namespace umbrameter {

SceneReport make_scene_report(const std::string& source, const std::string& part, const SceneReportOptions& options) {
  SceneReport report;
  report.source = source;
  report.part = part;
  report.unit = options.scene_params.unit;
  const auto start = std::chrono::steady_clock::now();
  report.scene = load_scene(source, part, options.scene_params, options.load);
  report.load_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report.peak_resident = peak_resident_bytes();
  report.counts = count(report.scene);
  report.bounds = bounds_of(report.scene);
  report.units = guess_units(report.bounds, metres_per_unit(report.unit), is_surrounding(report.scene));
  report.memory = bytes_in_memory(report.scene);
  report.gpu = bytes_when_uploaded(report.scene);
  const bool is_small = report.counts.stored_triangles <= max_triangles_built_unasked;
  if (report.counts.triangles > 0 && (is_small || options.measure_memory)) {
    report.tracer_bytes = Tracer(report.scene).build_statistics().bytes;
  }
  return report;
}

}  // namespace umbrameter
