#include "common/hydro/flow_kind.hpp"

#include <cmath>
#include <stdexcept>

namespace crumble {

namespace {

const std::vector<std::string>& rung_names() {
  static const std::vector<std::string> names{"fts", "fts-lubrication", "fts-relative-lubrication", "multipole"};
  return names;
}

std::size_t place_of(std::string_view name, const std::vector<std::string>& names) {
  for (std::size_t k = 0; k < names.size(); ++k)
    if (names[k] == name) return k;
  throw std::invalid_argument("there is no '" + std::string(name) + "'");
}

}  // namespace

Eigen::Matrix3d unit_gradient(FlowKind kind) {
  Eigen::Matrix3d g = Eigen::Matrix3d::Zero();
  switch (kind) {
    case FlowKind::elongation:
      return planar_elongation(1).gradient;
    case FlowKind::shear:
      return simple_shear(1).gradient;
    case FlowKind::uniaxial:
      g.diagonal() = Eigen::Vector3d(1, -0.5, -0.5) * std::sqrt(1.0 / 3);
      break;
    case FlowKind::biaxial:
      g.diagonal() = Eigen::Vector3d(0.5, 0.5, -1) * std::sqrt(1.0 / 3);
      break;
    case FlowKind::quiescent:
      break;
  }
  return g;
}

const std::vector<std::string>& flow_names() {
  static const std::vector<std::string> names{"elongation", "shear", "uniaxial", "biaxial", "quiescent"};
  return names;
}

FlowKind flow_named(std::string_view name) { return static_cast<FlowKind>(place_of(name, flow_names())); }
const std::string& name_of(FlowKind kind) { return flow_names()[static_cast<std::size_t>(kind)]; }
Rung rung_named(std::string_view name) { return static_cast<Rung>(place_of(name, rung_names())); }
const std::string& name_of(Rung rung) { return rung_names()[static_cast<std::size_t>(rung)]; }

}  // namespace crumble
