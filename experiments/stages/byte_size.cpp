#include "experiments/stages/byte_size.h"

#include <charconv>
#include <utility>

#include "core/error.h"

namespace umbrameter {

std::uint64_t parse_bytes(std::string_view text, const std::string& what, const std::string& remedy) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  for (const auto& [name, factor] : {std::pair{"", std::uint64_t{1}},
                                     {"K", 1'000},
                                     {"M", 1'000'000},
                                     {"G", 1'000'000'000},
                                     {"T", 1'000'000'000'000}}) {
    if (error == std::errc() && unit == name && number <= UINT64_MAX / factor) return number * factor;
  }
  throw Error(ExitCode::usage, what, "it is not a number of bytes", remedy);
}

}  // namespace umbrameter
