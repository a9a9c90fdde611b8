#include "experiments/tune/minimize.h"

#include <exception>
#include <limits>
#include <nlopt.hpp>

namespace umbrameter {
namespace {

// Keeps the best point and what the function throws: the optimiser is C code, through which no exception may pass.
struct Search {
  const CubeFunction& function;
  std::vector<double> best{};
  double least = std::numeric_limits<double>::infinity();
  std::exception_ptr thrown{};

  double operator()(const std::vector<double>& position) {
    const double value = function(position);
    if (best.empty() || value < least) {
      best = position;
      least = value;
    }
    return value;
  }

  void run(nlopt::algorithm algorithm, std::vector<double> start, std::size_t evaluations) {
    if (evaluations == 0) return;
    const auto dimensions = static_cast<unsigned>(start.size());
    nlopt::opt optimizer(algorithm, dimensions);
    optimizer.set_lower_bounds(std::vector<double>(dimensions, 0.0));
    optimizer.set_upper_bounds(std::vector<double>(dimensions, 1.0));
    optimizer.set_maxeval(static_cast<int>(evaluations));
    optimizer.set_xtol_rel(1e-4);
    optimizer.set_initial_step(0.1);
    optimizer.set_min_objective(
        [](const std::vector<double>& position, std::vector<double>&, void* data) {
          auto& search = *static_cast<Search*>(data);
          try {
            return search(position);
          } catch (...) {
            search.thrown = std::current_exception();
            throw nlopt::forced_stop();
          }
        },
        this);
    double least_found = 0.0;
    try {
      optimizer.optimize(start, least_found);
    } catch (const nlopt::forced_stop&) {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const nlopt::roundoff_limited&) {
      // The best point is kept above.
    }
  }
};

}  // namespace

std::vector<double> minimize(const MinimizeOptions& options, const CubeFunction& function) {
  Search search{function};
  if (!options.start.empty()) search(options.start);
  const std::vector<double> middle(options.dimensions, 0.5);
  search.run(nlopt::GN_DIRECT_L, middle, options.global_evaluations);
  search.run(nlopt::LN_SBPLX, search.best.empty() ? middle : search.best, options.local_evaluations);
  return search.best;
}

}  // namespace umbrameter
