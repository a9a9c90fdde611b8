// umbrameter_coverage [SEEDS [RAYS [CASE]]]: how often the intervals of statistics hold what they are about. Prints a
// table in Markdown; docs/reference.md shows it. 300 seeds take an hour.
#include "coverage.h"

#include <exception>

#include "core/error.h"

int main(int argc, char** argv) {
  using namespace umbrameter;
  try {
    const coverage::Options options{argc > 1 ? std::stoi(argv[1]) : 300, argc > 2 ? std::stoi(argv[2]) : 16384,
                                    argc > 3 ? argv[3] : ""};
    fmt::print(
        "| case | statistic | value | mean deviation | 1.96 σ of the values | mean half width | intervals | held | too "
        "low | too high |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
    coverage::measure_rays(options);
    coverage::measure_rays_of_drawn(options);
    coverage::measure_views(options);
    return 0;
  } catch (const Error& error) {
    fmt::print(stderr, "umbrameter_coverage: {}\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "umbrameter_coverage: {}\n", error.what());
    return 1;
  }
}
