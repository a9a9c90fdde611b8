#include "core/error.h"

namespace umbrameter {
namespace {

// Text from files and drivers may hold line breaks; the promise is one line.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace

Error::Error(ExitCode code, const std::string& what_failed, const std::string& why, const std::string& remedy)
    : std::runtime_error(one_line(what_failed + ": " + why + (remedy.empty() ? "" : "; " + remedy))), code_(code) {}

}  // namespace umbrameter
