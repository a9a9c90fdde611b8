#include "core/suggestion.h"

#include <gtest/gtest.h>

namespace umbrameter {
namespace {

using Names = std::vector<std::string>;

const Names names = {"shadow.resolution",
                     "shadow.constant-bias",
                     "shadow.slope-bias",
                     "ao.bias",
                     "ao.radius",
                     "shadow.filter-radius",
                     "truth.spp",
                     "size",
                     "seed",
                     "light"};

TEST(Suggestion, Edit_distance_counts_insertions_deletions_and_substitutions) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);  // the textbook example of Levenshtein's distance
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("same", "same"), 0);
}

TEST(Suggestion, A_slip_in_the_whole_name_finds_that_name_alone) {
  EXPECT_EQ(similar_names("truth.ssp", names), Names{"truth.spp"});
  EXPECT_EQ(similar_names("shadow.constantbias", names), Names{"shadow.constant-bias"});
  EXPECT_EQ(similar_names("ligth", names), Names{"light"});
}

TEST(Suggestion, The_last_part_or_a_word_of_it_finds_every_name_that_has_it) {
  EXPECT_EQ(similar_names("bias", names), (Names{"shadow.constant-bias", "shadow.slope-bias", "ao.bias"}));
  EXPECT_EQ(similar_names("resolution", names), Names{"shadow.resolution"});
  EXPECT_EQ(similar_names("constant-bias", names), Names{"shadow.constant-bias"});
  EXPECT_EQ(similar_names("ao.resolution", names), Names{"shadow.resolution"});
}

TEST(Suggestion, A_word_too_many_is_no_obstacle) {
  EXPECT_EQ(similar_names("shadow.slope-scaled-bias", names), Names{"shadow.slope-bias"});
  EXPECT_TRUE(similar_names("shadow.map-size", names).empty()) << "a single word in common says little";
}

TEST(Suggestion, The_given_group_comes_first) {
  EXPECT_EQ(similar_names("shadow.bias", names), (Names{"shadow.constant-bias", "shadow.slope-bias"}));
  EXPECT_EQ(similar_names("shadow.radius", names), Names{"shadow.filter-radius"});
  EXPECT_EQ(similar_names("shadow.biass", std::vector<std::string>{"ao.bias", "shadow.constant-bias"}),
            Names{"shadow.constant-bias"});
}

TEST(Suggestion, A_slip_in_the_last_part_is_found_without_its_group) {
  EXPECT_EQ(similar_names("resolutoin", names), Names{"shadow.resolution"});
  EXPECT_EQ(similar_names("slope-bais", names), Names{"shadow.slope-bias"});
}

TEST(Suggestion, What_has_nothing_in_common_is_no_suggestion) {
  EXPECT_TRUE(similar_names("nonsense-of-all-kinds", names).empty());
  EXPECT_TRUE(similar_names("", names).empty());
  EXPECT_TRUE(similar_names("-", names).empty());
  EXPECT_EQ(suggestion({}), "");
}

TEST(Suggestion, One_two_and_three_names_read_as_a_question) {
  EXPECT_EQ(suggestion({"a"}), "did you mean 'a'?");
  EXPECT_EQ(suggestion({"a", "b"}), "did you mean 'a' or 'b'?");
  EXPECT_EQ(suggestion({"a", "b", "c"}), "did you mean 'a', 'b' or 'c'?");
}

}  // namespace
}  // namespace umbrameter
