// Reads an agglomerate file. Throws OpenError if it cannot be opened and ContentError if it is not what it should be:
// another version, incomplete, or anything else that the checker refuses.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/agglomerate/agglomerate.hpp"
#include "common/io/form.hpp"
#include "common/io/hdf5.hpp"
#include "common/io/properties.hpp"
#include "common/io/provenance.hpp"

namespace crumble {

// What a file says about itself.
struct FileInfo {
  int version_major = 0, version_minor = 0;
  std::string stage, state;
  std::uint64_t particles = 0, frames = 0, contacts = 0;  // contacts: of the last frame
  std::int64_t first_step = 0, last_step = 0;
  double first_time = 0, last_time = 0;  // s
  std::uint64_t bytes = 0;
  Provenance provenance;
  Properties properties;
};

class AgglomerateReader {
 public:
  // Checks the whole file in a child process first, lest a damaged one takes the program down (see in_child.hpp).
  explicit AgglomerateReader(const std::filesystem::path& path);

  const FileInfo& info() const { return info_; }
  const Particles& particles() const { return particles_; }
  std::size_t frame_count() const { return info_.frames; }
  Frame frame(std::size_t t) const;
  Frame last_frame() const { return frame(frame_count() - 1); }

  // Names under /observables, and the rows of one of them in SI (semi_axes: 3 numbers a row).
  std::vector<std::string> observable_names() const;
  std::vector<double> observable(const std::string& name) const;

  std::string input() const;     // the scene as given; empty if there was none
  std::string resolved() const;  // the scene with every default

 private:
  friend Agglomerate read_agglomerate(const std::filesystem::path& path, std::optional<std::size_t> frame);
  friend FileInfo read_info(const std::filesystem::path& path);
  struct Unprotected {};
  AgglomerateReader(const std::filesystem::path& path, Unprotected);
  const hdf5::Dataset& checked(const std::string& path) const;
  bool has(const std::string& path) const;
  std::vector<double> real_rows(const std::string& path, std::uint64_t first, std::uint64_t count) const;
  std::vector<Vector3> vectors(const std::string& path, std::uint64_t first, std::uint64_t count) const;
  std::string text(const std::string& path) const;
  std::vector<Contact> contacts(std::uint64_t first, std::uint64_t count) const;
  [[noreturn]] void refuse(const Violation& violation) const;

  std::string name_;
  hdf5::File file_;
  mutable schema::Sizes sizes_;
  mutable std::map<std::string, hdf5::Dataset> checked_;
  std::vector<std::int64_t> steps_, offsets_;
  std::vector<double> times_;
  FileInfo info_;
  Particles particles_;
};

// One frame, the last unless told otherwise, with its contacts and their histories.
Agglomerate read_agglomerate(const std::filesystem::path& path, std::optional<std::size_t> frame);
Agglomerate read_agglomerate(const std::filesystem::path& path);

FileInfo read_info(const std::filesystem::path& path);

}  // namespace crumble
