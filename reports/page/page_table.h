// Tables as they stand in the page.
#pragma once

#include <string>

#include "core/table.h"

namespace umbrameter {

/// A <table> with caption, a header row, a row of units where there are any, and at most 500 rows; if there are more,
/// the caption says so. Numbers are rounded to six digits. Empty when the table has no columns.
std::string table_markup(const Table& table, const std::string& caption);

}  // namespace umbrameter
