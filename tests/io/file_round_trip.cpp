// What is written comes back, and nothing unfinished looks finished.
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <limits>

#include "common/io/agglomerate_reader.hpp"
#include "common/io/agglomerate_writer.hpp"
#include "common/io/sha256.hpp"
#include "common/numerics/blas.hpp"
#include "tests/io/sample_agglomerate.hpp"

namespace crumble::test {
namespace {

// A length goes through x * 1e9 / 1e9: two roundings of half a unit in the last place each.
constexpr double length_tolerance = 2 * std::numeric_limits<double>::epsilon();

void expect_same_length(const Vector3& a, const Vector3& b) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], length_tolerance * std::abs(b[k]));
}

void expect_same(const Frame& a, const Frame& b) {
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.time, b.time);
  ASSERT_EQ(a.position.size(), b.position.size());
  for (std::size_t k = 0; k < a.position.size(); ++k) {
    expect_same_length(a.position[k], b.position[k]);
    EXPECT_EQ(a.orientation[k].coeffs(), b.orientation[k].coeffs());
  }
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.angular_velocity, b.angular_velocity);
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.torque, b.torque);
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t k = 0; k < a.contacts.size(); ++k) {
    const Contact &x = a.contacts[k], &y = b.contacts[k];
    EXPECT_EQ(x.i, y.i);
    EXPECT_EQ(x.j, y.j);
    EXPECT_EQ(x.normal, y.normal);
    EXPECT_NEAR(x.gap, y.gap, length_tolerance * std::abs(y.gap));
    expect_same_length(x.sliding, y.sliding);
    EXPECT_EQ(x.rolling, y.rolling);
    EXPECT_EQ(x.twisting, y.twisting);
    EXPECT_EQ(x.normal_force, y.normal_force);
    EXPECT_EQ(x.sliding_force, y.sliding_force);
    EXPECT_EQ(x.twisting_torque, y.twisting_torque);
    EXPECT_EQ(x.rolling_torque, y.rolling_torque);
    EXPECT_EQ(x.at_limit, y.at_limit);
    EXPECT_EQ(x.born, y.born);
  }
}

TEST(AgglomerateFile, EveryFieldOfEveryFrameComesBack) {
  const Folder folder;
  write_sample(folder / "a.h5");
  const AgglomerateReader reader(folder / "a.h5");
  ASSERT_EQ(reader.frame_count(), static_cast<std::size_t>(sample_frames));
  for (int t = 0; t < sample_frames; ++t) expect_same(reader.frame(t), sample_frame(sample_size, 10 + 7 * t));
  const Particles particles = sample_particles(sample_size);
  EXPECT_EQ(reader.particles().mass, particles.mass);
  EXPECT_EQ(reader.particles().id, particles.id);
  EXPECT_EQ(reader.particles().species, particles.species);
  for (std::size_t k = 0; k < sample_size; ++k)
    EXPECT_NEAR(reader.particles().radius[k], particles.radius[k], length_tolerance * particles.radius[k]);
  EXPECT_THROW(reader.frame(sample_frames), InputError);
}

TEST(AgglomerateFile, SummarySaysWhatIsInside) {
  const Folder folder;
  write_sample(folder / "a.h5");
  const FileInfo info = read_info(folder / "a.h5");
  EXPECT_EQ(info.stage, "dryer");
  EXPECT_EQ(info.state, "drying");
  EXPECT_EQ(info.particles, sample_size);
  EXPECT_EQ(info.frames, 3u);
  EXPECT_EQ(info.contacts, sample_size - 2);
  EXPECT_EQ(info.last_step, 24);
  EXPECT_EQ(info.provenance.seed, 7u);
  EXPECT_EQ(info.provenance.command, "dryer 'a scene.toml' -o out.h5");
  EXPECT_EQ(info.provenance.blas, blas::description());
  EXPECT_EQ(info.provenance.created.size(), std::string("2022-01-01T00:00:00Z").size());
  const AgglomerateReader reader(folder / "a.h5");
  EXPECT_EQ(reader.resolved(), "a = 1\nb = \"é\"\n");
  EXPECT_EQ(reader.observable("wetted_count"), (std::vector<double>{0, 1, 2}));
  EXPECT_NEAR(reader.observable("droplet_radius").at(1), 99e-9, 1e-22);
  EXPECT_EQ(reader.observable("fragment_count"), (std::vector<double>{2, 2, 2}));
  EXPECT_EQ(reader.observable("semi_axes").size(), 9u);
}

TEST(AgglomerateFile, UnfinishedWriterLeavesTheOldFileAndNoOther) {
  const Folder folder;
  std::ofstream(folder / "a.h5") << "the earlier result";
  {
    AgglomerateWriter writer(folder / "a.h5", sample_particles(sample_size), sample_description());
    writer.append(sample_frame(sample_size, 1), sample_observables(0));
    EXPECT_TRUE(std::filesystem::exists(folder / "a.h5.tmp"));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.tmp"));
  EXPECT_EQ(std::filesystem::file_size(folder / "a.h5"), 18u);
}

TEST(AgglomerateFile, WriterRefusesWhatWouldMakeAnInvalidFile) {
  const Folder folder;
  const auto attempt = [&](auto change, const char* what) {
    AgglomerateWriter writer(folder / "a.h5", sample_particles(sample_size), sample_description());
    Frame frame = sample_frame(sample_size, 1);
    Observables observables = sample_observables(0);
    writer.append(frame, observables);
    frame = sample_frame(sample_size, 2);
    change(frame, observables);
    EXPECT_ANY_THROW(writer.append(frame, observables)) << what;
  };
  attempt([](Frame& f, Observables&) { f.step = 1; }, "same step");
  attempt([](Frame& f, Observables&) { f.time = 0; }, "time goes back");
  attempt([](Frame& f, Observables&) { f.position[3].y() = NAN; }, "NaN");
  attempt([](Frame& f, Observables&) { f.position.pop_back(); }, "fewer particles");
  attempt([](Frame& f, Observables&) { f.velocity.clear(); }, "field gone");
  attempt([](Frame& f, Observables&) { std::swap(f.contacts[0].i, f.contacts[0].j); }, "i > j");
  attempt([](Frame& f, Observables&) { f.contacts[1] = f.contacts[0]; }, "duplicate");
  attempt([](Frame& f, Observables&) { f.contacts[9].j = 12; }, "no such particle");
  attempt([](Frame&, Observables& o) { o[0].first = "droplet_raduis"; }, "unknown observable");
  attempt([](Frame&, Observables& o) { o.pop_back(); }, "observable gone");
  attempt([](Frame&, Observables& o) { o[0].second = INFINITY; }, "infinite observable");
  AgglomerateWriter writer(folder / "b.h5", sample_particles(sample_size), sample_description());
  EXPECT_THROW(writer.append(sample_frame(sample_size, 1)), std::logic_error) << "dryer without droplet";
}

TEST(AgglomerateFile, ThousandsOfFramesAndNoContactsAreFine) {
  const Folder folder;
  {
    AgglomerateWriter writer(folder / "a.h5", sample_particles(1), sample_description());
    for (int t = 0; t < 2000; ++t) writer.append(sample_frame(1, 1 + t), sample_observables(t % 2));
    writer.finish("dry");
  }
  const AgglomerateReader reader(folder / "a.h5");
  EXPECT_EQ(reader.frame_count(), 2000u);
  EXPECT_TRUE(reader.last_frame().contacts.empty());
  EXPECT_EQ(reader.last_frame().position[0].x(), reader.frame(1999).position[0].x());
}

// Ends the process, with 0 if the error came and nothing was left.
[[noreturn]] void write_to_a_full_disk(const std::filesystem::path& path) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{100000, 100000};
  setrlimit(RLIMIT_FSIZE, &limit);
  try {
    AgglomerateWriter writer(path, sample_particles(sample_size), sample_description());
    for (int t = 0; t < 500; ++t) writer.append(sample_frame(sample_size, 1 + t), sample_observables(t));
    writer.finish("dry");
  } catch (const WriteError& error) {
    std::fprintf(stderr, "refused: %s\n", error.what());
    _exit(std::filesystem::exists(path) || std::filesystem::exists(path.string() + ".tmp") ? 2 : 0);
  }
  _exit(1);
}

TEST(AgglomerateFileDeathTest, FullDiskIsAWriteErrorAndLeavesNothing) {
  const Folder folder;
  EXPECT_EXIT(write_to_a_full_disk(folder / "a.h5"), testing::ExitedWithCode(0), "refused: ");
}

TEST(Provenance, ParentIsNamedRelativeToTheFileAndHashed) {
  const Folder folder;
  std::filesystem::create_directory(folder / "sub");
  write_sample(folder / "parent.h5");
  FileDescription description = sample_description("agglomerate");
  description.provenance = make_provenance("agglomerate", {"agglomerate"}, 0, "none", folder / "parent.h5");
  AgglomerateWriter writer(folder / "sub/child.h5", sample_particles(2), description);
  writer.append(sample_frame(2, 1));
  writer.finish("relaxed");
  const Provenance provenance = read_info(folder / "sub/child.h5").provenance;
  EXPECT_EQ(provenance.parent, "../parent.h5");
  EXPECT_EQ(provenance.parent_sha256, sha256_of_file(folder / "parent.h5"));
}

TEST(Provenance, Sha256IsThePublishedOne) {
  // FIPS 180-2, appendix B.1 and the empty message.
  EXPECT_EQ(sha256_of_text("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of_text(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

}  // namespace
}  // namespace crumble::test
