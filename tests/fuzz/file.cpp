// The file of some edits: what the checker says, and that the reader, which asks it in the middle, refuses nothing
// else.
#include <fmt/format.h>

#include <cmath>

#include "common/agglomerate/morphology.hpp"
#include "common/io/agglomerate_reader.hpp"
#include "common/io/checker.hpp"
#include "tests/fuzz/edits.hpp"
#include "tests/fuzz/harness.hpp"

namespace crumble::fuzz {

namespace {

// All that is in a file, as programs ask for it.
std::string read_all(const std::filesystem::path& path) {
  const AgglomerateReader reader(path);
  std::size_t contacts = 0;
  double size = 0;
  for (std::size_t t = 0; t < reader.frame_count(); ++t) {
    const Frame frame = reader.frame(t);
    contacts += frame.contacts.size();
    size = radius_of_gyration(frame.position, reader.particles().mass);
    if (!std::isfinite(size)) throw Finding("a valid file has a radius of gyration that is no number");
  }
  for (const std::string& name : reader.observable_names())
    if (schema::find("/observables/" + name)) reader.observable(name);
  return fmt::format("valid: {} particles, {} frames, {} contacts, {:.6g} m, {} letters", reader.particles().size(),
                     reader.frame_count(), contacts, size, reader.input().size() + reader.resolved().size());
}

// Messages without the name of the file and what the library adds.
std::string bare(std::string text, const std::string& path) {
  for (auto at = text.find(path); at != text.npos; at = text.find(path)) text.erase(at, path.size());
  const auto library = text.find(" (HDF5:");
  return text.substr(0, library);
}

}  // namespace

std::string file(std::string_view edits) {
  const auto path = edited(edits);
  try {
    return bare(read_all(path), path.string());
  } catch (const FormatError& refused) {
    try {
      require_valid(path);
    } catch (const ContentError& error) {
      return bare(error.what(), path.string());
    }
    throw Finding(std::string("the reader refuses what the checker does not: ") + refused.what());
  }
}

}  // namespace crumble::fuzz
