// Which particles still act on each other: an agglomerate falls into pieces that move on their own.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "breaker/integrator.hpp"

namespace crumble::breaker {

struct Piece {
  std::vector<std::int32_t> member;  // particle numbers, ascending
  std::unique_ptr<Integrator> integrator;
  double last_rupture = 0;  // s

  const Frame& frame() const { return integrator->frame(); }
  double time() const { return frame().time; }
};

// Values of the members alone, in their order.
std::vector<double> of_members(const std::vector<double>& all, const std::vector<std::int32_t>& member);

class Pieces {
 public:
  using MakeIntegrator = std::function<std::unique_ptr<Integrator>(const std::vector<double>& radius, Frame frame)>;

  // One piece of all particles.
  Pieces(const Particles& particles, const Frame& start, MakeIntegrator make);

  std::size_t size() const { return pieces_.size(); }
  Piece& operator[](std::size_t k) { return pieces_[k]; }
  const Piece& operator[](std::size_t k) const { return pieces_[k]; }
  auto begin() const { return pieces_.begin(); }
  auto end() const { return pieces_.end(); }

  // All particles in the axes of the laboratory; those that are in no piece where they were lost. Its step and time are
  // those of the first piece.
  Frame laboratory() const;
  // Of all integrators, those that are gone among them.
  IntegratorStatistics statistics() const;

  // Takes the fragments of piece k whose surfaces are farther than `reach` (m) from the rest out of it. They are
  // returned as pieces, and are lost unless they are added again.
  std::vector<Piece> split(std::size_t k, double reach);
  void add(Piece piece) { pieces_.push_back(std::move(piece)); }

  void fields(SavedFields& f);

 private:
  Piece make_piece(std::vector<std::int32_t> member, Frame frame) const;

  const Particles& particles_;
  MakeIntegrator make_;
  std::vector<Piece> pieces_;
  Frame lost_;  // of all particles, as they were last seen when a piece was split
  IntegratorStatistics retired_;
};

}  // namespace crumble::breaker
