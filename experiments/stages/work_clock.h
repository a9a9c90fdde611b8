// What work takes, in seconds that may be compared: other programs on the machine do not lengthen processor time, and a
// GPU or another process does not show in it.
#pragma once

namespace umbrameter {

/// Seconds since some moment; only differences mean something.
using WorkClock = double (*)();

/// By the clock.
double clock_seconds();

/// Processor time of all threads of this process.
double processor_seconds();

}  // namespace umbrameter
