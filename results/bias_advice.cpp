#include "results/bias_advice.h"

namespace umbrameter {

bool keeps_bias(const BiasAdvice& advice) {
  return advice.used.mae <= advice.plateau.limit &&
         (advice.used.acne <= little_acne_share || !advice.plateau.has_little_acne());
}

const BiasCell& named_bias(const BiasAdvice& advice) {
  return keeps_bias(advice) ? advice.used : advice.plateau.recommended;
}

}  // namespace umbrameter
