// The table of the schema is consistent, and its page is the one that is stored.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "common/io/schema.hpp"

namespace crumble::test {
namespace {

using schema::Layout;

TEST(Schema, StoredPageIsTheGeneratedOne) {
  std::ifstream file(CRUMBLE_SOURCE_DIR "/common/io/SCHEMA.md");
  std::stringstream stored;
  stored << file.rdbuf();
  EXPECT_EQ(stored.str(), schema_page()) << "regenerate it: agglomerate schema > common/io/SCHEMA.md";
}

TEST(Schema, EachPathStandsOnceAndIsFoundByItsOwnName) {
  std::set<std::string_view> seen;
  for (const auto& entry : schema::table()) {
    EXPECT_TRUE(seen.insert(entry.path).second) << entry.path;
    EXPECT_EQ(schema::find(entry.path), &entry) << entry.path;
  }
  EXPECT_EQ(schema::find("/series/front_speed")->path, "/series/<name>");
  EXPECT_EQ(schema::find("/flows/shear/time")->path, "/flows/<name>/time");
  EXPECT_EQ(schema::find("/series"), nullptr);
  EXPECT_EQ(schema::find("/series/a/b"), nullptr);
}

TEST(Schema, EveryArrayOfFramesStartsWithTheFrames) {
  for (const auto& entry : schema::table()) {
    if (entry.layout == Layout::frames) {
      EXPECT_EQ(schema::words(entry.shape).at(0), "T") << entry.path;
    }
    if (!entry.values.empty()) {
      EXPECT_EQ(entry.type, hdf5::Type::text) << entry.path;
    }
  }
}

}  // namespace
}  // namespace crumble::test
