// Damage that SQLite does not notice.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "tests/store/small_store.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

// The bytes of `value` as SQLite stores a real number: big-endian (file format, 2.1).
std::string stored_real(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  std::string bytes;
  for (unsigned shift = 64; shift > 0; shift -= 8) bytes += static_cast<char>(bits >> (shift - 8) & 0xffu);
  return bytes;
}

TEST(ResultsChecksum, A_flipped_bit_in_a_number_is_reported_with_the_cells_it_is_in) {
  const TemporaryFolder folder;
  {
    ResultsStore store = ResultsStore::open(folder.path(), description(1025));
    store.append(0, [&](const CellSink& keep) {
      for (std::size_t i = 0; i < 1025; ++i) keep(i, row(0, "box", i == 1024 ? 0.1 : 0.3));
    });
    store.finish();
  }
  std::string bytes = text_of(folder / "results.sqlite");
  const std::size_t place = bytes.find(stored_real(0.1));
  ASSERT_NE(place, std::string::npos);
  bytes[place + 4] = static_cast<char>(bytes[place + 4] ^ 1);
  put_text(folder / "results.sqlite", bytes);
  expect_error([&] { ResultsStore::load(folder.path()); }, ExitCode::unreadable_input,
               {"results.sqlite", "cells 1024 to 1024 do not match their checksum", "--force"});
}

TEST(ResultsChecksum, Damaged_groups_of_an_unfinished_store_are_measured_again) {
  const TemporaryFolder folder;
  {
    ResultsStore store = ResultsStore::open(folder.path(), description());
    add(store, {3, 1});
    add(store, {0, 2});
  }
  const std::string path = folder / "results.partial.sqlite";
  std::string bytes = text_of(path);
  const std::size_t place = bytes.find(stored_real(0.125));  // of cell 2
  ASSERT_NE(place, std::string::npos);
  bytes[place + 7] = '\1';
  put_text(path, bytes);
  ResultsStore store = ResultsStore::open(folder.path(), description());
  EXPECT_EQ(store.discarded(), 2u);
  EXPECT_TRUE(store.has_group(3));
  EXPECT_FALSE(store.has_group(0));
  add(store, {0, 2});
  store.finish();
  EXPECT_EQ(all_rows(store), rows);
}

TEST(ResultsChecksum, No_flipped_bit_gives_other_rows) {
  const TemporaryFolder whole;
  {
    ResultsStore store = ResultsStore::open(whole.path(), description());
    add(store, {0, 1, 2, 3});
    store.finish();
  }
  const std::string bytes = text_of(whole / "results.sqlite");
  const TemporaryFolder folder;
  std::size_t refused = 0;
  std::size_t used = 0;  // most of the zeros are free space
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i] == '\0' || ++used % 5 != 0) continue;
    std::string flipped = bytes;
    flipped[i] = static_cast<char>(flipped[i] ^ (1 << i % 8));
    put_text(folder / "results.sqlite", flipped);
    try {
      EXPECT_EQ(all_rows(ResultsStore::load(folder.path())), rows) << "byte " << i;
    } catch (const Error& error) {
      ++refused;
      EXPECT_TRUE(error.code() == ExitCode::unreadable_input || error.code() == ExitCode::usage) << error.what();
    } catch (const std::exception& error) {
      ADD_FAILURE() << "byte " << i << ": " << error.what();
    }
  }
  EXPECT_GT(refused, 0u);
}

}  // namespace
}  // namespace umbrameter
