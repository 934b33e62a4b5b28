#include "dryer/cost_sample.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "common/agglomerate/bond.hpp"
#include "common/io/cost.hpp"
#include "common/numerics/noise.hpp"
#include "dryer/drag.hpp"
#include "dryer/run.hpp"
#include "dryer/start.hpp"

namespace crumble::dryer {

namespace {

constexpr std::size_t most_particles = 200;
constexpr double budget = 8e-3;  // s, begun steps are ended
constexpr int most_steps = 16;

std::vector<double> sample_radii(const DryingScene& scene) {
  const std::size_t count = sample_size(scene), all = scene.radius.size();
  std::vector<double> radius(count);
  for (std::size_t k = 0; k < count; ++k) radius[k] = scene.radius[(2 * k + 1) * all / (2 * count)];
  return radius;
}

// The lattice takes one radius, so that neighbours touch: that of the smallest, which decides on the steps.
Agglomerate packed_cluster(const DryingScene& scene, const DryingModel& model) {
  const double a = scene.smallest_radius();
  const std::size_t count = sample_size(scene);
  const BondLaw law(model.contact, model.material, a, a);
  // At rest: what a lattice out of equilibrium does first is not what a run does.
  const double gap = model.contact.normal == NormalLaw::jkr ? Jkr(model.material, a).equilibrium_gap : 0;
  const auto side = static_cast<int>(std::ceil(std::cbrt(1.5 * static_cast<double>(count))));
  Agglomerate cluster;
  std::map<std::tuple<int, int, int>, std::int32_t> places;
  for (int place = 0; place < side * side * side && places.size() < count; ++place) {
    const auto word = random_words(0, Purpose::start_position, static_cast<std::uint32_t>(place), 0)[0];
    if (uniform(word) > 2.0 / 3) continue;
    const int x = place % side, y = place / side % side, z = place / (side * side);
    const auto p = static_cast<std::int32_t>(places.size());
    places[{x, y, z}] = p;
    cluster.state.position.push_back((2 * a + gap) * (Vector3(x, y, z) - Vector3::Constant(0.5 * (side - 1))));
    cluster.particles.radius.push_back(a);
    cluster.particles.mass.push_back(4.0 / 3.0 * std::numbers::pi * a * a * a * model.material.density);
    cluster.particles.id.push_back(p);
    cluster.particles.species.push_back(0);
  }
  auto& bonds = cluster.state.contacts;
  for (const auto& [at, p] : places)
    for (const int k : {0, 1, 2}) {
      const auto [x, y, z] = at;
      const auto next = places.find({x + (k == 0), y + (k == 1), z + (k == 2)});
      if (next == places.end()) continue;
      const std::int32_t i = std::min(p, next->second), j = std::max(p, next->second);
      bonds.push_back(make_bond(law, i, j, cluster.state.position[j] - cluster.state.position[i], a, a, 0));
    }
  std::sort(bonds.begin(), bonds.end(), [](const Contact& b, const Contact& c) {
    return Pair{b.i, b.j} < Pair{c.i, c.j};
  });
  return cluster;
}

double reach(const Agglomerate& sample) {
  double farthest = 0;
  for (std::size_t p = 0; p < sample.particles.size(); ++p)
    farthest = std::max(farthest, sample.state.position[p].norm() + sample.particles.radius[p]);
  return farthest;
}

// A step() may hold any number of evaluations: as many as the scene asks for, but at most some hundred a stabilised
// step.
double latest_time(const DryingScene& scene, const DryingModel& model, const Integrator& integrator, double now) {
  if (!scene.is(IntegratorKind::stabilised)) return integrator.front().end();
  const double a = scene.smallest_radius();
  const BondLaw law(model.contact, model.material, a, a);
  return std::min(integrator.front().end(), now + 4e4 * drag_coefficient(model.viscosity, a) / law.normal_stiffness());
}

}  // namespace

std::size_t sample_size(const DryingScene& scene) { return std::min(scene.radius.size(), most_particles); }

double measured_seconds(const DryingScene& scene, SampleState state) {
  const std::vector<SofteningStage> stages = softening_stages(scene);
  const SofteningStage& stage = state == SampleState::loose ? stages.front() : stages.back();
  DryingModel model = softened_model(scene, stage.softening);
  Agglomerate sample;
  if (state == SampleState::packed) {
    sample = packed_cluster(scene, model);
  } else {
    const std::vector<double> radius = sample_radii(scene);
    double solids = 0, all = 0;
    for (const double a : radius) solids += a * a * a;
    for (const double a : scene.radius) all += a * a * a / std::pow(model.droplet.initial_radius, 3);
    const double R = std::max(std::cbrt(solids / std::min(all, 0.1)), 1.5 * radius.front());
    sample = random_suspension(radius, model.material.density, R, scene.seed);
  }
  // The front has the speed that it has in the scene's droplet when it is as large as the solids.
  const double R = reach(sample);
  double solids = 0;
  for (const double a : scene.radius) solids += a * a * a;
  const double packed = std::min(model.droplet.initial_radius, std::cbrt(2 * solids));
  if (model.surface_forces && state == SampleState::packed) {
    // So is the salt.
    Electrolyte& salt = model.surface_forces->electrolyte;
    salt.ionic_strength = concentrated(salt.ionic_strength, std::pow(model.droplet.initial_radius, 3) - solids,
                                       std::pow(packed, 3) - solids, model.surface_forces->solubility);
  }
  model.droplet.lifetime = R / (2 * model.droplet.front_speed(packed));
  model.droplet.initial_radius = R;
  model.droplet.curve = nullptr;
  const auto integrator = make_integrator(scene, model, 1, stage.depth, sample);

  std::vector<double> times;
  const auto& done = integrator->statistics();
  const double begin = thread_seconds();
  for (int k = 0; k < most_steps && sample.state.time < integrator->front().end(); ++k) {
    const double before = thread_seconds();
    const auto steps = done.steps;
    integrator->step(latest_time(scene, model, *integrator, sample.state.time));
    const double now = thread_seconds();
    if (done.steps > steps) times.push_back((now - before) / static_cast<double>(done.steps - steps));
    if (now - begin > budget && times.size() > 1) break;
  }
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  double seconds = times.at(times.size() / 2) / static_cast<double>(sample.particles.size());
  if (scene.is(IntegratorKind::brownian) && state == SampleState::packed) seconds = std::ldexp(seconds, -stage.depth);
  return seconds;
}

}  // namespace crumble::dryer
