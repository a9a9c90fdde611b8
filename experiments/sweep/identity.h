// What a sweep or a tuning is, apart from who measures it: machines whose identities are equal may resume and share it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/stages/stages.h"
#include "results/swept.h"

namespace umbrameter {

using Identity = std::vector<std::pair<std::string, std::string>>;  ///< name and value

/// What measures: the kind of device, and a hash of the sources that decide what is measured.
Identity measuring_identity(Stages& stages);

/// All that the rows of a sweep depend on besides its axes: parameters, contents, measuring_identity().
Identity identity_of_sweep(Stages& stages, Experiment experiment, SweptQuantity quantity);

/// Who measures, for people: program, processor, Embree and OpenGL driver. Two makers' numbers may differ in their last
/// digits.
std::string maker_of(Stages& stages);

/// The note that several makers measured "cells"; empty if it was one.
std::string makers_text(const std::string& what, const std::vector<std::string>& makers);

}  // namespace umbrameter
