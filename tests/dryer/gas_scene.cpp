// What a scene says of the gas: what follows from it, what is refused, and a droplet dried in it.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "dryer/conditions.hpp"
#include "dryer/conditions_command.hpp"
#include "dryer/drag.hpp"
#include "dryer/drying_checkpoint.hpp"
#include "dryer/gas/water_saturation.hpp"
#include "dryer/regime.hpp"
#include "dryer/run.hpp"
#include "dryer/stand_in.hpp"
#include "dryer/water_surface_tension.hpp"
#include "dryer/water_viscosity.hpp"
#include "tests/temporary_folder.hpp"

using namespace crumble;
using namespace crumble::dryer;

namespace {

const std::string head = "[particle]\nradius = 10e-9\nnumber = 30\n";
const std::string hot = "[gas]\ntemperature = 423.15\nvapour_mass_fraction = 0.01\n";

Scene text_of(const std::string& gas, const std::string& droplet = "", const std::string& particle = "",
              const std::string& file = "drying.toml") {
  return Scene::parse(head + particle + "[droplet]\nradius = 137e-9\n" + droplet + gas, file, drying_parameters());
}

DryingScene scene_of(const std::string& gas, const std::string& droplet = "", const std::string& particle = "") {
  return drying_scene(text_of(gas, droplet, particle));
}

std::string complaint(const std::string& gas, const std::string& droplet = "", const std::string& more = "") {
  try {
    scene_of(gas + more, droplet);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

bool has(const std::string& message, const std::string& what) { return message.find(what) != std::string::npos; }

TEST(GasScene, says_humidity_in_four_ways_that_mean_the_same) {
  const Gas gas{323.15, 0.02, 0};
  const double tau = scene_of("[gas]\ntemperature = 323.15\nvapour_mass_fraction = 0.02\n").model.droplet.lifetime;
  for (const std::string& said :
       {fmt::format("relative_humidity = {:.17g}", relative_humidity(gas)),
        fmt::format("relative_humidity_percent = {:.17g}", 100 * relative_humidity(gas)),
        fmt::format("humidity_ratio = {:.17g}", 0.02 / 0.98), fmt::format("dew_point = {:.17g}", dew_point(gas))})
    EXPECT_NEAR(scene_of("[gas]\ntemperature = 323.15\n" + said + "\n").model.droplet.lifetime / tau, 1, 1e-7)
        << said;  // the tolerance is 1e-8
}

TEST(GasScene, makes_the_liquid_water_at_the_temperature_of_the_droplet) {
  const DryingScene s = scene_of(hot, "", "brownian_motion = true\n");
  const LiquidPiece& middle = piece_at(s.liquid, 0.5 * s.model.droplet.lifetime);
  EXPECT_NEAR(middle.temperature, s.gas->curve->temperature(0.5 * s.model.droplet.lifetime), 0.26);
  EXPECT_EQ(s.model.viscosity, water_viscosity(middle.temperature));
  EXPECT_EQ(s.model.droplet.surface_tension, water_surface_tension(middle.temperature));
  EXPECT_EQ(s.model.thermal_energy, boltzmann_constant * middle.temperature);
  // A number of the scene stays, and so do the paper's defaults without [gas].
  EXPECT_EQ(scene_of(hot + "[fluid]\nviscosity = 0.002\n").model.viscosity, 0.002);
  EXPECT_EQ(scene_of("", "lifetime = 1e-4\n").model.droplet.surface_tension, 1.75e-4);
  EXPECT_TRUE(scene_of("", "lifetime = 1e-4\n").liquid.empty());
  Scene text = text_of(hot);
  inherit_from_gas(text);
  EXPECT_EQ(text.word("fluid.surface_tension"), "water");
  EXPECT_EQ(drying_scene(text).model.droplet.surface_tension, scene_of(hot).model.droplet.surface_tension);
}

TEST(GasScene, that_contradicts_itself_is_refused_with_keys_and_remedy) {
  const std::string T = "[gas]\ntemperature = 323.15\n";
  const auto two = complaint(T + "relative_humidity = 0.2\ndew_point = 290\n");
  EXPECT_TRUE(has(two, "gas.dew_point") && has(two, "already given by gas.relative_humidity (drying.toml:")) << two;
  const auto none = complaint(T);
  EXPECT_TRUE(has(none, "needs the humidity") && has(none, "gas.vapour_mass_fraction = 0")) << none;
  const auto without = complaint("[gas]\nrelative_humidity = 0.2\n");
  EXPECT_TRUE(has(without, "needs gas.temperature")) << without;
  const auto percent = complaint(T + "relative_humidity = 55\n");
  EXPECT_TRUE(has(percent, "gas.relative_humidity") && has(percent, "write 0.55")) << percent;
  for (const char* key : {"dew_point = 330", "vapour_mass_fraction = 0.2", "humidity_ratio = 0.2"}) {
    const auto fog = complaint(T + key + "\n");
    EXPECT_TRUE(has(fog, "below its dew point") && has(fog, "condenses") && has(fog, "give less humidity")) << fog;
  }
  const auto full = complaint(T + "relative_humidity = 1\n");
  EXPECT_TRUE(has(full, "gas.relative_humidity") && has(full, "does not dry")) << full;
  const auto celsius = complaint("[gas]\ntemperature = 50\nrelative_humidity = 0.2\n");
  EXPECT_TRUE(has(celsius, "gas.temperature") && has(celsius, "323.15")) << celsius;
  const auto frost = complaint("[gas]\ntemperature = 280\nvapour_mass_fraction = 0\n");
  EXPECT_TRUE(has(frost, "gas.temperature") && has(frost, "freeze") && has(frost, "warmer or more humid")) << frost;
  for (const char* key : {"lifetime = 1e-4", "peclet = 10", "front_speed = 1e-3", "evaporation_constant = 1e-10"}) {
    const auto twice = complaint(hot, std::string(key) + "\n");
    EXPECT_TRUE(has(twice, "droplet.") && has(twice, "already given by gas.temperature (drying.toml:")) << twice;
  }
  const auto warm = complaint(hot, "", "[fluid]\ntemperature = 300\n");
  EXPECT_TRUE(has(warm, "fluid.temperature") && has(warm, "droplet.initial_temperature")) << warm;
  const auto alone = complaint("", "lifetime = 1e-4\ninitial_temperature = 300\n");
  EXPECT_TRUE(has(alone, "droplet.initial_temperature") && has(alone, "only with [gas]")) << alone;
  const auto steam = complaint(hot, "initial_temperature = 400\n");
  EXPECT_TRUE(has(steam, "droplet.initial_temperature") && has(steam, "373.12")) << steam;
  const auto nothing = complaint("");
  EXPECT_TRUE(has(nothing, "droplet.peclet, or [gas]")) << nothing;
}

TEST(GasScene, says_that_vapour_condenses_on_a_cold_droplet) {
  const DryingScene s =
      scene_of("[gas]\ntemperature = 330\nvapour_mass_fraction = 0.05\n", "initial_temperature = 280\n");
  std::string all;
  for (const std::string& line : describe(s)) all += line + "\n";
  EXPECT_TRUE(has(all, "vapour condenses on it")) << all;
  EXPECT_GT(s.gas->largest_radius, s.gas->droplet.radius);
  EXPECT_FALSE(has(describe(*scene_of(hot).gas).at(1), "condenses"));
}

class GasFile : public ::testing::Test {
 protected:
  std::string history(const std::string& content) const {
    std::ofstream(folder_.file("track.csv")) << content;
    return complaint_of(text_of("[gas]\nhistory = \"track.csv\"\n", "", "", folder_.file("drying.toml")));
  }
  static std::string complaint_of(const Scene& scene) {
    try {
      drying_scene(scene);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }
  const test::Folder folder_;
};

TEST_F(GasFile, a_constant_history_is_the_constant_gas) {
  ASSERT_EQ(history("# a track\nt [s], temperature [K], vapour_mass_fraction\n0, 423.15, 0.01\n1e-6, 423.15, 0.01\n"),
            "none");
  const DryingScene s = drying_scene(text_of("[gas]\nhistory = \"track.csv\"\n", "", "", folder_.file("drying.toml")));
  EXPECT_NEAR(s.model.droplet.lifetime / scene_of(hot).model.droplet.lifetime, 1, 1e-7);
  ASSERT_EQ(history("t,temperature,vapour_mass_fraction,slip\n0,423.15,0.01,0\n1e-5,330,0.02,0\n"), "none");
  const DryingScene cooled =
      drying_scene(text_of("[gas]\nhistory = \"track.csv\"\n", "", "", folder_.file("drying.toml")));
  EXPECT_GT(cooled.model.droplet.lifetime, s.model.droplet.lifetime);
}

TEST_F(GasFile, that_is_wrong_is_refused_with_its_line) {
  const std::string names = "t,temperature,vapour_mass_fraction\n";
  const auto message = [&](const std::string& rows) { return history(names + rows); };
  const auto back = message("0,400,0.01\n1,400,0.01\n1,390,0.01\n");
  EXPECT_TRUE(has(back, "track.csv:4") && has(back, "times must increase")) << back;
  EXPECT_TRUE(has(message("0.5,400,0.01\n"), "begins at t = 0"));
  EXPECT_TRUE(has(message(""), "at least one instant"));
  const auto fog = message("0,400,0.01\n1,300,0.05\n");
  EXPECT_TRUE(has(fog, "track.csv:3") && has(fog, "below its dew point") && has(fog, "at most")) << fog;
  EXPECT_TRUE(has(message("0,400,1.5\n"), "below 1"));
  EXPECT_TRUE(has(message("0,100,0\n"), "373.15"));  // degrees Celsius
  EXPECT_TRUE(has(message("0,400\n"), "track.csv:2"));
  const auto column = history("t,temperature,humidity\n0,400,0.01\n");
  EXPECT_TRUE(has(column, "'humidity' is none of") && has(column, "vapour_mass_fraction")) << column;
  EXPECT_TRUE(has(history("t [ms],temperature,vapour_mass_fraction\n0,400,0.01\n"), "unit must be s"));
  EXPECT_TRUE(has(history("t,temperature\n0,400\n"), "'vapour_mass_fraction' is missing"));
  const Scene both = text_of("[gas]\nhistory = \"track.csv\"\nslip = 1\n", "", "", folder_.file("drying.toml"));
  EXPECT_TRUE(has(complaint_of(both), "gas.slip") && has(complaint_of(both), "already given by gas.history"));
  const Scene lost = text_of("[gas]\nhistory = \"none.csv\"\n", "", "", folder_.file("drying.toml"));
  EXPECT_TRUE(has(complaint_of(lost), "gas.history") && has(complaint_of(lost), "cannot be opened"));
}

// The front is where the curve has it, and the integrator's liquid is that of the instant.
class GasDrying : public ::testing::TestWithParam<const char*> {
 protected:
  // Cold at first, so that the liquid changes; of a real droplet, since one of 137 nm is warm in no time.
  static DryingScene scene() {
    const std::string kind = GetParam(), method = kind.substr(0, kind.find('_'));
    const bool noise = method == "overdamped", salt = kind.ends_with("_in_salt");
    // With water's surface tension the others take minutes.
    const std::string fluid = noise ? "" : "[fluid]\nsurface_tension = 1.75e-4\n";
    return scene_of(
        hot + fluid + "[stands_for]\ndroplet_radius = 2e-6\n[integrator]\nmethod = \"" + method + "\"\n" +
            (salt    ? ""
             : noise ? "softening = 1.5\n"
                     : "largest_displacement = 0.1\n") +
            "[error]\nestimate = false\n" +
            (salt ? "[surface_forces]\nhamaker = 9.85e-21\nsurface_potential = 0.03\nionic_strength = 10\n" : ""),
        "initial_temperature = 298.15\n", noise ? "brownian_motion = true\n" : "");
  }
};

TEST_P(GasDrying, goes_through_the_liquids_of_its_temperatures_and_restarts_to_the_same_bits) {
  const DryingScene s = scene();
  ASSERT_GT(s.liquid.size(), 10u);
  DryingRun whole(s, 1);
  int steps = 0;
  for (; !whole.finished(); ++steps) {
    whole.step();
    const double t = whole.state().state.time;
    EXPECT_EQ(whole.droplet_radius(), s.gas->curve->radius(t));
  }
  EXPECT_EQ(whole.droplet_radius(), 0);
  EXPECT_NEAR(whole.state().state.time, s.model.droplet.lifetime, 1e-9 * s.model.droplet.lifetime);
  const test::Folder folder;
  const std::string output = folder.file("out.h5");
  const CheckpointOwner owner{"dryer", "test", "scene"};
  for (const int stop : {steps / 50, steps / 3}) {
    DryingRun first(s, 1);
    for (int k = 0; k < stop; ++k) first.step();
    const OutputCheckpoint checkpoint(output, owner);
    DryingProgress progress{true, {}, 0};
    checkpoint.write(checkpoint.collect([&](SavedFields& f) {
      FrameLog::Mark().fields(f.in("frames"));
      save_drying(f, progress, first);
    }));
    const SavedDrying back = saved_drying(OutputCheckpoint(output, owner), s);
    while (!back.run->finished()) back.run->step();
    EXPECT_EQ(whole.state().state.position, back.run->state().state.position) << stop;
    EXPECT_EQ(whole.state().state.step, back.run->state().state.step) << stop;
    EXPECT_EQ(whole.state().state.contacts.size(), back.run->state().state.contacts.size()) << stop;
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, GasDrying,
                         ::testing::Values("stabilised", "implicit", "overdamped", "overdamped_in_salt"));

TEST(GasStandIn, keeps_k_and_the_temperatures_of_the_real_droplet) {
  const Scene real = Scene::parse(
      "[particle]\nradius = 100e-9\nsolids_fraction = 0.05\nbrownian_motion = true\n[droplet]\nradius = 25e-6\n"
      "initial_temperature = 298.15\n" +
          hot,
      "real.toml", drying_parameters());
  const Scene small = Scene::parse(stand_in(real, 100), "small.toml", drying_parameters());
  const DryingScene s = drying_scene(small);
  const Conditions c = conditions(real, 100);
  EXPECT_EQ(s.radius.size(), 100u);
  EXPECT_NEAR(drying_regime(s).peclet / c.peclet, 1, 1e-9);
  EXPECT_NEAR(s.model.droplet.lifetime / c.smaller->lifetime, 1, 1e-9);
  EXPECT_NEAR(c.smaller->regime.peclet / c.peclet, 1, 1e-9);
  EXPECT_NEAR(s.liquid.front().temperature, 298.4, 0.3);
  EXPECT_NEAR(s.gas->course.curve.lifetime() / c.process.lifetime, 1, 1e-9);
}

// Pe does not depend on the droplet where it is large: k/D of the gas and the particle alone.
TEST(Conditions, give_the_peclet_number_of_the_particle_in_the_gas) {
  const auto of = [](double R) {
    return conditions(
        Scene::parse("[particle]\nradius = 10e-9\n[droplet]\nradius = " + std::to_string(R) + "e-6\n" + hot, "c.toml",
                     drying_parameters()),
        1000);
  };
  const Conditions c = of(25);
  const double T = c.process.gas->wet_bulb;
  EXPECT_NEAR(c.peclet, c.process.gas->evaporation_constant / diffusivity(T, water_viscosity(T), 10e-9),
              0.02 * c.peclet);
  EXPECT_NEAR(of(50).peclet / c.peclet, 1, 0.01);
  EXPECT_FALSE(c.regime);
  EXPECT_TRUE(has(conditions_table(c), "would say which granule"));
}

class ConditionsCommand : public ::testing::Test {
 protected:
  static int run(std::vector<const char*> words) {
    words.insert(words.begin(), "dryer conditions");
    return conditions_command(static_cast<int>(words.size()), words.data());
  }
  static std::string wrong(const std::vector<const char*>& words) {
    try {
      run(words);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }
  const test::Folder folder_;
};

TEST_F(ConditionsCommand, answers_without_a_scene_and_writes_the_course) {
  const std::string csv = folder_.file("c.csv"), json = folder_.file("c.json");
  ASSERT_EQ(run({"--set", "gas.temperature=423.15", "--set", "gas.vapour_mass_fraction=0.01", "--set",
                 "droplet.diameter=50e-6", "--set", "particle.radius=10e-9", "--set", "particle.solids_fraction=0.05",
                 "-o", csv.c_str(), "--report", json.c_str()}),
            0);
  std::ifstream in(csv);
  std::string line, last;
  std::getline(in, line);
  EXPECT_EQ(line, "time_s,radius_m,temperature_k,evaporation_constant_m2_per_s,peclet");
  int rows = 0;
  while (std::getline(in, line)) ++rows, last = line;
  EXPECT_GT(rows, 100);
  double time = 0, radius = 1;
  ASSERT_EQ(std::sscanf(last.c_str(), "%lf,%lf", &time, &radius), 2);
  EXPECT_EQ(radius, 0);
  EXPECT_NEAR(time, 0.24, 0.01);  // R0^2/k
  EXPECT_TRUE(std::filesystem::exists(json));
}

TEST_F(ConditionsCommand, says_what_is_missing) {
  EXPECT_TRUE(has(wrong({"--set", "droplet.radius=1e-6", "--set", "particle.radius=1e-8"}), "needs the gas"));
  EXPECT_TRUE(has(wrong({"--set", "gas.temperature=400"}), "droplet.radius"));
  EXPECT_TRUE(has(wrong({"--sat", "x=1"}), "usage: dryer conditions"));
}

}  // namespace
