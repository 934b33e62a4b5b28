#include "common/agglomerate/point_list.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace crumble {
namespace {

std::string complaint(PointList (*parse)(std::string_view, const std::string&), const std::string& text) {
  try {
    parse(text, "points");
  } catch (const PointListError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(PointList, CsvMayHaveCommentsBlankLinesAnyOrderAndForeignLineEnds) {
  const PointList p = parse_csv(
      "\xEF\xBB\xBF# two spheres\r\n\r\n Radius , z, Y ,x \r\n10,3,2,1 # first\r\n\r\n+2e1,-6.5,5,4\r\n", "points");
  ASSERT_EQ(p.position.size(), 2u);
  EXPECT_EQ(p.position[0], Vector3(1, 2, 3));
  EXPECT_EQ(p.position[1], Vector3(4, 5, -6.5));
  EXPECT_EQ(p.radius, (std::vector<double>{10, 20}));
  EXPECT_EQ(p.line, (std::vector<int>{4, 6}));
}

TEST(PointList, CsvMayHaveQuotesAndEmptyRowsAsSpreadsheetsWriteThem) {
  const PointList p = parse_csv("\"x\",\"y\",\"z\"\n\"1\",2,\"3\"\n,,\n4,5,6\n", "points");
  ASSERT_EQ(p.position.size(), 2u);
  EXPECT_EQ(p.position[0], Vector3(1, 2, 3));
  EXPECT_EQ(p.line, (std::vector<int>{2, 4}));
}

TEST(PointList, SemicolonsWithDecimalCommasAndADiameterAreReadAsTheSpreadsheetMeansThem) {
  for (const char separator : {';', '\t'}) {
    std::string text = "\xEF\xBB\xBFx;y;z;D\r\n1,5;-0,25;3;20\r\n\"2,5\";1,234;1e1;2,05e1\r\n;;;\r\n";
    std::replace(text.begin(), text.end(), ';', separator);
    const PointList p = parse_csv(text, "points");
    ASSERT_EQ(p.position.size(), 2u);
    EXPECT_EQ(p.position[0], Vector3(1.5, -0.25, 3));
    EXPECT_EQ(p.position[1], Vector3(2.5, 1.234, 10));  // 1.234, as 1,5 and others are no thousands
    EXPECT_EQ(p.radius, (std::vector<double>{10, 10.25}));
  }
}

TEST(PointList, SemicolonsWithDecimalPointsAreReadToo) {
  const PointList p = parse_csv("x;y;z;diameter\n1.234;2.5;3;4\n", "points");
  ASSERT_EQ(p.position.size(), 1u);
  EXPECT_EQ(p.position[0], Vector3(1.234, 2.5, 3));
  EXPECT_EQ(p.radius, std::vector<double>{2});
}

TEST(PointList, CsvWithoutRadiiHasNone) {
  const PointList p = parse_csv("x,y,z\n0,0,0", "points");
  EXPECT_EQ(p.position.size(), 1u);
  EXPECT_TRUE(p.radius.empty());
}

TEST(PointList, PlainXyzTakesTheThreeNumbersBehindTheLabel) {
  const PointList p = parse_xyz("2\n\nSi 1 2 3 charge\nSi 4 5 6\n\n", "points");
  ASSERT_EQ(p.position.size(), 2u);
  EXPECT_EQ(p.position[1], Vector3(4, 5, 6));
  EXPECT_EQ(p.line, (std::vector<int>{3, 4}));
}

TEST(PointList, ExtendedXyzFindsItsColumnsByName) {
  const PointList p = parse_xyz(
      "1\nLattice=\"1 0 0 0 1 0 0 0 1\" Properties=id:I:1:Radius:R:1:species:S:1:pos:R:3 Time=0\n7 10 A 1 2 3\n",
      "points");
  ASSERT_EQ(p.position.size(), 1u);
  EXPECT_EQ(p.position[0], Vector3(1, 2, 3));
  EXPECT_EQ(p.radius, std::vector<double>{10});
}

TEST(PointList, OfSeveralXyzFramesTheLastIsTaken) {
  const PointList p = parse_xyz("1\n\nA 1 2 3\n2\n\nA 4 5 6\nA 7 8 9\n", "points");
  EXPECT_EQ(p.frames, 2);
  ASSERT_EQ(p.position.size(), 2u);
  EXPECT_EQ(p.position[0], Vector3(4, 5, 6));
}

struct Case {
  PointList (*parse)(std::string_view, const std::string&);
  std::string text, message;
};

TEST(PointList, EveryMalformedTextHasItsOwnMessageWithFileAndLine) {
  const Case cases[] = {
      {parse_csv, "", "points:1: expected a header x,y,z[,radius or diameter], found no text"},
      {parse_csv, "# nothing\n\n", "points:2: expected a header x,y,z[,radius or diameter], found no text"},
      {parse_csv, "1,2,3\n",
       "points:1: expected a header of the columns x,y,z[,radius or diameter], found the column '1'"},
      {parse_csv, "x;y;z,radius\n",
       "points:1: expected a header of the columns x,y,z[,radius or diameter], found the column 'z,radius'"},
      {parse_csv, "x;y;z\n1,2,3\n", "points:2: expected 3 values as in the header, found 1"},
      {parse_csv, "x;y;z\n1,5;2;3\n4;5;6.5\n",
       "points: '1,5' on line 2 has a comma and '6.5' on line 3 a point: write all numbers with the same decimal sign, "
       "and without signs between thousands"},
      {parse_csv, "x;y;z\n1.234,5;2,5;3\n", "points:2: x: expected a number, found '1.234,5'"},
      {parse_csv, "x\ty\tz\n1,234\t2\t-123,456\n",
       "points: '1,234' on line 2 may be a thousand or have a decimal comma, and no other number says which: write "
       "numbers "
       "with points"},
      {parse_csv, "x;y;z;D\n1,5;2;3;0,0\n", "points:2: diameter: expected a diameter > 0, found '0,0'"},
      {parse_csv, "x,y,z,r\n",
       "points:1: expected a header of the columns x,y,z[,radius or diameter], found the column 'r' (radius or "
       "diameter? "
       "Write the word)"},
      {parse_csv, "x,y,z,radius,D\n", "points:1: both a radius and a diameter stand in the header: leave one out"},
      {parse_csv, "x,y,z,D,diameter\n", "points:1: the column diameter stands twice in the header"},
      {parse_csv, "x,y,z\n1,5,2,5,3,5\n",
       "points:2: expected 3 values as in the header, found 6 (write numbers with points, or separate columns by "
       "semicolons)"},
      {parse_csv, std::string("\xFF\xFEx\0,\0", 6),
       "points: is UTF-16, as spreadsheets write \"Unicode text\": save it as UTF-8"},
      {parse_csv, std::string("x,y,z\n1,2,\0", 12), "points: holds zero bytes, so it is no text"},
      {parse_csv, "x,y,z\r1,2,3\r",
       "points: ends its lines with CR alone, as old programs do: save it with LF or CRLF"},
      {parse_csv, "x,y,radius\n", "points:1: expected a header of the columns x,y,z[,radius or diameter], found no z"},
      {parse_csv, "x,y,z,x\n", "points:1: the column x stands twice in the header"},
      {parse_csv, "x,y,z\n", "points:1: expected at least one sphere below the header, found none"},
      {parse_csv, "x,y,z\n1,2\n", "points:2: expected 3 values as in the header, found 2"},
      {parse_csv, "x,y,z\n1,2,3\n1,2,3,4\n", "points:3: expected 3 values as in the header, found 4"},
      {parse_csv, "x,y,z\n1,2,three\n", "points:2: z: expected a number, found 'three'"},
      {parse_csv, "x,y,z\n1,,3\n", "points:2: y: expected a number, found ''"},
      {parse_csv, "x,y,z\n1,2,3.0nm\n", "points:2: z: expected a number, found '3.0nm'"},
      {parse_csv, "x,y,z\nnan,2,3\n", "points:2: x: expected a finite number, found 'nan'"},
      {parse_csv, "x,y,z\n1e999,2,3\n", "points:2: x: expected a number, found '1e999'"},
      {parse_csv, "x,y,z,radius\n1,2,3,0\n", "points:2: radius: expected a radius > 0, found '0'"},
      {parse_csv, "x,y,z,radius\n1,2,3,-4\n", "points:2: radius: expected a radius > 0, found '-4'"},
      {parse_xyz, "", "points:1: expected the number of spheres, found no text"},
      {parse_xyz, "two\n\n", "points:1: expected the number of spheres, found 'two'"},
      {parse_xyz, "0\n\n", "points:1: expected the number of spheres, found '0'"},
      {parse_xyz, "-1\n\n", "points:1: expected the number of spheres, found '-1'"},
      {parse_xyz, "2\n", "points:1: expected a comment line behind the number of spheres, found the end of the file"},
      {parse_xyz, "2\n\nA 1 2 3\n", "points:3: expected 2 spheres, found the end of the file after 1"},
      {parse_xyz, "1\n\nA 1 2\n", "points:3: expected a label and x y z, found 'A 1 2'"},
      {parse_xyz, "1\n\nA 1 2 x\n", "points:3: z: expected a number, found 'x'"},
      {parse_xyz, "1\n\nA 1 2 3\n1\n",
       "points:4: expected a comment line behind the number of spheres, found the end "
       "of the file"},
      {parse_xyz, "1\nProperties=pos:R\n1 2 3\n",
       "points:2: Properties: expected triplets name:type:columns, found "
       "'pos:R'"},
      {parse_xyz, "1\nProperties=id:I:1\n1\n",
       "points:2: Properties: expected pos:R:3 among the columns, found "
       "'id:I:1'"},
      {parse_xyz, "1\nProperties=pos:R:2\n1 2\n", "points:2: Properties: expected pos:R:3, found 'pos:R:2'"},
      {parse_xyz, "1\nProperties=pos:R:3:radius:R:3\n1 2\n",
       "points:2: Properties: expected radius:R:1, found 'pos:R:3:radius:R:3'"},
      {parse_xyz, "1\nProperties=pos:R:all\n1 2\n",
       "points:2: Properties: expected a number of columns for 'pos', found 'all'"},
      {parse_xyz, "1\nProperties=id:I:1:pos:R:3\n1 2 3\n",
       "points:3: expected 4 columns as declared by Properties, found '1 2 3'"},
  };
  for (const Case& c : cases) EXPECT_EQ(complaint(c.parse, c.text), c.message);
}

TEST(PointList, FilesThatCannotBeReadAreNamed) {
  const auto message = [](const std::string& file) -> std::string {
    try {
      read_points(file);
    } catch (const PointListError& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message("no_such.csv"), "no_such.csv: cannot be opened for reading");
  // It never ends.
  const std::string device =
      (std::filesystem::temp_directory_path() / ("crumble-" + std::to_string(getpid()) + ".csv"));
  std::filesystem::create_symlink("/dev/zero", device);
  EXPECT_EQ(message(device), device + ": is a device, not a file");
  std::filesystem::remove(device);
  EXPECT_EQ(message("points.txt"), "points.txt: expected a name that ends with .csv, .xyz or .extxyz");
}

}  // namespace
}  // namespace crumble
