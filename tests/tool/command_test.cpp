// The command line: what it refuses, and the exit codes.
#include <gtest/gtest.h>

#include "common/io/schema.hpp"
#include "tests/tool/run_tool.hpp"

namespace crumble::test {
namespace {

TEST(AgglomerateCommand, HelpTeachesWithExamplesAndEndsWithZero) {
  const Folder folder;
  const Ran all = agglomerate(folder, "--help");
  EXPECT_EQ(all.code, 0);
  EXPECT_EQ(all.err, "");
  for (const std::string verb : {"check", "info", "compare", "import", "export", "morphology", "scale", "schema"}) {
    EXPECT_NE(all.out.find("\n  " + verb + " "), std::string::npos) << verb;
    const Ran one = agglomerate(folder, verb + " --help");
    EXPECT_EQ(one.code, 0);
    EXPECT_NE(one.out.find("Example"), std::string::npos) << verb;
    EXPECT_NE(one.out.find("agglomerate " + verb), std::string::npos) << verb;
  }
}

TEST(AgglomerateCommand, VersionNamesProgramAndCommit) {
  const Folder folder;
  const Ran ran = agglomerate(folder, "--version");
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.out.find("agglomerate "), 0u);
  EXPECT_NE(ran.out.find("commit "), std::string::npos);
  EXPECT_NE(ran.out.find("BLAS OpenBLAS "), std::string::npos);
}

TEST(AgglomerateCommand, EveryMisuseHasItsOwnMessageAndExitCodeTwo) {
  const Folder folder;
  write_sample(folder / "a.h5");
  write_text(folder / "p.csv", "x,y,z\n0,0,0\n");
  const std::pair<const char*, const char*> cases[] = {
      {"", "a verb is missing"},
      {"inspect a.h5", "unknown verb 'inspect'"},
      {"morpology a.h5", "did you mean 'morphology'?"},
      {"info", "FILE is required"},
      {"info a.h5 --jsn", "unknown argument '--jsn'; did you mean '--json'?"},
      {"info a.h5 b.h5", "one file is wanted, 2 are given, the second is 'b.h5'"},
      {"info nothing.h5", "nothing.h5"},
      {"morphology a.h5 --json --csv", "exclude each other"},
      {"morphology a.h5 --cdf --frame all", "--cdf is of one frame"},
      {"morphology a.h5 --frame first", "--frame first: must be all, last or a number from 0"},
      {"morphology a.h5 --frame 3", "the file has the frames 0 to 2"},
      {"export a.h5", "--output is required"},
      {"export a.h5 -o a.vtk", "-o a.vtk: must end with .xyz"},
      {"export a.h5 -o a.h5", "-o a.h5: must end with .xyz"},
      {"export a.h5 -o nowhere/a.xyz", "there is no folder 'nowhere'"},
      {"scale a.h5 -o b.h5", "--radius is required"},
      {"scale a.h5 --radius -1 -o b.h5", "--radius -1: must be a number > 0"},
      {"scale a.h5 --radius 10nm -o b.h5", "--radius 10nm: must be a number > 0"},
      {"scale a.h5 --radius 10 --poisson-ratio 0.7 -o b.h5", "--poisson-ratio 0.7: must be a number >= 0 and <= 0.5"},
      {"import p.csv --unit mm --radius 1 -o b.h5", "--unit mm: must be nm, um or m"},
      {"import p.csv --radius 1 --contact-tolerance 2 -o b.h5", "--contact-tolerance 2: must be"},
      {"import p.csv --radius inf -o b.h5", "--radius inf: must be"},
      {"import q.csv --radius 1 -o b.h5", "q.csv: cannot be opened"},
      {"import p.txt --radius 1 -o b.h5", "p.txt: expected a name that ends with .csv"},
  };
  for (const auto& [arguments, message] : cases) {
    const Ran ran = agglomerate(folder, arguments);
    EXPECT_EQ(ran.code, 2) << arguments;
    EXPECT_NE(ran.err.find(message), std::string::npos) << arguments << "\n" << ran.err;
    EXPECT_EQ(ran.out, "") << arguments;
    EXPECT_FALSE(std::filesystem::exists(folder / "b.h5")) << arguments;
    EXPECT_FALSE(std::filesystem::exists(folder / "b.h5.tmp")) << arguments;
  }
}

TEST(AgglomerateCommand, CheckTellsValidInvalidAndUnreadableApart) {
  const Folder folder;
  write_sample(folder / "good.h5");
  {
    const auto file = hdf5::File::modify((write_sample(folder / "bad.h5"), folder / "bad.h5"));
    file.dataset("/particles/all/radius").set_attribute("unit", "m");
  }
  write_text(folder / "text.h5", "x,y,z\n");
  const Ran good = agglomerate(folder, "check good.h5");
  EXPECT_EQ(good.code, 0);
  EXPECT_EQ(good.out, "good.h5: valid\n");
  const Ran bad = agglomerate(folder, "check good.h5 bad.h5");
  EXPECT_EQ(bad.code, 1);
  EXPECT_NE(bad.out.find("bad.h5: /particles/all/radius"), std::string::npos) << bad.out;
  EXPECT_NE(bad.out.find(": expected "), std::string::npos);
  EXPECT_NE(bad.out.find(", found "), std::string::npos);
  EXPECT_EQ(agglomerate(folder, "check text.h5 bad.h5 good.h5").code, 2);
  EXPECT_EQ(agglomerate(folder, "check none.h5").code, 2);
}

TEST(AgglomerateCommand, AFileOfAnotherFormatIsExitCodeThree) {
  const Folder folder;
  hdf5::File::create(folder / "other.h5").create_group("/data");
  const Ran ran = agglomerate(folder, "info other.h5");
  EXPECT_EQ(ran.code, 3);
  EXPECT_NE(ran.err.find("other.h5"), std::string::npos);
  write_text(folder / "p.csv", "x,y,z\n0,zero,0\n");
  const Ran points = agglomerate(folder, "import p.csv --radius 10 -o b.h5");
  EXPECT_EQ(points.code, 3);
  EXPECT_NE(points.err.find("p.csv:2: y: expected a number, found 'zero'"), std::string::npos) << points.err;
}

TEST(AgglomerateCommand, SchemaPrintsThePage) {
  const Folder folder;
  const Ran ran = agglomerate(folder, "schema");
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.out, schema_page());
}

}  // namespace
}  // namespace crumble::test
