#include "common/agglomerate/fragments.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/agglomerate/shapes.hpp"

namespace crumble {
namespace {

using Labels = std::vector<std::int32_t>;

TEST(Fragments, LargestIsNumberZeroAndTiesGoToTheSmallestMember) {
  const std::vector<Contact> contacts{{.i = 1, .j = 6}, {.i = 2, .j = 4}, {.i = 3, .j = 5}, {.i = 4, .j = 7}};
  // {2,4,7} has three members; {1,6} and {3,5} have two, 1 < 3; 0 and 8 are alone, 0 < 8.
  EXPECT_EQ(fragments(9, contacts), (Labels{3, 1, 0, 2, 0, 2, 1, 0, 4}));
  EXPECT_EQ(fragment_sizes(fragments(9, contacts)), (std::vector<std::int64_t>{3, 2, 2, 1, 1}));
}

TEST(Fragments, WithoutContactsEveryParticleIsAlone) {
  EXPECT_EQ(fragments(3, {}), (Labels{0, 1, 2}));
  EXPECT_TRUE(fragments(0, {}).empty());
}

TEST(Fragments, LongChainIsOnePieceAndCutInTheMiddleTwo) {
  auto contacts = shapes::chain_contacts(100001);
  EXPECT_EQ(fragment_sizes(fragments(100001, contacts)).size(), 1u);
  contacts.erase(contacts.begin() + 40000);  // separates 0..40000 from 40001..100000
  const auto sizes = fragment_sizes(fragments(100001, contacts));
  EXPECT_EQ(sizes, (std::vector<std::int64_t>{60000, 40001}));
}

TEST(Fragments, AContactBeyondTheLastParticleIsRefused) {
  const std::vector<Contact> contacts{{.i = 0, .j = 3}};
  EXPECT_THROW(fragments(3, contacts), std::invalid_argument);
}

}  // namespace
}  // namespace crumble
