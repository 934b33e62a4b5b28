#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/io/errors.hpp"
#include "common/io/file_errors.hpp"
#include "dryer/drying_checkpoint.hpp"
#include "tests/temporary_folder.hpp"

using namespace crumble;
using namespace crumble::dryer;
using crumble::test::Folder;

namespace {

DryingScene small_scene(const std::string& kind) {
  const bool brownian = kind.ends_with("_with_noise");
  const std::string crust = kind.ends_with("_behind_a_crust") ? "[crust]\nrelative_diffusivity = 0.2\n" : "";
  const std::string salt =
      kind.find("_in_salt") == std::string::npos
          ? ""
          : "[surface_forces]\nhamaker = 9.85e-21\nsurface_potential = 0.04\nionic_strength = 10\n";
  const std::string method = kind.substr(0, kind.find('_'));
  const bool strong = kind.starts_with("stabilised_") && brownian;
  // Stabilised steps with noise want bonds that last: ten times larger particles.
  const std::string lengths = strong ? "radius = 100e-9\nnumber = 20\nbrownian_motion = "
                                     : "radius = 10e-9\nnumber = 20\nbrownian_motion = ",
                    droplet = strong ? "radius = 700e-9\nlifetime = 1e-4\n" : "radius = 120e-9\nlifetime = 2e-7\n";
  const std::string text = "[particle]\n" + lengths + (brownian ? "true" : "false") + "\n[droplet]\n" + droplet +
                           "[integrator]\nmethod = \"" + method + "\"\n" + crust + salt;
  return drying_scene(Scene::parse(text, "small.toml", drying_parameters()));
}

const CheckpointOwner owner{"dryer", "1", "scene"};

void write(const std::string& output, DryingRun& run, DryingProgress progress) {
  const OutputCheckpoint checkpoint(output, owner);
  checkpoint.write(checkpoint.collect([&](SavedFields& f) {
    FrameLog::Mark().fields(f.in("frames"));
    save_drying(f, progress, run);
  }));
}

class Restart : public ::testing::TestWithParam<std::string> {};

TEST_P(Restart, continues_to_the_same_bits_from_any_step) {
  const Folder folder;
  const DryingScene scene = small_scene(GetParam());
  DryingRun whole(scene, 1);
  std::vector<int> stops;
  int steps = 0;
  for (; !whole.finished(); ++steps) whole.step();
  if (GetParam() == "overdamped_with_noise") {
    EXPECT_GT(whole.stage(), 0u) << "to cover a change of softening";
  }
  for (const int stop : {1, steps / 3, 2 * steps / 3, steps - 2}) {
    DryingRun first(scene, 1);
    for (int k = 0; k < stop; ++k) first.step();
    const std::string output = folder.file("out.h5");
    write(output, first, {true, DryingOutcome{1, 2, 3}, 4});
    const OutputCheckpoint found(output, owner);
    ASSERT_TRUE(found.found());
    EXPECT_GT(found.used().cpu_s, 0);
    const SavedDrying saved = saved_drying(found, scene);
    EXPECT_EQ(saved.progress.companion->contacts, 3);
    EXPECT_EQ(saved.progress.frames, 4);
    DryingRun& second = *saved.run;
    while (!second.finished()) second.step();
    const Frame &f = whole.state().state, &g = second.state().state;
    EXPECT_EQ(f.position, g.position) << stop;
    EXPECT_EQ(f.velocity, g.velocity) << stop;
    EXPECT_EQ(f.step, g.step);
    ASSERT_EQ(f.contacts.size(), g.contacts.size()) << stop;
    for (std::size_t c = 0; c < f.contacts.size(); ++c) {
      EXPECT_EQ(f.contacts[c].sliding, g.contacts[c].sliding);
      EXPECT_EQ(f.contacts[c].rolling_torque, g.contacts[c].rolling_torque);
      EXPECT_EQ(f.contacts[c].born, g.contacts[c].born);
    }
    EXPECT_EQ(whole.integrator().statistics().particle_steps, second.integrator().statistics().particle_steps);
    found.remove();
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, Restart,
                         ::testing::Values("implicit", "stabilised", "inertial", "overdamped_with_noise",
                                           "stabilised_with_noise", "inertial_with_noise", "implicit_behind_a_crust",
                                           "stabilised_behind_a_crust", "inertial_behind_a_crust",
                                           "overdamped_in_salt_with_noise", "inertial_in_salt",
                                           "inertial_in_salt_with_noise", "stabilised_in_salt",
                                           "stabilised_in_salt_with_noise"));

TEST(Checkpoint, that_lacks_a_field_or_has_one_too_many_is_refused_by_its_name) {
  const Folder folder;
  const DryingScene scene = small_scene("stabilised");
  const std::string output = folder.file("out.h5"), file = output + ".checkpoint";
  DryingRun run(scene, 1);
  run.step();
  write(output, run, {true, {}, 1});
  const SavedState whole = load_checkpoint(file, owner);
  const auto message = [&](const SavedState& state) {
    save_checkpoint(file, owner, state);
    try {
      saved_drying(OutputCheckpoint(output, owner), scene);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(message(whole), "no error");
  SavedState older = whole, newer = whole;
  older.reals.erase("run.integrator.next_step");
  newer.reals["run.integrator.new"] = {1};
  EXPECT_NE(message(older).find(file + ": the field 'run.integrator.next_step' is missing"), std::string::npos);
  EXPECT_NE(message(newer).find("the field 'run.integrator.new' is not known"), std::string::npos);
  EXPECT_NE(message(newer).find("remove it to start anew"), std::string::npos);
}

TEST(Checkpoint, of_another_scene_version_or_program_is_refused_with_the_difference) {
  const Folder folder;
  const std::string file = folder.file("x.checkpoint");
  save_checkpoint(file, {"dryer", "0.1", "a = 1\nb = 2\n"}, {});
  const auto message = [&](const CheckpointOwner& by) {
    try {
      load_checkpoint(file, by);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(message({"dryer", "0.1", "a = 1\nb = 3\n"}).find("'b = 2' then, 'b = 3' now"), std::string::npos);
  EXPECT_NE(message({"dryer", "0.2", "a = 1\nb = 2\n"}).find("version 0.1, this is 0.2"), std::string::npos);
  EXPECT_NE(message({"breaker", "0.1", "a = 1\nb = 2\n"}).find("of dryer, not of breaker"), std::string::npos);
  std::ofstream(file) << "not a checkpoint";
  EXPECT_ANY_THROW(load_checkpoint(file, {"dryer", "0.1", ""}));
}

}  // namespace
