#include "results/bias_advice.h"

namespace umbrameter {

bool keeps_bias(const BiasAdvice& advice) {
  return advice.used.mae <= advice.plateau.limit &&
         (advice.used.acne <= little_acne_share || !advice.plateau.has_little_acne());
}

}  // namespace umbrameter
