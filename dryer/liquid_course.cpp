#include "dryer/liquid_course.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace crumble::dryer {

std::vector<LiquidPiece> liquid_course(const DryingCurve& curve, const std::function<void(LiquidPiece&)>& properties) {
  std::vector<LiquidPiece> pieces;
  double low = curve.nodes().front().temperature, high = low, last = low;
  const auto end_piece = [&](double time) {
    pieces.push_back({time, 0.5 * (low + high), 0, 0, 0});
    properties(pieces.back());
  };
  // Looked at finely between the nodes: in a slow gas they may lie kelvins apart.
  for (std::size_t k = 1; k < curve.nodes().size(); ++k) {
    const double way = std::abs(curve.nodes()[k].temperature - curve.nodes()[k - 1].temperature);
    const int looks = std::max(8, static_cast<int>(std::ceil(way / (0.05 * piece_of_temperature))));
    for (int look = 1; look <= looks; ++look) {
      const double from = curve.nodes()[k - 1].time, to = curve.nodes()[k].time;
      const double time = from + (to - from) * look / looks, T = curve.temperature(time);
      if (std::max(high, T) - std::min(low, T) > piece_of_temperature) {
        end_piece(from + (to - from) * (look - 1) / looks);
        low = high = last;
      }
      low = std::min(low, T), high = std::max(high, T), last = T;
    }
  }
  end_piece(std::numeric_limits<double>::infinity());
  return pieces;
}

std::size_t pieces_passed(const std::vector<LiquidPiece>& pieces, std::size_t from, double time) {
  std::size_t passed = 0;
  while (from + passed + 1 < pieces.size() && time >= pieces[from + passed].until) ++passed;
  return passed;
}

const LiquidPiece& piece_at(const std::vector<LiquidPiece>& pieces, double time) {
  return pieces.at(pieces_passed(pieces, 0, time));
}

void take(const LiquidPiece& piece, DryingModel& model) {
  model.viscosity = piece.viscosity;
  model.droplet.surface_tension = piece.surface_tension;
  model.thermal_energy = piece.thermal_energy;
}

}  // namespace crumble::dryer
