#include "breaker/pieces.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "common/agglomerate/fragments.hpp"
#include "common/agglomerate/saved_frame.hpp"

namespace crumble::breaker {

namespace {

// Rows of a frame, with the contacts among them, renumbered.
Frame part_of(const Frame& frame, const std::vector<std::int32_t>& rows) {
  Frame part;
  part.step = frame.step;
  part.time = frame.time;
  std::vector<std::int32_t> number(frame.position.size(), -1);
  for (const std::int32_t row : rows) {
    number[row] = static_cast<std::int32_t>(part.position.size());
    part.position.push_back(frame.position[row]);
    part.orientation.push_back(frame.orientation[row]);
  }
  for (Contact c : frame.contacts)
    if (number[c.i] >= 0 && number[c.j] >= 0) {
      c.i = number[c.i];
      c.j = number[c.j];
      part.contacts.push_back(c);
    }
  return part;
}

// The piece's particles and contacts into the whole, in the axes of the laboratory.
void put_back(const Piece& piece, Frame& whole) {
  const Frame lab = piece.integrator->laboratory();
  std::vector<bool> mine(whole.position.size(), false);
  for (std::size_t row = 0; row < piece.member.size(); ++row) {
    mine[piece.member[row]] = true;
    whole.position[piece.member[row]] = lab.position[row];
    whole.orientation[piece.member[row]] = lab.orientation[row];
  }
  std::erase_if(whole.contacts, [&](const Contact& c) { return mine[c.i]; });
  for (Contact c : lab.contacts) {
    c.i = piece.member[c.i];
    c.j = piece.member[c.j];
    whole.contacts.push_back(c);
  }
  std::sort(whole.contacts.begin(), whole.contacts.end(),
            [](const Contact& a, const Contact& b) { return std::pair(a.i, a.j) < std::pair(b.i, b.j); });
}

// Least gap between a fragment and all others, m.
double distance(const Frame& frame, const std::vector<double>& radius, const std::vector<std::int32_t>& label,
                std::int32_t fragment) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < label.size(); ++p) {
    if (label[p] != fragment) continue;
    for (std::size_t q = 0; q < label.size(); ++q)
      if (label[q] != fragment)
        least = std::min(least, (frame.position[p] - frame.position[q]).norm() - radius[p] - radius[q]);
  }
  return least;
}

}  // namespace

std::vector<double> of_members(const std::vector<double>& all, const std::vector<std::int32_t>& member) {
  std::vector<double> values;
  for (const std::int32_t p : member) values.push_back(all[p]);
  return values;
}

Pieces::Pieces(const Particles& particles, const Frame& start, MakeIntegrator make)
    : particles_(particles), make_(std::move(make)), lost_(start) {
  std::vector<std::int32_t> everybody(particles.size());
  std::iota(everybody.begin(), everybody.end(), 0);
  add(make_piece(std::move(everybody), start));
}

Piece Pieces::make_piece(std::vector<std::int32_t> member, Frame frame) const {
  Piece piece;
  piece.last_rupture = frame.time;
  piece.integrator = make_(of_members(particles_.radius, member), std::move(frame));
  piece.member = std::move(member);
  return piece;
}

Frame Pieces::laboratory() const {
  Frame whole = lost_;
  for (const Piece& piece : pieces_) put_back(piece, whole);
  whole.step = statistics().steps;
  whole.time = pieces_.front().time();
  return whole;
}

IntegratorStatistics Pieces::statistics() const {
  IntegratorStatistics sum = retired_;
  for (const Piece& piece : pieces_) sum += piece.integrator->statistics();
  return sum;
}

std::vector<Piece> Pieces::split(std::size_t k, double reach) {
  const Piece& whole = pieces_[k];
  const auto label = fragments(whole.member.size(), whole.frame().contacts);
  const auto sizes = fragment_sizes(label);
  const std::vector<double> radius = of_members(particles_.radius, whole.member);
  std::vector<std::int32_t> gone;
  for (std::int32_t f = 1; f < static_cast<std::int32_t>(sizes.size()); ++f)
    if (distance(whole.frame(), radius, label, f) > reach) gone.push_back(f);
  if (gone.empty()) return {};

  put_back(whole, lost_);
  retired_ += whole.integrator->statistics();
  const Frame lab = whole.integrator->laboratory();
  std::vector<std::vector<std::int32_t>> rows(1 + gone.size()), member(1 + gone.size());
  for (std::size_t row = 0; row < label.size(); ++row) {
    const auto place = std::find(gone.begin(), gone.end(), label[row]);
    const std::size_t part = place == gone.end() ? 0 : 1 + static_cast<std::size_t>(place - gone.begin());
    rows[part].push_back(static_cast<std::int32_t>(row));
    member[part].push_back(whole.member[row]);
  }
  std::vector<Piece> parts;
  for (std::size_t part = 0; part < rows.size(); ++part)
    parts.push_back(make_piece(std::move(member[part]), part_of(lab, rows[part])));
  pieces_[k] = std::move(parts.front());
  parts.erase(parts.begin());
  return parts;
}

void Pieces::fields(SavedFields& f) {
  saved_frame(f.in("lost"), lost_);
  SavedFields retired = f.in("retired");
  retired_.fields(retired);
  f.each("pieces", pieces_, [&](SavedFields& p, Piece& piece) {
    p("member", piece.member);
    Frame frame = piece.integrator ? piece.frame() : Frame{};
    saved_frame(p.in("frame"), frame);
    if (p.loading()) piece.integrator = make_(of_members(particles_.radius, piece.member), std::move(frame));
    p("last_rupture", piece.last_rupture);
    SavedFields inside = p.in("integrator");
    piece.integrator->fields(inside);
  });
}

}  // namespace crumble::breaker
