#include "common/io/state_stream.hpp"

#include <array>

#include "common/io/file_errors.hpp"

namespace crumble {
namespace {

template <class T>
std::span<const char> bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

void put_count(std::uint64_t count, const PutBytes& put) { put(bytes_of(std::span<const std::uint64_t>(&count, 1))); }

template <class T>
void put_arrays(const std::map<std::string, std::vector<T>>& arrays, const PutBytes& put) {
  put_count(arrays.size(), put);
  for (const auto& [name, values] : arrays) {
    put_text(name, put);
    put_count(values.size(), put);
    put(bytes_of(std::span<const T>(values)));
  }
}

}  // namespace

void put_text(std::string_view text, const PutBytes& put) {
  put_count(text.size(), put);
  put(text);
}

void put_state(const SavedState& state, const PutBytes& put) {
  put_arrays(state.reals, put);
  put_arrays(state.integers, put);
}

StateReader::StateReader(const std::filesystem::path& path) : path_(path), file_(path, std::ios::binary) {
  std::error_code problem;
  left_ = std::filesystem::file_size(path, problem);
  if (problem || !file_) throw OpenError(path.string() + ": cannot be read");
}

StateReader::StateReader(const std::filesystem::path& path, std::uint64_t bytes) : StateReader(path) {
  if (left_ < bytes) damaged();
  left_ = bytes;
}

void StateReader::damaged() const { throw ContentError(path_.string() + ": is damaged: not what was written"); }

void StateReader::take(void* to, std::uint64_t bytes) {
  if (bytes > left_) damaged();
  file_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes));
  if (!file_) throw OpenError(path_.string() + ": cannot be read");
  digest_.add({static_cast<const char*>(to), bytes});
  left_ -= bytes;
}

std::uint64_t StateReader::count(std::uint64_t width) {
  std::uint64_t number = 0;
  take(&number, sizeof number);
  if (number > left_ / width) damaged();
  return number;
}

std::string StateReader::exactly(std::uint64_t bytes) {
  if (bytes > left_) damaged();
  std::string text(bytes, '\0');
  take(text.data(), bytes);
  return text;
}

std::string StateReader::text() { return exactly(count(1)); }

template <class T>
std::vector<T> StateReader::numbers() {
  std::vector<T> values(count(sizeof(T)));
  take(values.data(), values.size() * sizeof(T));
  return values;
}

SavedState StateReader::state() {
  SavedState state;
  for (std::uint64_t k = count(1); k > 0; --k) {
    std::string name = text();
    state.reals[std::move(name)] = numbers<double>();
  }
  for (std::uint64_t k = count(1); k > 0; --k) {
    std::string name = text();
    state.integers[std::move(name)] = numbers<std::int64_t>();
  }
  return state;
}

void StateReader::skip_to_end() {
  std::array<char, 1 << 16> block;
  while (left_ > 0) take(block.data(), std::min<std::uint64_t>(left_, block.size()));
}

}  // namespace crumble
