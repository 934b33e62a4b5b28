#include "common/io/program.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <new>

#include "common/io/errors.hpp"
#include "common/io/interrupt.hpp"

namespace crumble {
namespace {

int fail(int code, const std::string& message) {
  std::fprintf(stderr, "%s\n", message.c_str());
  return code;
}

// A live line that wraps could not be wiped.
std::string cut_to_width(std::string line, std::FILE* terminal) {
  winsize size{};
  const bool known = ::ioctl(::fileno(terminal), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  line.resize(std::min<std::size_t>(line.size(), known ? size.ws_col - 1u : 79u));
  return line;
}

// Seconds from one report to the next: a live line changes twice a second; a log gets a line every 2 s at first and
// every minute in the end, so that neither a short run is silent nor a long one fills the disk.
double interval(bool live, double elapsed) { return live ? 0.5 : std::clamp(elapsed / 10, 2.0, 60.0); }

}  // namespace

int run_program(const std::string& name, const std::function<int()>& body) {
  std::signal(SIGPIPE, SIG_IGN);  // a reader of our messages that goes away must not end the run
  watch_for_interrupts();
  try {
    return body();
  } catch (const Interrupted& stop) {
    return fail(128 + stop.signal, name + ": " + stop.what());
  } catch (const InputError& error) {
    return fail(2, error.what());  // begins with the file and line, as editors like it
  } catch (const FormatError& error) {
    return fail(3, name + ": " + error.what());
  } catch (const std::bad_alloc&) {
    return fail(1, name + ": out of memory");
  } catch (const std::logic_error& error) {
    return fail(1, name + ": internal error: " + error.what());
  } catch (const std::exception& error) {
    return fail(1, name + ": " + error.what());
  }
}

ProgressPrinter::ProgressPrinter(std::FILE* out, std::string label, bool quiet)
    : out_(out),
      progress_(std::move(label)),
      quiet_(quiet),
      live_(::isatty(::fileno(out)) == 1),
      begin_(std::chrono::steady_clock::now()),
      due_(begin_) {}

ProgressPrinter::~ProgressPrinter() { clear(); }

void ProgressPrinter::clear() {
  if (!on_screen_) return;
  std::fputs("\r\033[K", out_);
  std::fflush(out_);
  on_screen_ = false;
}

void ProgressPrinter::update(double fraction, std::int64_t steps, const std::function<std::string()>& status) {
  if (quiet_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now < due_) return;
  const bool first = due_ == begin_;
  const double elapsed = std::chrono::duration<double>(now - begin_).count();
  due_ = now + std::chrono::milliseconds(std::lround(1000 * interval(live_, elapsed)));
  const std::string line = progress_.line(elapsed, fraction, steps, status());
  if (live_) {
    clear();
    std::fputs(cut_to_width(line, out_).c_str(), out_);
    on_screen_ = true;
  } else if (!first) {  // nothing is known yet
    std::fprintf(out_, "%s\n", line.c_str());
  }
  std::fflush(out_);
}

void ProgressPrinter::say(const std::string& message) {
  if (quiet_) return;
  clear();
  std::fprintf(out_, "%s\n", message.c_str());
  std::fflush(out_);
}

}  // namespace crumble
