// Where the files lie that the program needs at run time.
#pragma once

#include <filesystem>

namespace umbrameter {

/// $UMBRAMETER_DATA when set, else ../share/umbrameter from the folder of the running program.
std::filesystem::path data_folder();

}  // namespace umbrameter
