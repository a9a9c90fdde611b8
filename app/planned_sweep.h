// A plan's folder as a sweep.
#pragma once

#include <utility>
#include <vector>

#include "app/planned_folder.h"
#include "app/sweep_run.h"

namespace umbrameter {

/// Loads the sweep and identifies it. Throws Error (usage) if it is not the planned one: another scene, device or
/// build.
StoreDescription load_planned(const PlannedFolder& planned, SweepRun& sweep, const Console& console);

/// The identity of a sweep without the path of its scene, which differs between machines.
Identity portable_identity(const StoreDescription& description);

/// The kinds of a sweep's measured columns.
std::vector<ValueKind> measured_kinds(const StoreDescription& description, const SweepPlan& plan);

}  // namespace umbrameter
