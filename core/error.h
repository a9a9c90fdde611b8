// Errors that a user can cause or mend: files, drivers, options. Our own mistakes are asserts.
#pragma once

#include <stdexcept>
#include <string>

namespace umbrameter {

/// What the program's exit status says.
enum class ExitCode {
  ok = 0,
  check_failed = 1,      ///< a check failed or images differ
  usage = 2,             ///< command line, experiment file or output folder
  no_backend = 3,        ///< no usable EGL, OpenGL or Embree
  unreadable_input = 4,  ///< a scene or image that cannot be read
  partial = 5,           ///< part of the result is missing: disk full, a figure tool failed
  interrupted = 130,     ///< SIGINT
  terminated = 143,      ///< SIGTERM
};

/// One line for the user: what failed and where, why, and what to do about it.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& what_failed, const std::string& why, const std::string& remedy = {});
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace umbrameter
