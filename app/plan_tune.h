// `umbrameter plan tune`: the first round of a tuning.
#pragma once

#include "app/commands.h"

namespace umbrameter {

/// Writes the plan. The folder is free. Throws Error as `tune` does, and (usage) for what a divided tuning cannot do.
ExitCode plan_tune(const CommandLine& line, const Console& console);

}  // namespace umbrameter
