#include "common/agglomerate/point_list.hpp"

#include <charconv>
#include <filesystem>
#include <optional>

#include "common/text/csv.hpp"

namespace crumble {

using namespace text;

namespace {

// Where x, y, z and, if there is one, the radius or the diameter stand in a line of `width` words.
struct Columns {
  std::size_t x = 0, y = 0, z = 0, width = 0;
  std::optional<std::size_t> radius, diameter;
};

// number(column, name) and word(column) of a line.
template <class Number, class Word>
void take(PointList& list, const Lines& lines, Number number, Word word, const Columns& c) {
  list.position.push_back({number(c.x, "x"), number(c.y, "y"), number(c.z, "z")});
  if (c.radius || c.diameter) {
    const std::size_t column = c.radius ? *c.radius : *c.diameter;
    const std::string name = c.radius ? "radius" : "diameter";
    const double value = number(column, name);
    if (!(value > 0)) throw lines.error(name + ": expected a " + name + " > 0, found " + quoted(word(column)));
    list.radius.push_back(c.radius ? value : 0.5 * value);
  }
  list.line.push_back(lines.number());
}

constexpr const char* csv_header = "x,y,z[,radius or diameter]";

Columns csv_columns(const Csv& csv) {
  const Lines& lines = csv.lines();
  const Words& names = csv.names();
  const std::string expected = std::string("expected a header of the columns ") + csv_header + ", found ";
  std::optional<std::size_t> x, y, z, radius, diameter;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::string name = lower(names[k]);
    std::optional<std::size_t>* column = name == "x"                         ? &x
                                         : name == "y"                       ? &y
                                         : name == "z"                       ? &z
                                         : name == "radius"                  ? &radius
                                         : name == "diameter" || name == "d" ? &diameter
                                                                             : nullptr;
    if (column == nullptr)
      throw lines.error(expected + "the column " + quoted(names[k]) +
                        (name == "r" ? " (radius or diameter? Write the word)" : ""));
    if (*column) throw lines.error("the column " + name + " stands twice in the header");
    *column = k;
  }
  for (const auto& [column, name] : {std::pair{x, "x"}, {y, "y"}, {z, "z"}}) {
    if (!column) throw lines.error(expected + "no " + name);
  }
  if (radius && diameter) throw lines.error("both a radius and a diameter stand in the header: leave one out");
  return {*x, *y, *z, names.size(), radius, diameter};
}

// The columns that an extended XYZ comment line declares; those of plain XYZ if it declares none.
Columns xyz_columns(const Lines& lines, std::string_view comment) {
  const std::string_view key = "properties=";
  const std::size_t begin = lower(comment).find(key);
  if (begin == std::string::npos) return {1, 2, 3, 0, {}, {}};
  std::string_view value = comment.substr(begin + key.size());
  const bool in_quotes = value.starts_with('"');
  if (in_quotes) value.remove_prefix(1);
  value = value.substr(0, value.find_first_of(in_quotes ? "\"" : " \t\r"));
  const Words parts = split(value, ':');
  if (parts.size() % 3 != 0) {
    throw lines.error("Properties: expected triplets name:type:columns, found " + quoted(value));
  }
  Columns c;
  bool has_position = false;
  for (std::size_t k = 0; k < parts.size(); k += 3) {
    std::size_t count = 0;
    const auto [end, problem] = std::from_chars(parts[k + 2].data(), parts[k + 2].data() + parts[k + 2].size(), count);
    if (problem != std::errc() || end != parts[k + 2].data() + parts[k + 2].size() || count == 0 || count > 1000) {
      throw lines.error("Properties: expected a number of columns for " + quoted(parts[k]) + ", found " +
                        quoted(parts[k + 2]));
    }
    const std::string name = lower(parts[k]);
    if (name == "pos" || name == "radius") {
      if (count != (name == "pos" ? 3u : 1u)) {
        throw lines.error("Properties: expected " + name + (name == "pos" ? ":R:3" : ":R:1") + ", found " +
                          quoted(value));
      }
    }
    if (name == "pos") {
      has_position = true;
      c.x = c.width;
      c.y = c.width + 1;
      c.z = c.width + 2;
    } else if (name == "radius") {
      c.radius = c.width;
    }
    c.width += count;
  }
  if (!has_position) throw lines.error("Properties: expected pos:R:3 among the columns, found " + quoted(value));
  return c;
}

std::size_t xyz_count(const Lines& lines, std::string_view line) {
  const std::string_view word = trimmed(line);
  std::size_t count = 0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (problem != std::errc() || end != word.data() + word.size() || count == 0) {
    throw lines.error("expected the number of spheres, found " + quoted(word));
  }
  return count;
}

PointList xyz_frame(Lines& lines, std::size_t count) {
  PointList list;
  const auto comment = lines.next();
  if (!comment) throw lines.error("expected a comment line behind the number of spheres, found the end of the file");
  const Columns columns = xyz_columns(lines, *comment);
  for (std::size_t k = 0; k < count; ++k) {
    const auto line = lines.next();
    if (!line) {
      throw lines.error("expected " + std::to_string(count) + " spheres, found the end of the file after " +
                        std::to_string(k));
    }
    const Words words = split_at_blanks(*line);
    const bool declared = columns.width > 0;
    if (declared ? words.size() != columns.width : words.size() < 4) {
      throw lines.error("expected " +
                        (declared ? std::to_string(columns.width) + " columns as declared by Properties"
                                  : std::string("a label and x y z")) +
                        ", found " + quoted(trimmed(*line)));
    }
    const auto word = [&](std::size_t column) { return words[column]; };
    take(
        list, lines, [&](std::size_t column, const std::string& name) { return lines.number_of(word(column), name); },
        word, columns);
  }
  return list;
}

}  // namespace

PointList parse_csv(std::string_view text, const std::string& file) {
  Csv csv(text, file, csv_header);
  const Columns columns = csv_columns(csv);
  PointList list;
  while (csv.next())
    take(
        list, csv.lines(), [&](std::size_t column, const std::string& name) { return csv.number(column, name); },
        [&](std::size_t column) { return csv[column]; }, columns);
  if (list.position.empty()) throw csv.lines().error("expected at least one sphere below the header, found none");
  list.file = file;
  return list;
}

PointList parse_xyz(std::string_view text, const std::string& file) {
  Lines lines(text, file);
  PointList list;
  int frames = 0;
  do {
    const auto first = lines.next();
    if (!first) throw lines.error("expected the number of spheres, found no text");
    list = xyz_frame(lines, xyz_count(lines, *first));
    ++frames;
  } while (!lines.only_blank_left());
  list.file = file;
  list.frames = frames;
  return list;
}

PointList read_points(const std::string& file) {
  const std::string ending = lower(std::filesystem::path(file).extension().string());
  const bool is_xyz = ending == ".xyz" || ending == ".extxyz";
  if (!is_xyz && ending != ".csv") {
    throw PointListOpenError(file + ": expected a name that ends with .csv, .xyz or .extxyz");
  }
  const std::string all = whole_file(file);
  return is_xyz ? parse_xyz(all, file) : parse_csv(all, file);
}

}  // namespace crumble
