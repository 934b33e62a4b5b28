#include "common/io/earlier_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "common/io/file_errors.hpp"
#include "common/io/hdf5.hpp"
#include "common/io/in_child.hpp"
#include "common/io/settings.hpp"

namespace crumble {

namespace {

// What differs, in words; nothing if it is a result of the same scene and granule.
std::string difference(const std::string& output, const Provenance& now, const std::string& resolved) {
  const hdf5::File file = hdf5::File::open(output);
  const hdf5::Group from = file.group("/parameters/provenance");
  const auto text = [&](const char* name) {
    return from.has_attribute(name) ? from.text_attribute(name).at(0) : std::string();
  };
  if (const std::string program = text("program"); program != now.program) return "a result of " + program;
  // The parent stands in the file as seen from it.
  namespace fs = std::filesystem;
  if (const std::string parent = text("parent");
      text("parent_sha256") != now.parent_sha256 && fs::weakly_canonical(fs::absolute(output).parent_path() / parent) !=
                                                        fs::weakly_canonical(fs::absolute(now.parent)))
    return "the result of another granule, " + parent;
  auto other = differences(settings_in(file.dataset("/parameters/resolved").read_text()), settings_in(resolved));
  std::erase_if(other, [](const auto& d) { return d.key == "output.checkpoint_interval"; });  // no part of a result
  std::string all;
  constexpr std::size_t shown = 3;
  for (std::size_t k = 0; k < std::min(other.size(), shown); ++k)
    all += fmt::format("{}{} = {}, here {}", k ? "; " : "", other[k].key, other[k].first, other[k].second);
  if (other.size() > shown) all += fmt::format("; and {} more", other.size() - shown);
  return all.empty() ? "" : fmt::format("the result of another scene ({})", all);
}

}  // namespace

void require_no_other_result(const std::string& output, const Provenance& now, const std::string& resolved) {
  std::error_code missing;
  if (const auto bytes = std::filesystem::file_size(output, missing); missing || bytes == 0) return;
  std::string what;
  try {
    what = in_child(output, [&] { return difference(output, now, resolved); });
  } catch (const OpenError&) {
    what = "a file that is no result";
  } catch (const ContentError&) {
    what = "a file that is no result";
  }
  if (!what.empty())
    throw InputError(
        fmt::format("-o {}: there is already {}; give another name, or --overwrite to replace it", output, what));
}

}  // namespace crumble
