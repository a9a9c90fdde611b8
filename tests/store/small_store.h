// A results store of four cells, for the tests of the store.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "core/error.h"
#include "store/results_store.h"

namespace umbrameter {

// Cells of two axes and three measured columns, one of each kind.
inline StoreDescription description(std::size_t cells = 4) {
  return {"scene = \"corner\"\n",
          {{"scene", "corner"}, {"view.size", "64x36"}},
          {{"shadow.constant-bias", "0:1:2"}, {"shadow.filter", "box,nearest"}},
          {{{"shadow.constant-bias", "m", "bias"}, ValueKind::real},
           {{"shadow.filter", "", "filter"}, ValueKind::text},
           {{"pixels", "px", "counted"}, ValueKind::integer},
           {{"mae", "1", "error"}, ValueKind::real},
           {{"binary", "", "whether the truth is binary"}, ValueKind::truth}},
          cells};
}

inline std::vector<Value> row(double bias, const std::string& filter, double mae) {
  return {bias, filter, std::int64_t{7}, mae, true};
}

inline const std::vector<std::vector<Value>> rows = {row(0, "box", 0.5), row(0, "nearest", 0.25), row(1, "box", 0.125),
                                                     row(1, "nearest", 0.25)};

inline void add(ResultsStore& store, const std::vector<std::size_t>& cells) {
  store.append(cells.front(), [&](const CellSink& keep) {
    for (const std::size_t cell : cells) keep(cell, rows[cell]);
  });
}

inline std::vector<std::vector<Value>> all_rows(const ResultsStore& store,
                                                const std::vector<std::string>& columns = {}) {
  std::vector<std::vector<Value>> all;
  store.read(columns, [&](std::span<const Value> values) { all.emplace_back(values.begin(), values.end()); });
  return all;
}

inline void expect_error(const std::function<void()>& action, ExitCode code, const std::vector<std::string>& words) {
  try {
    action();
    ADD_FAILURE() << "nothing thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    for (const std::string& word : words) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
}

}  // namespace umbrameter
