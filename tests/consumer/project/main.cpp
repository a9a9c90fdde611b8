// What a program of someone else does with the installed libraries: load, trace, analyse, write down.
#include <iostream>

#include "compare/visibility.h"
#include "raytrace/tracer.h"
#include "reports/files/data.h"
#include "scenes/builtin.h"
#include "scenes/view.h"

using namespace umbrameter;

int main() {
  const Scene scene = load_scene("contact-box");
  std::vector<std::string> notes;
  View view;
  view.width = 64;
  view.height = 36;
  view.camera = select_camera(scene, "", 64.0 / 36.0, notes);
  const Light light = scene.lights[select_lights(scene, "").front()];

  const Tracer tracer(scene);
  const GBuffer gbuffer = trace_gbuffer(tracer, view);
  const Image<float> truth = trace_visibility(tracer, gbuffer, light).visibility;

  // Against itself a truth has no error, and the scene must hold both light and shadow.
  const CountedPixels counted = count_pixels(gbuffer, light, fit_light(light, bounds_of(scene), 1024));
  const WrongTaps none{Image<uvec4>(truth.width, truth.height, uvec4(0)), 1};
  const VisibilityStatistics statistics = analyze_visibility(none, truth, counted);
  const Table table{columns_of(VisibilityStatistics{}), {row_of(statistics)}};
  std::cout << to_csv(table);
  return statistics.mae == 0.0 && statistics.lit > 0.0 && statistics.blocked > 0.0 ? 0 : 1;
}
