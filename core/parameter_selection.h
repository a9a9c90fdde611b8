// Parts of a list of parameters.
#pragma once

#include <initializer_list>
#include <string_view>

#include "core/parameters.h"

namespace umbrameter {

/// The parameters of these full names, each of which must be in the list.
Parameters select(const Parameters& parameters, std::initializer_list<std::string_view> keys);

}  // namespace umbrameter
