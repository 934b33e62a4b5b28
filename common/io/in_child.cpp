#include "common/io/in_child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <new>
#include <system_error>

#include "common/io/file_errors.hpp"
#include "common/io/interrupt.hpp"

namespace crumble {

namespace {

void limit(int resource, std::uint64_t value) {
  rlimit now{};
  getrlimit(static_cast<__rlimit_resource_t>(resource), &now);
  now.rlim_cur = std::min<rlim_t>(value, now.rlim_max);
  setrlimit(static_cast<__rlimit_resource_t>(resource), &now);
}

// Checking runs at more than 100 MB/s and holds a few blocks in memory; ten times that is generous.
void limit_child(std::uint64_t bytes) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, 5 + bytes / 10'000'000);
#ifndef __SANITIZE_ADDRESS__  // whose shadow memory is counted too
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  limit(RLIMIT_AS, pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + (1u << 30) + 8 * bytes);
#endif
  // The C library reports a damaged heap on stderr.
  const int null = open("/dev/null", O_WRONLY);
  if (null >= 0) dup2(null, STDERR_FILENO);
}

// 'v' value, 'o' OpenError, 'i' InputError, 'c' ContentError, with the text after it.
std::string outcome(const std::function<std::string()>& work) {
  try {
    return "v" + work();
  } catch (const OpenError& error) {
    return std::string("o") + error.what();
  } catch (const InputError& error) {
    return std::string("i") + error.what();
  } catch (const std::exception& error) {
    return std::string("c") + error.what();
  }
}

void write_all(int pipe, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const auto count = write(pipe, text.data() + done, text.size() - done);
    if (count < 0 && errno != EINTR) return;
    if (count > 0) done += static_cast<std::size_t>(count);
  }
}

std::string read_all(int pipe) {
  std::string text;
  std::array<char, 4096> block;
  for (;;) {
    const auto count = read(pipe, block.data(), block.size());
    if (count == 0 || (count < 0 && errno != EINTR)) return text;
    if (count > 0) text.append(block.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

std::string in_child(const std::filesystem::path& file, const std::function<std::string()>& work) {
  std::error_code ignored;
  const auto size = std::filesystem::file_size(file, ignored);
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const pid_t child = fork();
  if (child < 0) {
    close(ends[0]);
    close(ends[1]);
    throw std::system_error(errno, std::generic_category(), "fork");
  }
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    close(ends[0]);
    limit_child(ignored ? 0 : size);
    write_all(ends[1], outcome(work));
    _exit(0);
  }
  close(ends[1]);
  const std::string text = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || text.empty()) {
    if (const int stopped = interrupt_signal()) throw Interrupted(stopped);  // Ctrl-C is for the child, too
    const bool slow = WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
    throw ContentError(fmt::format("{}: is damaged: the HDF5 library {} on it", file.string(),
                                   slow ? "does not come to an end" : "crashes"));
  }
  if (text[0] == 'o') throw OpenError(text.substr(1));
  if (text[0] == 'i') throw InputError(text.substr(1));
  if (text[0] == 'c') throw ContentError(text.substr(1));
  return text.substr(1);
}

}  // namespace crumble
