#include "results/bias_advice.h"

namespace umbrameter {

bool keeps_bias(const BiasAdvice& advice) {
  return advice.used.mae <= plateau_limit(advice.plateau.least.mae) &&
         (advice.used.acne <= little_acne_share || !advice.plateau.has_little_acne());
}

}  // namespace umbrameter
