// The recommended bias of one light in words, as a table and for summary.json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reports/page/page.h"
#include "results/bias_advice.h"

namespace umbrameter {

/// "use bias 2.8 texels (12 cm): error 9.1 % → 1.2 %; 2.6 to 3.1 texels have at most 1.05 times the least error
/// (1.2 %)"; "keep …" where the bias in use is as good; where none is recommended, why.
std::string advice_text(const BiasAdvice& advice);

/// The bias in use, the recommended one, the plateau's ends, that of least error and the least with little or no acne,
/// with the error of each by cause.
ReportTable advice_table(const BiasAdvice& advice);

/// The bias of named_bias(), in the unit in use and another: "2.37 texels (6.36 cm)".
std::string named_bias_text(const BiasAdvice& advice);

/// "recommended_bias" of summary.json.
nlohmann::ordered_json to_json(const BiasAdvice& advice);

}  // namespace umbrameter
