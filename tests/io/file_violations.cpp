// Every rule of the schema has a file that breaks it, and the checker says which and where.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <numeric>

#include "common/io/agglomerate_reader.hpp"
#include "common/io/checker.hpp"
#include "common/io/hdf5.hpp"
#include "tests/io/sample_agglomerate.hpp"

namespace crumble::test {
namespace {

using hdf5::File;

const std::string position = "/particles/all/position/value";
const std::string module_path = "/h5md/modules/agglomerate";

template <class T>
void change(File& file, const std::string& path, std::size_t k, T value) {
  auto dataset = file.dataset(path);
  auto values = dataset.read<T>();
  values.at(k) = value;
  dataset.write<T>(values);
}

template <class T>
void replace(File& file, const std::string& path, const hdf5::Shape& shape, const std::string& unit = "") {
  file.unlink(path);
  auto dataset = file.create_dataset<T>(path, shape);
  dataset.template write<T>(std::vector<T>(hdf5::element_count(shape)));
  if (!unit.empty()) dataset.set_attribute("unit", unit);
}

template <class T>
void add(File& file, const std::string& path, const hdf5::Shape& shape, const std::vector<T>& values,
         const std::string& unit = "") {
  auto dataset = file.create_dataset<T>(path, shape);
  dataset.template write<T>(values);
  if (!unit.empty()) dataset.set_attribute("unit", unit);
}

// The row of the first frame with the largest gap: by JKR it has the largest force.
std::size_t widest(File& file) {
  const auto gap = file.dataset("/contacts/gap").read_rows<double>(0, 10);
  return static_cast<std::size_t>(std::max_element(gap.begin(), gap.end()) - gap.begin());
}

void set_version(File& file, int major, int minor) {
  const std::array<std::int32_t, 2> version{major, minor};
  file.group(module_path).set_attribute<std::int32_t>("version", version);
}

struct Mutation {
  const char* name;
  std::function<void(File&)> apply;
  const char* message;  // that one of the violations must contain; the readers refuse the file, too
};

std::ostream& operator<<(std::ostream& out, const Mutation& mutation) { return out << mutation.name; }

const Mutation mutations[] = {
    {"WrongUnit", [](File& f) { f.dataset(position).set_attribute("unit", "m"); },
     "/particles/all/position/value@unit: expected 'nm', found 'm'"},
    {"MissingUnit", [](File& f) { replace<double>(f, "/contacts/gap", {30}); },
     "/contacts/gap@unit: expected 'nm', found nothing"},
    {"UnitOfADimensionlessArray", [](File& f) { f.dataset("/contacts/normal").set_attribute("unit", "nm"); },
     "/contacts/normal@unit: expected no unit (dimensionless), found 'nm'"},
    {"UnitIsANumber",
     [](File& f) {
       const std::array<double, 1> one{1};
       f.dataset(position).set_attribute<double>("unit", one);
     },
     "/particles/all/position/value@unit: expected text, found float64"},
    {"NotANumber", [](File& f) { change<double>(f, position, 3 * 12 + 3 * 2 + 1, NAN); },
     "/particles/all/position/value[1][2][1]: expected a finite number, found nan"},
    {"Infinity", [](File& f) { change<double>(f, "/contacts/normal_force", 4, INFINITY); },
     "/contacts/normal_force[4]: expected a finite number, found inf"},
    {"SwappedPair",
     [](File& f) {
       change<std::int32_t>(f, "/contacts/pair", 0, 1);
       change<std::int32_t>(f, "/contacts/pair", 1, 0);
     },
     "/contacts/pair[0]: expected 0 <= i < j < 12, found 1 0"},
    {"PairOfNoParticle", [](File& f) { change<std::int32_t>(f, "/contacts/pair", 59, 12); },
     "/contacts/pair[29]: expected 0 <= i < j < 12, found 10 12"},
    {"DuplicatePair",
     [](File& f) {
       change<std::int32_t>(f, "/contacts/pair", 2, 0);
       change<std::int32_t>(f, "/contacts/pair", 3, 1);
     },
     "/contacts/pair[1]: expected each pair once in a frame, found 0 1 again"},
    {"UnsortedPairs",
     [](File& f) {
       change<std::int32_t>(f, "/contacts/pair", 0, 8);
       change<std::int32_t>(f, "/contacts/pair", 1, 11);
     },
     "/contacts/pair[1]: expected a pair after 8 11 (sorted), found 1 2"},
    {"NewerMajorVersion", [](File& f) { set_version(f, 2, 0); },
     "/h5md/modules/agglomerate@version: expected 1.0 to 1.2, found 2.0"},
    {"OlderMajorVersion", [](File& f) { set_version(f, 0, 9); },
     "/h5md/modules/agglomerate@version: expected 1.0 to 1.2, found 0.9"},
    {"NewerMinorVersion", [](File& f) { set_version(f, 1, 3); },
     "/h5md/modules/agglomerate@version: expected 1.0 to 1.2, found 1.3"},
    {"VersionIsText", [](File& f) { f.group(module_path).set_attribute("version", "1.0"); },
     "/h5md/modules/agglomerate@version: expected int32, found text"},
    {"NoModule", [](File& f) { f.unlink(module_path); }, "/h5md/modules/agglomerate: expected a group, found nothing"},
    {"NotH5md", [](File& f) { f.unlink("/h5md"); }, "/h5md/modules/agglomerate: expected a group, found nothing"},
    {"UnknownStage", [](File& f) { f.group(module_path).set_attribute("stage", "drier"); },
     "@stage: expected one of: dryer breaker rigidstress agglomerate, found 'drier'"},
    {"UnknownState", [](File& f) { f.group(module_path).set_attribute("state", "wet"); },
     "@state: expected one of: drying dry relaxed broken, found 'wet'"},
    {"Incomplete",
     [](File& f) {
       const std::array<std::uint8_t, 1> zero{0};
       f.group(module_path).set_attribute<std::uint8_t>("complete", zero, true);
     },
     "/h5md/modules/agglomerate@complete: expected 1, found 0"},
    {"MissingDataset", [](File& f) { f.unlink("/contacts/normal_force"); },
     "/contacts/normal_force: expected a dataset, found nothing"},
    {"MissingObservableOfTheStage", [](File& f) { f.unlink("/observables/droplet_radius"); },
     "/observables/droplet_radius: expected a group of step, time and value, found nothing"},
    {"MissingAttribute", [](File& f) { f.group("/particles/all").unlink("box"); },
     "/particles/all/box: expected a group, found nothing"},
    {"GroupInsteadOfDataset",
     [](File& f) {
       f.unlink("/particles/all/mass");
       f.create_group("/particles/all/mass");
     },
     "/particles/all/mass: expected a dataset, found a group"},
    {"DatasetInsteadOfGroup",
     [](File& f) {
       replace<double>(f, "/particles/all/position", {3, 12, 3}, "nm");
     },
     "/particles/all/position: expected a group of step, time and value, found a dataset"},
    {"WrongType",
     [](File& f) {
       replace<double>(f, "/contacts/pair", {30, 2});
     },
     "/contacts/pair: expected int32, found float64"},
    {"WrongRank",
     [](File& f) {
       replace<double>(f, "/contacts/gap", {30, 1}, "nm");
     },
     "/contacts/gap: expected shape [M=30], found [30][1]"},
    {"WrongWidth",
     [](File& f) {
       replace<double>(f, "/contacts/sliding", {30, 2}, "nm");
     },
     "/contacts/sliding: expected shape [M=30][3], found [30][2]"},
    {"FewerParticles", [](File& f) { replace<double>(f, "/particles/all/mass", {11}, "kg"); },
     "/particles/all/mass: expected shape [N=12], found [11]"},
    {"FewerFrames", [](File& f) { replace<double>(f, "/observables/capillary_force/value", {2}, "N"); },
     "/observables/capillary_force/value: expected shape [T=3], found [2]"},
    {"FewerContacts", [](File& f) { replace<std::int64_t>(f, "/contacts/born", {29}); },
     "/contacts/born: expected shape [M=30], found [29]"},
    {"StepRepeats", [](File& f) { change<std::int64_t>(f, "/particles/all/position/step", 1, 10); },
     "/particles/all/position/step[1]: expected more than the 10 before, found 10"},
    {"TimeGoesBack", [](File& f) { change<double>(f, "/particles/all/position/time", 2, 1e-9); },
     "/particles/all/position/time[2]: expected more than the"},
    {"SeriesTimeGoesBack", [](File& f) { change<double>(f, "/series/front_speed/time", 3, 0); },
     "/series/front_speed/time[3]: expected more than the"},
    {"OtherInstants", [](File& f) { replace<double>(f, "/observables/semi_axes/time", {3}, "s"); },
     "/observables/semi_axes/time: expected the values of /particles/all/position/time, found others"},
    {"NormalNotOfLengthOne", [](File& f) { change<double>(f, "/contacts/normal", 3 * 7, 2.0); },
     "/contacts/normal[7]: expected length 1 within 1e-9, found 2."},
    {"QuaternionNotOfLengthOne",
     [](File& f) { change<double>(f, "/particles/all/orientation/value", 4 * (12 + 5), -3.0); },
     "/particles/all/orientation/value[1][5]: expected length 1 within 1e-9, found 3."},
    {"OffsetDoesNotStartAtZero", [](File& f) { change<std::int64_t>(f, "/contacts/offset", 0, 1); },
     "/contacts/offset[0]: expected 0, found 1"},
    {"OffsetGoesBack", [](File& f) { change<std::int64_t>(f, "/contacts/offset", 2, 5); },
     "/contacts/offset[2]: expected at least the 10 before, found 5"},
    {"OffsetDoesNotEndAtTheLastContact", [](File& f) { change<std::int64_t>(f, "/contacts/offset", 3, 29); },
     "/contacts/offset[3]: expected 30, the number of contacts, found 29"},
    {"OffsetFarOutside", [](File& f) { change<std::int64_t>(f, "/contacts/offset", 1, INT64_MIN); },
     "/contacts/offset[1]: expected at least the 0 before"},
    {"WrongContactCount", [](File& f) { change<std::int64_t>(f, "/observables/contact_count/value", 2, 9); },
     "/observables/contact_count/value[2]: expected 10, found 9"},
    {"WrongLargestFragment", [](File& f) { change<std::int64_t>(f, "/observables/largest_fragment/value", 0, 12); },
     "/observables/largest_fragment/value[0]: expected 7, found 12"},
    {"WrongFragmentCount", [](File& f) { change<std::int64_t>(f, "/observables/fragment_count/value", 1, 1); },
     "/observables/fragment_count/value[1]: expected 2, found 1"},
    {"WrongCoordination", [](File& f) { change<double>(f, "/observables/coordination_number/value", 1, 2); },
     "/observables/coordination_number/value[1]: expected 1.66666"},
    {"ConnectivityOfAnotherFrame", [](File& f) { change<std::int32_t>(f, "/connectivity/contacts", 0, 5); },
     "/connectivity/contacts: expected the pairs of the last frame, found others"},
    {"NoMass", [](File& f) { change<double>(f, "/particles/all/mass", 3, 0); },
     "/particles/all/mass[3]: expected a positive number, found 0"},
    {"NegativeRadius", [](File& f) { change<double>(f, "/particles/all/radius", 11, -1); },
     "/particles/all/radius[11]: expected a positive number, found -1"},
    {"NameTwice", [](File& f) { change<std::int64_t>(f, "/particles/all/id", 1, 100); },
     "/particles/all/id[1]: expected each name once, found 100 again"},
    {"TrajectoryIsNoLink",
     [](File& f) {
       f.unlink("/particles/trajectory");
       f.create_group("/particles/trajectory");
     },
     "/particles/trajectory: expected a soft link to 'all', found something else"},
    {"LinkInACircle",
     [](File& f) {
       f.unlink("/contacts/gap");
       f.soft_link("/contacts/circle", "/contacts/gap");
       f.soft_link("/contacts/gap", "/contacts/circle");
     },
     "/contacts/gap: expected a dataset, found nothing"},
    {"GroupInsideItself",
     [](File& f) {
       f.unlink("/observables");
       f.create_group("/observables");
       f.hard_link("/observables", "/observables/semi_axes");
     },
     "/observables/semi_axes/value: expected a dataset, found nothing"},
    {"HugeDeclaredSize",
     [](File& f) {
       f.unlink(position);
       auto dataset = f.create_dataset<double>(position, {3, 12, 3}, 1);
       dataset.resize_rows(1ull << 50);
       dataset.set_attribute("unit", "nm");
     },
     "/particles/all/position/value: expected [1125899906842624][12][3] as declared, found less data in the file"},
    {"FlatObservableExpected", [](File& f) { f.create_group("/observables/mine/deeper"); },
     "/observables/mine: expected a group with a dataset 'value', found none"},
    {"UnknownObservableOfAnotherLength",
     [](File& f) { f.create_dataset<double>("/observables/mine/value", {7}).write<double>(std::vector<double>(7)); },
     "/observables/mine/value: expected shape [T=3]..., found [7]"},
    {"ParticlesAtOnePlace",
     [](File& f) {
       for (std::size_t d = 0; d < 3; ++d)
         change<double>(f, position, 3 * 5 + d, f.dataset(position).read<double>()[3 * 9 + d]);
     },
     "/particles/all/position/value[0][9]: expected particles beside each other"},
    {"GapOfAnotherDistance", [](File& f) { change<double>(f, "/contacts/gap", 12, 0.5); },
     "/contacts/gap[12]: expected -"},
    {"TornContact",
     [](File& f) {
       change<double>(f, position, 3 * 11, 18.0 * 11 + 500);
       const auto x = f.dataset(position).read<double>();
       const auto a = f.dataset("/particles/all/radius").read<double>();
       const Vector3 line(x[33] - x[30], x[34] - x[31], x[35] - x[32]);
       change<double>(f, "/contacts/gap", 9, line.norm() - a[10] - a[11]);
     },
     "/contacts/gap[9]: expected less than a radius"},
    {"ReversedNormal",
     [](File& f) {
       for (std::size_t d = 0; d < 3; ++d)
         change<double>(f, "/contacts/normal", 3 * 4 + d, -f.dataset("/contacts/normal").read<double>()[3 * 4 + d]);
     },
     "/contacts/normal[4]: expected 0."},
    {"ForceOfAnotherGap", [](File& f) { change<double>(f, "/contacts/normal_force", widest(f), -1e-8); },
     "that JKR makes of row"},
    {"SlidingAlongTheNormal",
     [](File& f) {
       for (std::size_t d = 0; d < 3; ++d)
         change<double>(f, "/contacts/sliding", d, f.dataset("/contacts/normal").read<double>()[d]);
     },
     "/contacts/sliding[0]: expected a vector across the normal, found 1 of it along the normal"},
    {"UnknownFlag", [](File& f) { change<std::uint8_t>(f, "/contacts/flags", 2, 8); },
     "/contacts/flags[2]: expected bits 0 to 2, found 8"},
    {"BornLater", [](File& f) { change<std::int64_t>(f, "/contacts/born", 3, 11); },
     "/contacts/born[3]: expected a step from 0 to 10, found 11"},
    {"WrongGyration", [](File& f) { change<double>(f, "/observables/radius_of_gyration/value", 1, 1); },
     "/observables/radius_of_gyration/value[1]: expected "},
    {"WrongAxis", [](File& f) { change<double>(f, "/observables/semi_axes/value", 4, 1); },
     "/observables/semi_axes/value[1][1]: expected "},
    {"MoreWettedThanThereAre", [](File& f) { change<std::int64_t>(f, "/observables/wetted_count/value", 2, 13); },
     "/observables/wetted_count/value[2]: expected 0 to 12, found 13"},
    {"NegativeDropletRadius", [](File& f) { change<double>(f, "/observables/droplet_radius/value", 2, -1); },
     "/observables/droplet_radius/value[2]: expected 0 or more, found -1"},
    {"MassOfNoMaterial", [](File& f) { change<double>(f, "/particles/all/mass", 0, 1e-12); },
     "/particles/all/mass[0]: expected a density from 1 to 100000 kg/m3"},
    {"RadiusInMetres", [](File& f) { change<double>(f, "/particles/all/radius", 0, 1e-8); },
     "/particles/all/radius[0]: expected 0.1 to 1e+07, found 1e-08"},
    {"LabelOfAnotherFragment",
     [](File& f) {
       std::vector<std::int32_t> labels(36);
       for (std::size_t k = 0; k < 36; ++k) labels[k] = k % 12 < 5;
       labels[0] = 0;
       f.create_group("/particles/all/fragment");
       f.hard_link("/particles/all/position/step", "/particles/all/fragment/step");
       f.hard_link("/particles/all/position/time", "/particles/all/fragment/time");
       add<std::int32_t>(f, "/particles/all/fragment/value", {3, 12}, labels);
     },
     "/particles/all/fragment/value[0][0]: expected 1, the part that its contacts put it in, found 0"},
    {"UnknownEvent", [](File& f) { add<std::int32_t>(f, "/events/kind", {1}, {6}); },
     "/events/kind[0]: expected 0 to 5, found 6"},
    {"EventsGoBack",
     [](File& f) {
       add<double>(f, "/events/time", {2}, {2, 1}, "s");
     },
     "/events/time[1]: expected at least the 2 before, found 1"},
    {"EventOfNoParticle",
     [](File& f) {
       add<std::int32_t>(f, "/events/pair", {2, 2}, {-1, -1, 3, 12});
     },
     "/events/pair[1]: expected 0 <= i < j < 12, or -1 -1, found 3 12"},
    {"FragmentsRise",
     [](File& f) {
       add<std::int64_t>(f, "/events/fragment_offset", {2}, {0, 2});
       add<std::int64_t>(f, "/events/fragment_sizes", {2}, {3, 9});
     },
     "/events/fragment_sizes[1]: expected at most the 3 before, found 9"},
    {"MorePartsThanParticles",
     [](File& f) {
       add<std::int64_t>(f, "/events/fragment_offset", {2}, {0, 2});
       add<std::int64_t>(f, "/events/fragment_sizes", {2}, {9, 9});
     },
     "/events/fragment_sizes[1]: expected no more than 12 particles together, found 18"},
    {"PorosityAboveOne", [](File& f) { add<double>(f, "/morphology/porosity", {}, {1.5}); },
     "/morphology/porosity: expected 0 to 1, found 1.5"},
    {"RadialPositionsOfOthers",
     [](File& f) { add<double>(f, "/morphology/radial_position", {12}, std::vector<double>(12, 3.0), "nm"); },
     "/morphology/radial_position[0]: expected "},
    {"NegativeSelfStress", [](File& f) { add<double>(f, "/closing/residual_rms", {}, {-1}, "N"); },
     "/closing/residual_rms: expected 0 or more, found -1"},
    {"ScaledToNothing", [](File& f) { add<double>(f, "/closing/scale", {}, {0}); },
     "/closing/scale: expected a positive number, found 0"},
    {"FlowThatIsCompressed",
     [](File& f) {
       add<double>(f, "/flow/gradient", {3, 3}, {1, 0, 0, 0, 0, 0, 0, 0, 0});
     },
     "/flow/gradient: expected a trace of 0: the fluid is incompressible, found 1"},
    {"ShareAboveOne", [](File& f) { add<double>(f, "/flows/shear/share", {1}, {2}); },
     "/flows/shear/share[0]: expected 0 to 1, found 2"},
    {"BasisThatIsNone",
     [](File& f) {
       add<double>(f, "/response/basis", {5, 3, 3}, std::vector<double>(45));
     },
     "/response/basis[0]: expected orthonormal symmetric tensors"},
    {"ResponseOfNoContact",
     [](File& f) {
       add<std::int32_t>(f, "/response/pair", {1, 2}, {2, 2});
     },
     "/response/pair[0]: expected 0 <= i < j < 12, found 2 2"},
    {"NoSeed",
     [](File& f) {
       f.unlink("/parameters/provenance");
       f.create_group("/parameters/provenance").set_attribute("seed", "seven");
     },
     "/parameters/provenance@seed: expected uint64, found text"},
};

class Violations : public testing::TestWithParam<Mutation> {};

TEST_P(Violations, AreNamed) {
  const Folder folder;
  const auto path = folder / "a.h5";
  write_sample(path);
  ASSERT_TRUE(check_file(path).empty());
  {
    File file = File::modify(path);
    GetParam().apply(file);
    file.close();
  }
  std::string all;
  for (const auto& violation : check_file(path)) all += violation.text() + "\n";
  EXPECT_NE(all.find(GetParam().message), std::string::npos) << "found instead:\n" << all;
  EXPECT_THROW(AgglomerateReader{path}, ContentError);
  EXPECT_THROW(read_agglomerate(path), ContentError);
  EXPECT_THROW(read_info(path), ContentError);
}

INSTANTIATE_TEST_SUITE_P(File, Violations, testing::ValuesIn(mutations),
                         [](const auto& mutation) { return std::string(mutation.param.name); });

// What cannot be opened at all.
void expect_open_error(const std::filesystem::path& path, const std::string& message) {
  for (const auto& attempt :
       {std::function<void()>([&] { check_file(path); }), std::function<void()>([&] { read_agglomerate(path); })}) {
    try {
      attempt();
      ADD_FAILURE() << "opened " << path;
    } catch (const OpenError& error) {
      EXPECT_NE(std::string(error.what()).find(path.string() + ": " + message), std::string::npos) << error.what();
    }
  }
}

TEST(Violation, OfAFileThatCannotBeOpenedSaysWhy) {
  const Folder folder;
  expect_open_error(folder / "none.h5", "no such file");
  std::filesystem::create_directory(folder / "folder.h5");
  expect_open_error(folder / "folder.h5", "is a directory");
  std::ofstream(folder / "empty.h5").flush();
  expect_open_error(folder / "empty.h5", "is empty");
  std::ofstream(folder / "text.h5") << "x,y,z\n0,0,0\n";
  expect_open_error(folder / "text.h5", "is not an HDF5 file");
}

TEST(Violation, OfATruncatedFileIsAnErrorAtEveryLength) {
  const Folder folder;
  write_sample(folder / "a.h5", 1);
  const auto size = std::filesystem::file_size(folder / "a.h5");
  for (const double part : {0.999, 0.9, 0.5, 0.1, 0.01, 0.001}) {
    std::filesystem::copy_file(folder / "a.h5", folder / "b.h5", std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(folder / "b.h5", static_cast<std::uintmax_t>(static_cast<double>(size) * part));
    expect_open_error(folder / "b.h5", part > 0.001 ? "cannot be opened; it may be damaged, truncated" : "");
  }
}

TEST(Violation, OfTheParentIsFoundWhenTheParentIsThere) {
  const Folder folder;
  write_sample(folder / "parent.h5");
  FileDescription description = sample_description("agglomerate");
  description.provenance = make_provenance("agglomerate", {"agglomerate"}, 0, "none", folder / "parent.h5");
  AgglomerateWriter writer(folder / "child.h5", sample_particles(2), description);
  writer.append(sample_frame(2, 1));
  writer.finish("relaxed");
  EXPECT_TRUE(check_file(folder / "child.h5").empty());
  write_sample(folder / "parent.h5", 2);
  const auto violations = check_file(folder / "child.h5");
  ASSERT_EQ(violations.size(), 1u);
  EXPECT_EQ(violations[0].path, "/parameters/provenance@parent_sha256");
  std::filesystem::remove(folder / "parent.h5");
  EXPECT_TRUE(check_file(folder / "child.h5").empty());
}

}  // namespace
}  // namespace crumble::test
