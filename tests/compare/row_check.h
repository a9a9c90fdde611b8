// A table's only row against the value that each column should hold, every column by its name.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "core/table.h"

namespace umbrameter::test {

inline void expect_row(const Table& table, const std::map<std::string, double>& expected) {
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.columns.size(), expected.size());
  ASSERT_EQ(table.rows[0].size(), expected.size());
  for (const auto& [name, value] : expected)
    EXPECT_EQ(to_number(table.rows[0][column_index(table, name)]), value) << name;
}

}  // namespace umbrameter::test
