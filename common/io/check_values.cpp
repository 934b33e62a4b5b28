#include "common/io/check_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <system_error>

#include "common/agglomerate/fragments.hpp"
#include "common/io/file_errors.hpp"
#include "common/io/sha256.hpp"

namespace crumble::check {

namespace {

const std::string positions = "/particles/all/position";

// Rows are read in blocks of about 8 MB, so that a file larger than the memory can be checked.
template <class T, class Use>
void for_blocks(const hdf5::Dataset& dataset, Use use) {
  const auto shape = dataset.shape();
  const std::uint64_t rows = shape.empty() ? 1 : shape[0];
  std::uint64_t width = 1;
  for (std::size_t d = 1; d < shape.size(); ++d) width *= shape[d];
  const std::uint64_t step = std::max<std::uint64_t>(1, 1000000 / std::max<std::uint64_t>(width, 1));
  for (std::uint64_t first = 0; first < rows; first += step)
    if (!use(first * width, dataset.read_rows<T>(first, std::min(step, rows - first)))) return;
}

}  // namespace

std::string place(const std::string& path, hdf5::Shape shape, std::uint64_t k) {
  std::string text;
  for (auto size = shape.rbegin(); size != shape.rend(); ++size) {
    text = fmt::format("[{}]", k % *size) + text;
    k /= *size;
  }
  return path + text;
}

std::string row(const std::string& path, std::uint64_t k) { return fmt::format("{}[{}]", path, k); }

namespace {

// The first place where a column does not grow, and how many there are.
template <class T>
void strictly_increasing(const Context& context, const std::string& path, const char* unit) {
  const auto values = context.root.dataset(path).read<T>();
  for (std::size_t k = 1; k < values.size(); ++k)
    if (!(values[k] > values[k - 1]))
      return context.add(row(path, k), fmt::format("more than the {}{} before", values[k - 1], unit),
                         fmt::format("{}{}", values[k], unit));
}

void positive(const Context& context, const std::string& path) {
  const auto values = context.root.dataset(path).read<double>();
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!(values[k] > 0)) return context.add(row(path, k), "a positive number", fmt::format("{}", values[k]));
}

// A whole-number observable that follows from the contacts.
void expect_count(const Context& context, const std::string& name, std::size_t t, std::int64_t expected) {
  const std::string path = "/observables/" + name;
  if (!context.has(path)) return;
  const auto found = context.root.dataset(path + "/value").read_rows<std::int64_t>(t, 1).front();
  if (found != expected) context.add(row(path + "/value", t), std::to_string(expected), std::to_string(found));
}

// False if the pairs of the frame are not a list of contacts.
bool pairs_are_sound(const Context& context, std::uint64_t first, const std::vector<std::int32_t>& pairs) {
  const auto n = static_cast<std::int64_t>(context.sizes.of("N"));
  const std::string path = "/contacts/pair";
  std::set<std::pair<std::int32_t, std::int32_t>> seen;
  std::pair<std::int32_t, std::int32_t> before{-1, -1};
  for (std::size_t k = 0; k < pairs.size() / 2; ++k) {
    const auto pair = std::pair(pairs[2 * k], pairs[2 * k + 1]);
    const auto found = fmt::format("{} {}", pair.first, pair.second);
    if (pair.first < 0 || pair.first >= pair.second || pair.second >= n) {
      context.add(row(path, first + k), fmt::format("0 <= i < j < {}", n), found);
      return false;
    }
    if (!seen.insert(pair).second) {
      context.add(row(path, first + k), "each pair once in a frame", found + " again");
      return false;
    }
    if (pair < before) {
      context.add(row(path, first + k), fmt::format("a pair after {} {} (sorted)", before.first, before.second), found);
      return false;
    }
    before = pair;
  }
  return true;
}

void check_frame(const Context& context, std::size_t t, const std::vector<std::int32_t>& pairs) {
  const std::uint64_t n = context.sizes.of("N");
  std::vector<Contact> contacts(pairs.size() / 2);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    contacts[k].i = pairs[2 * k];
    contacts[k].j = pairs[2 * k + 1];
  }
  const auto sizes = fragment_sizes(fragments(n, contacts));
  expect_count(context, "contact_count", t, static_cast<std::int64_t>(contacts.size()));
  expect_count(context, "fragment_count", t, static_cast<std::int64_t>(sizes.size()));
  expect_count(context, "largest_fragment", t, sizes.empty() ? 0 : sizes.front());
  const std::string coordination = "/observables/coordination_number";
  if (!context.has(coordination) || n == 0) return;
  const double expected = 2.0 * static_cast<double>(contacts.size()) / static_cast<double>(n);
  const double found = context.root.dataset(coordination + "/value").read_rows<double>(t, 1).front();
  if (!(std::abs(found - expected) <= 1e-12 * expected))  // one rounding, whatever the order of operations
    context.add(row(coordination + "/value", t), fmt::format("{}", expected), fmt::format("{}", found));
}

}  // namespace

void finite(const Context& context, const std::string& path) {
  const auto dataset = context.root.dataset(path);
  std::uint64_t count = 0, first = 0;
  double found = 0;
  for_blocks<double>(dataset, [&](std::uint64_t start, const std::vector<double>& values) {
    for (std::size_t k = 0; k < values.size(); ++k)
      if (!std::isfinite(values[k]) && count++ == 0) {
        first = start + k;
        found = values[k];
      }
    return true;
  });
  if (count > 0)
    context.add(place(path, dataset.shape(), first), "a finite number",
                fmt::format("{}{}", found, count > 1 ? fmt::format(" ({} such values)", count) : ""));
}

void increasing(const Context& context, const std::string& group) {
  strictly_increasing<std::int64_t>(context, group + "/step", "");
  strictly_increasing<double>(context, group + "/time", " s");
}

void same_instants(const Context& context, const std::string& group) {
  if (!context.has(positions)) return;
  for (const char* name : {"/step", "/time"}) {
    const auto ours = context.root.dataset(group + name), theirs = context.root.dataset(positions + name);
    // A time holds a 53-bit number and a step a smaller one in practice, so comparing both as doubles is exact.
    if (!ours.same_object(theirs) && ours.read<double>() != theirs.read<double>())
      context.add(group + name, "the values of " + positions + name, "others");
  }
}

void unit_length(const Context& context, const std::string& path, std::uint64_t width) {
  const auto dataset = context.root.dataset(path);
  for_blocks<double>(dataset, [&](std::uint64_t start, const std::vector<double>& values) {
    for (std::size_t k = 0; k + width <= values.size(); k += width) {
      double square = 0;
      for (std::size_t d = 0; d < width; ++d) square += values[k + d] * values[k + d];
      if (std::abs(std::sqrt(square) - 1) <= 1e-9 || !std::isfinite(square)) continue;
      auto shape = dataset.shape();
      shape.pop_back();
      context.add(place(path, shape, (start + k) / width), "length 1 within 1e-9",
                  fmt::format("{}", std::sqrt(square)));
      return false;
    }
    return true;
  });
}

void particles(const Context& context) {
  if (context.has("/particles/all/radius")) positive(context, "/particles/all/radius");
  if (context.has("/particles/all/mass")) positive(context, "/particles/all/mass");
  if (!context.has("/particles/all/id")) return;
  const auto ids = context.root.dataset("/particles/all/id").read<std::int64_t>();
  std::set<std::int64_t> seen;
  for (std::size_t k = 0; k < ids.size(); ++k)
    if (!seen.insert(ids[k]).second)
      return context.add(row("/particles/all/id", k), "each name once", fmt::format("{} again", ids[k]));
}

void contacts(const Context& context) {
  if (!context.has("/contacts/offset") || !context.has("/contacts/pair")) return;
  const auto offsets = context.root.dataset("/contacts/offset").read<std::int64_t>();
  const auto rows = static_cast<std::int64_t>(context.sizes.of("M"));
  bool sound = true;
  const auto wrong = [&](std::size_t k, std::string expected) {
    context.add(row("/contacts/offset", k), std::move(expected), std::to_string(offsets[k]));
    sound = false;
  };
  if (offsets.front() != 0) wrong(0, "0");
  for (std::size_t k = 1; sound && k < offsets.size(); ++k)
    if (offsets[k] < offsets[k - 1]) wrong(k, fmt::format("at least the {} before", offsets[k - 1]));
  if (sound && offsets.back() != rows) wrong(offsets.size() - 1, fmt::format("{}, the number of contacts", rows));
  if (!sound) return;
  const auto pairs = context.root.dataset("/contacts/pair");
  std::vector<std::int32_t> of_frame;
  for (std::size_t t = 0; t + 1 < offsets.size(); ++t) {
    const auto first = static_cast<std::uint64_t>(offsets[t]);
    of_frame = pairs.read_rows<std::int32_t>(first, static_cast<std::uint64_t>(offsets[t + 1]) - first);
    sound = pairs_are_sound(context, first, of_frame) && sound;
    if (sound) check_frame(context, t, of_frame);
  }
  const std::string last = "/connectivity/contacts";
  if (context.has(last) && context.root.dataset(last).read<std::int32_t>() != of_frame)
    context.add(last, "the pairs of the last frame", "others");
}

void parent(const Context& context, const std::filesystem::path& file) {
  const auto group = context.root.group("/parameters/provenance");
  if (!group.has_attribute("parent")) return;
  const std::string path = "/parameters/provenance@parent_sha256";
  if (!context.has(path)) return context.add(path, "the SHA-256 of the parent", "nothing");
  const auto names = group.text_attribute("parent"), hashes = group.text_attribute("parent_sha256");
  const auto place = file.parent_path() / names.at(0);
  std::error_code problem;
  if (!std::filesystem::is_regular_file(place, problem)) return;  // moved or deleted: nothing to compare with
  try {
    if (const auto found = sha256_of_file(place); found != hashes.at(0))
      context.add(path, found + ", that of " + place.string(), hashes.at(0));
  } catch (const OpenError&) {
    // there but not readable: nothing to compare with either
  }
}

}  // namespace crumble::check
