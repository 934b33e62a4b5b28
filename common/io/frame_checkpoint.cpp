#include "common/io/frame_checkpoint.hpp"

#include <array>
#include <utility>

namespace crumble {

namespace {

using Vectors = std::vector<Vector3> Frame::*;
constexpr std::array<std::pair<const char*, Vectors>, 5> vector_fields{{{"_position", &Frame::position},
                                                                        {"_velocity", &Frame::velocity},
                                                                        {"_angular_velocity", &Frame::angular_velocity},
                                                                        {"_force", &Frame::force},
                                                                        {"_torque", &Frame::torque}}};
constexpr std::array contact_vectors{&Contact::normal, &Contact::sliding, &Contact::rolling, &Contact::sliding_force,
                                     &Contact::rolling_torque};
constexpr std::array contact_numbers{&Contact::gap, &Contact::twisting, &Contact::normal_force,
                                     &Contact::twisting_torque};

}  // namespace

void store_frame(const Frame& frame, const std::string& name, Checkpoint& checkpoint) {
  checkpoint.reals[name + "_time"] = {frame.time};
  checkpoint.integers[name + "_step"] = {frame.step};
  for (const auto& [suffix, field] : vector_fields) {
    auto& numbers = checkpoint.reals[name + suffix];
    for (const Vector3& v : frame.*field) numbers.insert(numbers.end(), v.begin(), v.end());
  }
  auto& orientations = checkpoint.reals[name + "_orientation"];
  for (const Quaternion& q : frame.orientation) orientations.insert(orientations.end(), {q.w(), q.x(), q.y(), q.z()});
  auto& numbers = checkpoint.reals[name + "_contacts"];
  auto& counts = checkpoint.integers[name + "_contacts_between"];
  for (const Contact& c : frame.contacts) {
    for (const auto field : contact_vectors) numbers.insert(numbers.end(), (c.*field).begin(), (c.*field).end());
    for (const auto field : contact_numbers) numbers.push_back(c.*field);
    counts.insert(counts.end(), {c.i, c.j, c.born, c.at_limit});
  }
}

Frame restore_frame(const Checkpoint& checkpoint, const std::string& name) {
  Frame frame;
  frame.time = checkpoint.real(name + "_time").at(0);
  frame.step = checkpoint.integer(name + "_step").at(0);
  for (const auto& [suffix, field] : vector_fields) {
    const auto& numbers = checkpoint.real(name + suffix);
    for (std::size_t k = 0; k < numbers.size(); k += 3)
      (frame.*field).emplace_back(numbers.at(k), numbers.at(k + 1), numbers.at(k + 2));
  }
  const auto& orientations = checkpoint.real(name + "_orientation");
  for (std::size_t k = 0; k < orientations.size(); k += 4)
    frame.orientation.emplace_back(orientations.at(k), orientations.at(k + 1), orientations.at(k + 2),
                                   orientations.at(k + 3));
  const auto& counts = checkpoint.integer(name + "_contacts_between");
  auto number = checkpoint.real(name + "_contacts").begin();
  for (std::size_t k = 0; k < counts.size(); k += 4) {
    Contact c;
    for (const auto field : contact_vectors)
      for (double& v : c.*field) v = *number++;
    for (const auto field : contact_numbers) c.*field = *number++;
    c.i = static_cast<std::int32_t>(counts.at(k));
    c.j = static_cast<std::int32_t>(counts.at(k + 1));
    c.born = counts.at(k + 2);
    c.at_limit = static_cast<std::uint8_t>(counts.at(k + 3));
    frame.contacts.push_back(c);
  }
  return frame;
}

}  // namespace crumble
