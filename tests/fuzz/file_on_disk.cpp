// Files for edits on the disk, by the HDF5 library.
#include "tests/fuzz/edits.hpp"
#include "tests/temporary_folder.hpp"

namespace crumble::fuzz {

std::filesystem::path copy_of(const std::filesystem::path& sample) {
  static const test::Folder folder;
  const auto path = folder / "edited.h5";
  std::filesystem::copy_file(sample, path, std::filesystem::copy_options::overwrite_existing);
  return path;
}

}  // namespace crumble::fuzz
