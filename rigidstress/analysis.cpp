#include "rigidstress/analysis.hpp"

#include <fmt/format.h>

#include "common/io/errors.hpp"

namespace crumble::rigidstress {

namespace {

void refuse_fragments(const std::vector<Body>& parts, const std::string& name) {
  if (parts.size() < 2) return;
  std::string sizes;
  for (std::size_t k = 0; k < std::min<std::size_t>(parts.size(), 8); ++k)
    sizes += fmt::format("{}{}", k ? ", " : "", parts[k].particle.size());
  if (parts.size() > 8) sizes += ", ...";
  throw InputError(
      fmt::format("{}: {} pieces that no contact connects, of {} particles (particle {} belongs to the "
                  "second): not one rigid body. particle.fragments = \"each\" analyses each by itself, \"largest\" the "
                  "largest alone",
                  name, parts.size(), sizes, parts[1].particle.front()));
}

std::string piece_name(std::size_t number, std::size_t pieces) {
  return pieces > 1 ? fmt::format("piece {}, ", number + 1) : "";
}

}  // namespace

const BodyResult& Analysis::weakest() const {
  std::size_t weakest = 0;
  for (std::size_t k = 1; k < bodies.size(); ++k)
    if (bodies[k].worst.use > bodies[weakest].worst.use) weakest = k;
  return bodies[weakest];
}

Analysis analyse(Prepared prepared, const std::string& name, const StressScene& scene, const Say& say,
                 DoneParts& done) {
  Analysis a;
  a.prepared = std::move(prepared);
  std::vector<Body> parts = bodies(a.prepared);
  if (scene.pieces != Pieces::each) refuse_fragments(parts, name);
  bool every_error_known = true;
  for (Body& part : parts) {
    done.within = piece_name(a.bodies.size(), parts.size());
    BodyResult b;
    b.centre = centre_of(a.prepared, part);
    const Network network = [&] {
      try {
        return network_of(a.prepared, part, scene.joint, scene.material);
      } catch (const Mechanism& mechanism) {
        throw InputError(name + ": " + mechanism.what());
      }
    }();
    b.bridges = network.bridges();
    Judged judged = judged_response(network, b.centre, scene.hydrodynamics, say, done);
    b.loaded = {std::move(judged.response), pull_off_of(a.prepared, part, scene.material, scene.surface_forces)};
    b.body = std::move(part);
    if (a.bodies.empty()) {
      a.method = judged.method;
      a.how = judged.how;
    } else if (judged.method != a.method && !b.body.contact.empty()) {
      a.method += ", " + judged.method;
    }
    every_error_known = every_error_known && judged.error;
    if (judged.error) a.error = std::max(a.error.value_or(0), *judged.error);
    a.bodies.push_back(std::move(b));
  }
  if (!every_error_known) a.error.reset();
  return a;
}

void run_flows(Analysis& analysis, const StressScene& scene, DoneParts& done) {
  for (std::size_t k = 0; k < analysis.bodies.size(); ++k) {
    BodyResult& b = analysis.bodies[k];
    done.within = piece_name(k, analysis.bodies.size());
    if (!b.loaded.pull_off.empty()) {
      const WorstContact worst =
          worst_contact(b.loaded.response.tension, b.loaded.pull_off, unit_gradient(FlowKind::elongation));
      b.worst = {worst.contact, worst.tension, worst.tension / b.loaded.pull_off[worst.contact]};
    }
    const auto strained = [&](FlowKind kind, const char* flow) {
      return straining(b.loaded, unit_gradient(kind), scene.straining, {&done, fmt::format("{}, start", flow)});
    };
    if (scene.elongation) b.elongation = strained(FlowKind::elongation, "elongation");
    if (scene.uniaxial) b.uniaxial = strained(FlowKind::uniaxial, "uniaxial extension");
    if (scene.biaxial) b.biaxial = strained(FlowKind::biaxial, "biaxial extension");
    if (scene.shear) b.shear = shear(b.loaded, scene.orbit, {&done, "shear, orbit"});
    if (scene.history)
      b.history = follow_history(b.loaded, *scene.history, scene.orbit.starts, scene.orbit.tolerance,
                                 {&done, "history, orbit"});
    if (scene.tracks && b.worst.use > 0)
      b.exits = first_exits(b.loaded, *scene.tracks, b.worst.use, scene.seed, scene.orbit.tolerance);
  }
}

}  // namespace crumble::rigidstress
