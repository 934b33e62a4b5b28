#include "tests/fuzz/edits.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "common/io/schema.hpp"
#include "common/text/words.hpp"

namespace crumble::fuzz {

namespace {

using hdf5::File;
using hdf5::Kind;
using hdf5::Shape;
using hdf5::Type;

constexpr std::uint64_t most_values = 4096;

std::optional<std::uint64_t> whole(std::string_view word) {
  std::uint64_t value = 0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (problem != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

// A word as a number of type T; what has no such number is 0.
template <class T>
T number(std::string_view word) {
  if constexpr (std::is_floating_point_v<T>) {
    return text::to_number(word).value_or(0);
  } else {
    std::int64_t value = 0;
    std::from_chars(word.data(), word.data() + word.size(), value);
    if constexpr (std::is_same_v<T, std::uint64_t>) return static_cast<T>(value);
    return static_cast<T>(
        std::clamp<std::int64_t>(value, std::numeric_limits<T>::min(), std::numeric_limits<T>::max()));
  }
}

std::optional<Shape> shape_of(std::string_view word) {
  Shape shape;
  if (word == "-") return shape;
  for (const std::string_view part : text::split(word, 'x')) {
    const auto size = whole(part);
    if (!size || shape.size() == 4) return std::nullopt;
    shape.push_back(*size);
  }
  return shape;
}

std::optional<Type> type_named(std::string_view word) {
  for (const Type type : {Type::int32, Type::int64, Type::uint8, Type::uint64, Type::float64, Type::text})
    if (hdf5::type_name(type) == word) return type;
  return std::nullopt;
}

// use(T()) with the C++ type of a number.
template <class Use>
void with_type(Type type, Use use) {
  if (type == Type::int32) use(std::int32_t());
  if (type == Type::int64) use(std::int64_t());
  if (type == Type::uint8) use(std::uint8_t());
  if (type == Type::uint64) use(std::uint64_t());
  if (type == Type::float64) use(double());
}

class Editor {
 public:
  explicit Editor(File& file) : file_(file) {}

  void apply(const text::Words& w, std::string_view line) {
    const auto rest = [&](std::size_t k) {  // of the line from word k on
      return k < w.size() ? line.substr(static_cast<std::size_t>(w[k].data() - line.data())) : std::string_view();
    };
    if (w.size() == 3 && w[0] == "size") resize(std::string(w[1]), w[2]);
    if (w.size() == 4 && w[0] == "number") change(w[1], w[2], w[3]);
    if (w.size() >= 5 && w[0] == "array") array(w[1], w[2], w[3], {w.begin() + 4, w.end()});
    if (w.size() == 4 && w[0] == "declare") declare(w[1], w[2], w[3]);
    if (w.size() >= 2 && w[0] == "unit" && file_.kind(w[1]) == Kind::dataset)
      file_.dataset(w[1]).set_attribute("unit", rest(2).substr(0, 100));
    if (w.size() >= 4 && w[0] == "attribute")
      attribute(w[1], std::string(w[2]), w[3], {w.begin() + 4, w.end()}, rest(4));
    if (w.size() >= 2 && w[0] == "text" && free(w[1])) file_.write_text(w[1], rest(2));
    if (w.size() == 2 && w[0] == "remove") free(w[1]);
    if (w.size() == 2 && w[0] == "group") file_.create_group(w[1]);
    if (w.size() == 3 && w[0] == "soft" && free(w[2])) file_.soft_link(w[1], w[2]);
    if (w.size() == 3 && w[0] == "hard" && file_.kind(w[1]) != Kind::missing && free(w[2])) file_.hard_link(w[1], w[2]);
  }

 private:
  // A path at which something new can be made; what was there is gone.
  bool free(std::string_view path) {
    if (!path.starts_with('/') || path.ends_with('/') || path.find("//") != path.npos || path.find("/.") != path.npos)
      return false;
    try {
      file_.unlink(path);
    } catch (const WriteError&) {
    }
    return true;
  }

  template <class T>
  void create(std::string_view path, const Shape& shape, const std::vector<T>& values, const std::string& unit) {
    if (!free(path)) return;
    auto dataset = file_.create_dataset<T>(path, shape);
    dataset.template write<T>(values);
    if (!unit.empty()) dataset.set_attribute("unit", unit);
  }

  std::string unit_of(std::string_view path) const {
    if (file_.kind(path) != Kind::dataset) return "";
    const auto dataset = file_.dataset(path);
    if (!dataset.has_attribute("unit") || dataset.attribute_type("unit") != Type::text) return "";
    const auto units = dataset.text_attribute("unit");
    return units.empty() ? "" : units[0];
  }

  void change(std::string_view path, std::string_view index, std::string_view value) {
    if (file_.kind(path) != Kind::dataset || !whole(index)) return;
    auto dataset = file_.dataset(path);
    if (!dataset.is_stored() || dataset.type() == Type::text) return;
    with_type(dataset.type(), [&]<class T>(T) {
      auto values = dataset.read<T>();
      if (values.empty()) return;
      values[*whole(index) % values.size()] = number<T>(value);
      dataset.write<T>(values);
    });
  }

  void array(std::string_view path, std::string_view type_word, std::string_view shape_word, const text::Words& words) {
    const auto type = type_named(type_word);
    const auto shape = shape_of(shape_word);
    if (!type || !shape || hdf5::element_count(*shape) > most_values) return;
    with_type(*type, [&]<class T>(T) {
      std::vector<T> values(hdf5::element_count(*shape));
      for (std::size_t k = 0; k < values.size(); ++k) values[k] = number<T>(words[k % words.size()]);
      create<T>(path, *shape, values, unit_of(path));
    });
  }

  void declare(std::string_view path, std::string_view type_word, std::string_view shape_word) {
    const auto type = type_named(type_word);
    auto shape = shape_of(shape_word);
    if (!type || !shape || shape->empty()) return;
    // Chunks that HDF5 takes; rows as many as it numbers.
    for (std::size_t d = 1; d < shape->size(); ++d) (*shape)[d] = std::clamp<std::uint64_t>((*shape)[d], 1, 100);
    const std::uint64_t rows = std::min<std::uint64_t>(shape->front(), std::uint64_t(1) << 50);
    const std::string unit = unit_of(path);
    shape->front() = 1;
    with_type(*type, [&]<class T>(T) {
      if (!free(path)) return;
      auto dataset = file_.create_dataset<T>(path, *shape, 1);
      dataset.resize_rows(rows);
      if (!unit.empty()) dataset.set_attribute("unit", unit);
    });
  }

  void attribute(std::string_view path, const std::string& name, std::string_view type_word, const text::Words& words,
                 std::string_view rest) {
    if (file_.kind(path) != Kind::group || words.size() > 8) return;
    const auto type = type_named(type_word);
    auto group = file_.group(path);
    if (type == Type::text) group.set_attribute(name, rest.substr(0, 200));
    if (type)
      with_type(*type, [&]<class T>(T) {
        std::vector<T> values;
        for (const auto word : words) values.push_back(number<T>(word));
        if (!values.empty()) group.set_attribute<T>(name, values, values.size() == 1);
      });
  }

  // All arrays of the schema in which the symbol stands, so that they still fit each other.
  void resize(const std::string& symbol, std::string_view count_word) {
    const auto count = whole(count_word);
    if (!count || *count > 64) return;
    for (const schema::Entry& entry : schema::table()) {
      using schema::Layout;
      const bool timed = entry.layout == Layout::frames || entry.layout == Layout::samples;
      if (!timed && entry.layout != Layout::dataset) continue;
      for (const std::string& path : instances(std::string(entry.path))) {
        const auto symbols = schema::words(entry.shape);
        resize_one(timed ? path + "/value" : path, symbols, symbol, *count);
        if (timed) {
          resize_one(path + "/step", {symbols.front()}, symbol, *count);
          resize_one(path + "/time", {symbols.front()}, symbol, *count);
        }
      }
    }
  }

  std::vector<std::string> instances(const std::string& path) const {
    const auto mark = path.find("<name>");
    if (mark == path.npos) return {path};
    std::vector<std::string> list;
    const std::string parent = path.substr(0, mark - 1);
    if (file_.kind(parent) == Kind::group)
      for (const auto& name : file_.group(parent).names())
        list.push_back(path.substr(0, mark) + name + path.substr(mark + 6));
    return list;
  }

  void resize_one(const std::string& path, const std::vector<std::string_view>& symbols, const std::string& symbol,
                  std::uint64_t count) {
    if (file_.kind(path) != Kind::dataset) return;
    const auto dataset = file_.dataset(path);
    const Shape before = dataset.shape();
    if (before.size() != symbols.size() || !dataset.is_stored()) return;
    Shape after = before;
    for (std::size_t d = 0; d < symbols.size(); ++d) {
      if (symbols[d] == symbol) after[d] = count;
      if (symbols[d] == symbol + "+1") after[d] = count + 1;
    }
    if (after == before || hdf5::element_count(after) > 64 * most_values) return;
    with_type(dataset.type(), [&]<class T>(T) {
      const auto old = dataset.read<T>();
      std::vector<T> values(hdf5::element_count(after));
      for (std::uint64_t k = 0; !old.empty() && k < values.size(); ++k) {
        std::uint64_t rest = k, place = 0, stride = 1;
        for (std::size_t d = after.size(); d-- > 0; rest /= after[d], stride *= before[d])
          place += stride * (rest % after[d] % before[d]);
        values[k] = old[place];
      }
      create<T>(path, after, values, unit_of(path));
    });
  }

  File& file_;
};

}  // namespace

std::filesystem::path edited(std::string_view edits) {
  std::string base = "import";
  std::filesystem::path path;
  std::optional<File> file;
  for (bool first = true; first || !edits.empty(); first = false) {
    const auto end = edits.find('\n');
    const std::string_view line = edits.substr(0, end);
    edits.remove_prefix(end == edits.npos ? edits.size() : end + 1);
    const text::Words words = text::split_at_blanks(line);
    if (first && words.size() == 2 && words[0] == "base")
      for (const char* known : {"dryer", "breaker", "rigidstress"})
        if (words[1] == known) base = known;
    if (first) {
      path = copy_of(std::string(CRUMBLE_SOURCE_DIR "/data/samples/") + base + "-1.2.h5");
      file = File::modify(path);
    }
    try {
      if (line.find('\0') == line.npos) Editor(*file).apply(words, line);
    } catch (const WriteError&) {
    } catch (const ContentError&) {
    }
  }
  file->close();
  return path;
}

}  // namespace crumble::fuzz
