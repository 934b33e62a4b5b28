// compare: what differs, and by more than the stated errors.
#include <gtest/gtest.h>

#include "tests/tool/run_tool.hpp"

namespace crumble::test {
namespace {

struct Made {
  double d_c = 0, stress = 0;  // relative errors; a critical stress, Pa
  double stretch = 1;          // of all positions but the first
  std::string resolved = "[droplet]\nradius = 1e-07\n";
  std::uint64_t seed = 7;
};

// One particle alone, so that stretching it breaks no contact, and a chain.
void write(const std::filesystem::path& path, const Made& m) {
  const Particles particles = sample_particles(sample_size);
  AgglomerateWriter writer(path, particles,
                           {"dryer", make_provenance("dryer", {"dryer"}, m.seed, philox), "", m.resolved});
  Frame frame = sample_frame(sample_size, 10);
  frame.contacts.clear();
  for (Vector3& x : frame.position) x *= m.stretch;
  writer.append(frame, sample_observables(0));
  if (m.d_c > 0) writer.put("/errors/d_c", m.d_c);
  if (m.stress > 0) writer.put("/breakup/critical_stress", m.stress);
  if (m.stress > 0) writer.put("/errors/critical_stress", 0.01);
  writer.finish("dry");
}

std::string line_of(const std::string& text, const std::string& name) {
  const auto at = text.find("  " + name + " ");
  return at == text.npos ? "" : text.substr(at, text.find('\n', at) - at);
}

TEST(AgglomerateCompare, AFileEqualsItselfAndACopyThatWasMadeAnew) {
  const Folder folder;
  write(folder / "a.h5", {.d_c = 1e-3, .stress = 100});
  write(folder / "b.h5", {.d_c = 1e-3, .stress = 100});
  const Ran ran = agglomerate(folder, "compare a.h5 b.h5");
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
  EXPECT_NE(ran.out.find("scene: the same"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("provenance: the same"), std::string::npos) << ran.out;
}

TEST(AgglomerateCompare, ADifferenceIsMeasuredByTheErrorsOfBothFiles) {
  const Folder folder;
  write(folder / "a.h5", {.stress = 100});
  write(folder / "near.h5", {.stress = 101.9});
  write(folder / "far.h5", {.stress = 102.1});
  const Ran near = agglomerate(folder, "compare a.h5 near.h5"), far = agglomerate(folder, "compare a.h5 far.h5");
  EXPECT_EQ(near.code, 0) << near.out;
  EXPECT_NE(line_of(near.out, "critical_stress_pa").find("within the errors"), std::string::npos) << near.out;
  EXPECT_EQ(far.code, 1);
  EXPECT_NE(line_of(far.out, "critical_stress_pa").find("differs by more than the errors"), std::string::npos)
      << far.out;
}

TEST(AgglomerateCompare, WithoutAStatedErrorAnyDifferenceIsOne) {
  const Folder folder;
  write(folder / "a.h5", {.d_c = 0.1});
  write(folder / "b.h5", {.d_c = 0.1, .stretch = 1.01});
  const Ran ran = agglomerate(folder, "compare a.h5 b.h5");
  EXPECT_EQ(ran.code, 1);
  EXPECT_NE(line_of(ran.out, "d_c_nm").find("within the errors"), std::string::npos) << ran.out;
  EXPECT_NE(line_of(ran.out, "radius_of_gyration_nm").find("not stated"), std::string::npos) << ran.out;
}

TEST(AgglomerateCompare, SceneAndProvenanceAreToldKeyByKey) {
  const Folder folder;
  write(folder / "a.h5", {});
  write(folder / "b.h5", {.resolved = "[droplet]\nradius = 2e-07\nlifetime = 1\n", .seed = 8});
  const Ran ran = agglomerate(folder, "compare a.h5 b.h5");
  EXPECT_NE(line_of(ran.out, "droplet.radius").find("1e-07 | 2e-07"), std::string::npos) << ran.out;
  EXPECT_NE(line_of(ran.out, "droplet.lifetime").find("not set | 1"), std::string::npos) << ran.out;
  EXPECT_NE(line_of(ran.out, "seed").find("7 | 8"), std::string::npos) << ran.out;
  EXPECT_EQ(ran.code, 0);  // what they came to is the same
}

TEST(AgglomerateCompare, ExitCodesOfTheManualStayTrue) {
  const Folder folder;
  write(folder / "a.h5", {});
  hdf5::File::create(folder / "other.h5").create_group("/data");
  EXPECT_EQ(agglomerate(folder, "compare a.h5").code, 2);
  EXPECT_EQ(agglomerate(folder, "compare a.h5 none.h5").code, 2);
  EXPECT_EQ(agglomerate(folder, "compare a.h5 other.h5").code, 3);
}

}  // namespace
}  // namespace crumble::test
