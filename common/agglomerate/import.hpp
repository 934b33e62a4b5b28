// From a list of spheres to an agglomerate with closed contacts.
#pragma once

#include <optional>

#include "common/agglomerate/point_list.hpp"
#include "common/agglomerate/rescaled.hpp"
#include "common/contact/material.hpp"

namespace crumble {

struct ImportOptions {
  double unit = 1e-9;            // of the file's lengths, m
  std::optional<double> radius;  // of all spheres, m; wanted exactly if the file has no radii
  double contact_tolerance = 0.02;
  Material material;
};

struct Imported {
  Rescaled closed;           // at the size of the list
  std::size_t touching = 0;  // pairs taken as contacts before closing
};

// Pairs with a gap below contact_tolerance * a are contacts (a: 2 R* for unequal spheres) and are closed. A pair that
// overlaps by more than contact_tolerance * a beyond the equilibrium overlap of its material is refused, and so are
// coincident centres: PointListError names the lines.
Imported import_points(const PointList& points, const ImportOptions& options);

}  // namespace crumble
