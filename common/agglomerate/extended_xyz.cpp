#include "common/agglomerate/extended_xyz.hpp"

#include <fmt/format.h>

#include <ostream>
#include <string>

#include "common/agglomerate/fragments.hpp"
#include "common/agglomerate/morphology.hpp"

namespace crumble {
namespace {

constexpr double per_nm = 1e9;

struct Box {
  Vector3 low, high;  // nm
};

Box tight_box(const Particles& particles, const Frame& frame) {
  Box box{Vector3::Constant(1e300), Vector3::Constant(-1e300)};
  for (std::size_t i = 0; i < frame.position.size(); ++i) {
    box.low = box.low.cwiseMin(((frame.position[i].array() - particles.radius[i]) * per_nm).matrix());
    box.high = box.high.cwiseMax(((frame.position[i].array() + particles.radius[i]) * per_nm).matrix());
  }
  return box;
}

}  // namespace

void write_extended_xyz(std::ostream& out, const Particles& particles, const Frame& frame) {
  const std::size_t count = frame.position.size();
  const bool has_velocity = !frame.velocity.empty(), has_orientation = !frame.orientation.empty();
  const auto fragment = fragments(count, frame.contacts);
  const auto neighbours = coordination(count, frame.contacts);
  const Box box = tight_box(particles, frame);
  const Vector3 edge = box.high - box.low;
  out << fmt::format("{}\nLattice=\"{:.9g} 0 0 0 {:.9g} 0 0 0 {:.9g}\" Origin=\"{:.9g} {:.9g} {:.9g}\" pbc=\"F F F\" ",
                     count, edge.x(), edge.y(), edge.z(), box.low.x(), box.low.y(), box.low.z());
  out << "Properties=id:I:1:pos:R:3:radius:R:1" << (has_velocity ? ":velo:R:3" : "")
      << (has_orientation ? ":orientation:R:4" : "") << ":cluster:I:1:n_neighb:I:1";
  out << fmt::format(" Time={} Timestep={}\n", frame.time, frame.step);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3 x = per_nm * frame.position[i];
    std::string line =
        fmt::format("{} {} {} {} {}", particles.id[i], x.x(), x.y(), x.z(), per_nm * particles.radius[i]);
    if (has_velocity) {
      line += fmt::format(" {} {} {}", frame.velocity[i].x(), frame.velocity[i].y(), frame.velocity[i].z());
    }
    if (has_orientation) {
      const Quaternion& q = frame.orientation[i];
      line += fmt::format(" {} {} {} {}", q.x(), q.y(), q.z(), q.w());
    }
    out << line << fmt::format(" {} {}\n", fragment[i], neighbours[i]);
  }
}

void write_bonds(std::ostream& out, const Particles& particles, const Frame& frame) {
  const Box box = tight_box(particles, frame);
  out << fmt::format("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF BONDS\n{}\nITEM: BOX BOUNDS ff ff ff\n", frame.step,
                     frame.contacts.size());
  for (Eigen::Index k = 0; k < 3; ++k) out << fmt::format("{:.9g} {:.9g}\n", box.low[k], box.high[k]);
  out << "ITEM: BONDS batom1 batom2 btype dist gap_nm tension_N sliding_force_N twisting_torque_Nm "
         "rolling_torque_Nm\n";
  for (const Contact& c : frame.contacts) {
    const auto i = static_cast<std::size_t>(c.i), j = static_cast<std::size_t>(c.j);
    out << fmt::format("{} {} 1 {} {} {} {} {} {}\n", particles.id[i], particles.id[j],
                       per_nm * (frame.position[j] - frame.position[i]).norm(), per_nm * c.gap, c.normal_force,
                       c.sliding_force.norm(), c.twisting_torque, c.rolling_torque.norm());
  }
}

}  // namespace crumble
