// Edits that reach every array and attribute of the schema.
#include <fmt/format.h>

#include "common/io/schema.hpp"
#include "tests/fuzz/mutation.hpp"

namespace crumble::fuzz {

namespace {

struct Target {
  std::string path, attribute, type;  // attribute: of the group `path`
  std::string shape;
};

std::vector<Target> targets() {
  std::vector<Target> list;
  for (const schema::Entry& entry : schema::table()) {
    const auto mark = entry.path.find("<name>");
    for (const char* name : {"shear", "elongation", "front_speed", "contacts", "other"}) {
      std::string path(entry.path);
      if (mark != path.npos) path.replace(mark, 6, name);
      const std::string type(hdf5::type_name(entry.type)), shape(entry.shape);
      const auto at = path.find('@');
      using schema::Layout;
      if (entry.layout == Layout::attribute) {
        list.push_back({path.substr(0, at), path.substr(at + 1), type, shape});
      } else if (entry.layout == Layout::frames || entry.layout == Layout::samples) {
        const std::string rows(schema::words(shape).front());
        list.push_back({path + "/value", "", type, shape});
        list.push_back({path + "/step", "", "int64", rows});
        list.push_back({path + "/time", "", "float64", rows});
        list.push_back({path, "", "", ""});
      } else {
        list.push_back({path, "", type, shape});
      }
      if (mark == path.npos) break;
    }
  }
  return list;
}

std::string sizes(const std::string& symbols, Random& random) {
  static const std::vector<std::string> usual{"0", "1", "2", "3", "4", "5", "8", "16", "19"};
  if (symbols.empty()) return below(random, 4) ? "-" : "1";
  std::string text;
  for (const auto symbol : schema::words(symbols)) {
    const bool fixed = std::isdigit(static_cast<unsigned char>(symbol[0])) && below(random, 8);
    text += (text.empty() ? "" : "x") + (fixed ? std::string(symbol) : one_of(random, usual));
  }
  return text;
}

std::string numbers(Random& random) {
  std::string text;
  for (std::size_t k = 1 + below(random, 4); k > 0; --k) text += " " + any_number(random);
  return text;
}

std::string fresh(Random& random) {
  static const std::vector<Target> all = targets();
  static const std::vector<std::string> types{"int32", "int64", "uint8", "uint64", "float64"};
  static const std::vector<std::string> symbols{"T", "N", "M", "L", "K", "P", "B", "E", "F"};
  static const std::vector<std::string> words{"nm",          "m",           "",       "s",   "dryer",   "breaker",
                                              "rigidstress", "agglomerate", "drying", "dry", "relaxed", "broken",
                                              "none",        "SI",          "shear",  "all"};
  const Target& target = one_of(random, all);
  const std::string type = below(random, 6) ? target.type : one_of(random, types);
  if (!target.attribute.empty() && below(random, 4))
    return fmt::format("attribute {} {} {}{}", target.path, target.attribute, type,
                       type == "text" ? " " + one_of(random, words) : numbers(random));
  switch (below(random, 12)) {
    case 0:
    case 1:
      return fmt::format("size {} {}", one_of(random, symbols), below(random, 6));
    case 2:
    case 3:
    case 4:
    case 5:
      return fmt::format("number {} {} {}", target.path, below(random, 60), any_number(random));
    case 6:
    case 7:
      return fmt::format("array {} {} {}{}", target.path, type, sizes(target.shape, random), numbers(random));
    case 8:
      return fmt::format("declare {} {} {}", target.path, type, below(random, 2) ? "1000000000000x3" : "7");
    case 9:
      return fmt::format("unit {} {}", target.path, one_of(random, words));
    case 10:
      return below(random, 2) ? "remove " + target.path : "group " + target.path;
    default:
      break;
  }
  if (below(random, 3) == 0) return fmt::format("text {} {}", target.path, one_of(random, words));
  return fmt::format("{} {} {}", below(random, 2) ? "soft" : "hard", one_of(random, all).path, target.path);
}

}  // namespace

std::string mutated_edits(const std::string& edits, Random& random) {
  std::string text = edits;
  if (!text.starts_with("base ")) text = "base import\n" + text;
  if (below(random, 20) == 0) {
    static const std::vector<std::string> bases{"import", "dryer", "breaker", "rigidstress"};
    text = "base " + one_of(random, bases) + text.substr(std::min(text.find('\n'), text.size()));
  }
  return mutated_lines(text, random, 1, [&] { return fresh(random); });
}

}  // namespace crumble::fuzz
