#include "common/text/lines.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "common/text/words.hpp"

namespace crumble::text {

std::string whole_file(const std::string& file) {
  namespace fs = std::filesystem;
  std::error_code problem;
  const fs::file_type type = fs::status(file, problem).type();
  if (type == fs::file_type::directory) throw UnreadableError(file + ": is a directory");
  if (type == fs::file_type::character || type == fs::file_type::block)
    throw UnreadableError(file + ": is a device, not a file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw UnreadableError(file + ": cannot be opened for reading");
  return {std::istreambuf_iterator<char>(stream), {}};
}

Lines::Lines(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw TextError(file_ + ": is UTF-16, as spreadsheets write \"Unicode text\": save it as UTF-8");
  if (text.find('\0') != text.npos) throw TextError(file_ + ": holds zero bytes, so it is no text");
  if (text.find('\r') != text.npos && text.find('\n') == text.npos)
    throw TextError(file_ + ": ends its lines with CR alone, as old programs do: save it with LF or CRLF");
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
}

std::optional<std::string_view> Lines::next() {
  if (rest_.empty()) return std::nullopt;
  ++number_;
  const std::size_t end = rest_.find('\n');
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end == rest_.npos ? rest_.size() : end + 1);
  return line;
}

bool Lines::only_blank_left() const { return trimmed(rest_).empty(); }

TextError Lines::error(const std::string& what) const {
  return TextError(file_ + ":" + std::to_string(std::max(number_, 1)) + ": " + what);
}

double Lines::number_of(std::string_view word, const std::string& name) const {
  const auto value = to_number(word);
  if (!value) throw error(name + ": expected a number, found " + quoted(word));
  if (!std::isfinite(*value)) throw error(name + ": expected a finite number, found " + quoted(word));
  return *value;
}

}  // namespace crumble::text
