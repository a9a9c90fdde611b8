#include "results/tune_results.h"

namespace umbrameter {

const TunePoint& point_to_use(const TuneResult& result) {
  return result.recommended ? *result.recommended : result.best;
}

}  // namespace umbrameter
