#include "common/agglomerate/point_list.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>

namespace crumble {
namespace {

using Words = std::vector<std::string_view>;

std::string_view trimmed(std::string_view s) {
  const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  while (!s.empty() && blank(s.front())) s.remove_prefix(1);
  while (!s.empty() && blank(s.back())) s.remove_suffix(1);
  return s;
}

std::string lower(std::string_view s) {
  std::string out(s);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

std::string quoted(std::string_view s) {
  constexpr std::size_t longest = 40;
  return "'" + std::string(s.substr(0, longest)) + (s.size() > longest ? "...'" : "'");
}

Words split(std::string_view s, char separator) {
  Words words;
  for (std::size_t end; (end = s.find(separator)) != s.npos; s.remove_prefix(end + 1)) {
    words.push_back(trimmed(s.substr(0, end)));
  }
  words.push_back(trimmed(s));
  return words;
}

Words split_blank(std::string_view s) {
  Words words;
  for (s = trimmed(s); !s.empty(); s = trimmed(s)) {
    std::size_t end = 0;
    while (end < s.size() && std::isspace(static_cast<unsigned char>(s[end])) == 0) ++end;
    words.push_back(s.substr(0, end));
    s.remove_prefix(end);
  }
  return words;
}

// Lines with their numbers, for messages.
class Lines {
 public:
  Lines(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);  // byte order mark of spreadsheet programs
  }

  std::optional<std::string_view> next() {
    if (rest_.empty()) return std::nullopt;
    ++number_;
    const std::size_t end = rest_.find('\n');
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == rest_.npos ? rest_.size() : end + 1);
    return line;
  }

  int number() const { return number_; }
  const std::string& file() const { return file_; }
  bool only_blank_left() const { return trimmed(rest_).empty(); }

  PointListError error(const std::string& what) const {
    return PointListError(file_ + ":" + std::to_string(std::max(number_, 1)) + ": " + what);
  }

 private:
  std::string_view rest_;
  std::string file_;
  int number_ = 0;
};

double number(const Lines& lines, std::string_view word, const std::string& column) {
  std::string_view digits = word;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (problem != std::errc() || end != digits.data() + digits.size()) {
    throw lines.error(column + ": expected a number, found " + quoted(word));
  }
  if (!std::isfinite(value)) throw lines.error(column + ": expected a finite number, found " + quoted(word));
  return value;
}

double positive(const Lines& lines, std::string_view word, const std::string& column) {
  const double value = number(lines, word, column);
  if (!(value > 0)) throw lines.error(column + ": expected a radius > 0, found " + quoted(word));
  return value;
}

// Where x, y, z and, if there is one, the radius stand in a line of `width` words.
struct Columns {
  std::size_t x = 0, y = 0, z = 0, width = 0;
  std::optional<std::size_t> radius;
};

void take(PointList& list, const Lines& lines, const Words& words, const Columns& c) {
  list.position.push_back(
      {number(lines, words[c.x], "x"), number(lines, words[c.y], "y"), number(lines, words[c.z], "z")});
  if (c.radius) list.radius.push_back(positive(lines, words[*c.radius], "radius"));
  list.line.push_back(lines.number());
}

Columns csv_header(const Lines& lines, std::string_view line) {
  const Words names = split(line, ',');
  std::optional<std::size_t> x, y, z, radius;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::string name = lower(names[k]);
    std::optional<std::size_t>* column = name == "x"        ? &x
                                         : name == "y"      ? &y
                                         : name == "z"      ? &z
                                         : name == "radius" ? &radius
                                                            : nullptr;
    if (column == nullptr) {
      throw lines.error("expected a header of the columns x,y,z[,radius], found the column " + quoted(names[k]) +
                        (names.size() == 1 && line.find(';') != line.npos ? " (separate columns by commas)" : ""));
    }
    if (*column) throw lines.error("the column " + name + " stands twice in the header");
    *column = k;
  }
  for (const auto& [column, name] : {std::pair{x, "x"}, {y, "y"}, {z, "z"}}) {
    if (!column) throw lines.error(std::string("expected a header of the columns x,y,z[,radius], found no ") + name);
  }
  return {*x, *y, *z, names.size(), radius};
}

// The columns that an extended XYZ comment line declares; those of plain XYZ if it declares none.
Columns xyz_columns(const Lines& lines, std::string_view comment) {
  const std::string_view key = "properties=";
  const std::size_t begin = lower(comment).find(key);
  if (begin == std::string::npos) return {1, 2, 3, 0, std::nullopt};
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
    const Words words = split_blank(*line);
    const bool declared = columns.width > 0;
    if (declared ? words.size() != columns.width : words.size() < 4) {
      throw lines.error("expected " +
                        (declared ? std::to_string(columns.width) + " columns as declared by Properties"
                                  : std::string("a label and x y z")) +
                        ", found " + quoted(trimmed(*line)));
    }
    take(list, lines, words, columns);
  }
  return list;
}

}  // namespace

PointList parse_csv(std::string_view text, const std::string& file) {
  Lines lines(text, file);
  PointList list;
  std::optional<Columns> columns;
  while (const auto line = lines.next()) {
    const std::string_view content = trimmed(line->substr(0, line->find('#')));
    if (content.empty()) continue;
    if (!columns) {
      columns = csv_header(lines, content);
      continue;
    }
    const Words words = split(content, ',');
    if (words.size() != columns->width) {
      throw lines.error("expected " + std::to_string(columns->width) + " values as in the header, found " +
                        std::to_string(words.size()));
    }
    take(list, lines, words, *columns);
  }
  if (!columns) throw lines.error("expected a header x,y,z[,radius], found no text");
  if (list.position.empty()) throw lines.error("expected at least one sphere below the header, found none");
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
  std::error_code problem;
  if (std::filesystem::is_directory(file, problem)) throw PointListOpenError(file + ": is a directory");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw PointListOpenError(file + ": cannot be opened for reading");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return is_xyz ? parse_xyz(text, file) : parse_csv(text, file);
}

}  // namespace crumble
