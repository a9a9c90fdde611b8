#include "raster/gl/objects.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace umbrameter {
namespace {

std::vector<unsigned>& destroyed() {
  static std::vector<unsigned> names;
  return names;
}

void record(unsigned name) { destroyed().push_back(name); }
using Recorded = gl::Object<&record>;

class Objects : public testing::Test {
 protected:
  void SetUp() override { destroyed().clear(); }
};

static_assert(!std::is_copy_constructible_v<gl::Texture> && !std::is_copy_assignable_v<gl::Texture>);
static_assert(std::is_nothrow_move_constructible_v<gl::Texture> && std::is_nothrow_move_assignable_v<gl::Texture>);

TEST_F(Objects, An_empty_object_needs_no_context_and_destroys_nothing) {
  {
    const gl::Texture texture;
    EXPECT_TRUE(texture.empty());
    EXPECT_EQ(texture.name(), 0u);
    const Recorded recorded;
    EXPECT_TRUE(recorded.empty());
  }
  EXPECT_TRUE(destroyed().empty());
}

TEST_F(Objects, A_name_is_destroyed_once_however_often_it_moved) {
  {
    Recorded first(7);
    Recorded second(std::move(first));
    Recorded third;
    third = std::move(second);
    EXPECT_EQ(third.name(), 7u);
    EXPECT_TRUE(destroyed().empty());
  }
  EXPECT_EQ(destroyed(), std::vector<unsigned>{7});
}

TEST_F(Objects, Assignment_destroys_what_was_held_before) {
  Recorded held(1);
  held = Recorded(2);
  EXPECT_EQ(destroyed(), std::vector<unsigned>{1});
  EXPECT_EQ(held.name(), 2u);
}

TEST_F(Objects, Assignment_to_itself_keeps_the_name) {
  Recorded held(3);
  Recorded& same = held;
  held = std::move(same);
  EXPECT_EQ(held.name(), 3u);
  EXPECT_TRUE(destroyed().empty());
}

TEST_F(Objects, Reset_empties_at_once) {
  Recorded held(4);
  held.reset();
  held.reset();
  EXPECT_TRUE(held.empty());
  EXPECT_EQ(destroyed(), std::vector<unsigned>{4});
}

}  // namespace
}  // namespace umbrameter
