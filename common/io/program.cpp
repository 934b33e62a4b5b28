#include "common/io/program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <system_error>

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
// every 5 s in the end, 1 MB a day.
double interval(bool live, double elapsed) { return live ? 0.5 : std::clamp(elapsed / 10, 2.0, 5.0); }

// A program may be started with these closed, as daemons are. The first file that it opens would get such a number, and
// messages would go into it.
void open_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(descriptor, F_GETFD) < 0 && ::open("/dev/null", O_RDWR) != descriptor) std::abort();
}

// Raised to what our deepest calls need with room to spare, if the hard limit allows: beyond its end a program crashes.
void require_stack() {
  constexpr rlim_t needed = 2 << 20;  // bytes
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= needed) return;
  limit.rlim_cur = std::min<rlim_t>(needed, limit.rlim_max);
  if (limit.rlim_cur < needed || ::setrlimit(RLIMIT_STACK, &limit) != 0)
    throw InputError(fmt::format("the stack is limited to {} kB, {} kB are needed (ulimit -s {})", limit.rlim_max >> 10,
                                 needed >> 10, needed >> 10));
  pthread_attr_t threads;
  ::pthread_attr_init(&threads);
  ::pthread_attr_setstacksize(&threads, needed);
  ::pthread_setattr_default_np(&threads);  // of threads that do not say how much they want
  ::pthread_attr_destroy(&threads);
}

}  // namespace

int run_program(const std::string& name, const std::function<int()>& body) {
  open_standard_streams();
  std::signal(SIGPIPE, SIG_IGN);  // a reader of our messages that goes away must not end the run
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is then an error of the write, as a full disk is
  watch_for_interrupts(name);
  struct Watch {
    ~Watch() { end_watch(); }
  } watch;
  try {
    require_stack();
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

void deliver(const std::string& answer, const std::function<void()>& write_report) {
  std::exception_ptr problem;
  try {
    write_report();
  } catch (const std::exception&) {
    problem = std::current_exception();
  }
  const bool printed = std::fwrite(answer.data(), 1, answer.size(), stdout) == answer.size();
  if (std::fflush(stdout) != 0 || !printed)
    throw std::runtime_error(fmt::format("the result cannot be printed to stdout: {}", std::strerror(errno)));
  if (problem) std::rethrow_exception(problem);
}

ProgressPrinter::ProgressPrinter(std::FILE* out, std::string label, bool quiet)
    : out_(out),
      label_(std::move(label)),
      progress_(label_),
      quiet_(quiet),
      live_(::isatty(::fileno(out)) == 1),
      begin_(Clock::now()),
      due_(begin_),
      last_(begin_),
      heard_(begin_) {
  if (quiet) return;
  try {
    heart_ = std::jthread([this](const std::stop_token& stop) { beat(stop); });
  } catch (const std::system_error&) {
  }  // a limit on threads: then long steps are silent
}

ProgressPrinter::~ProgressPrinter() {
  heart_ = {};
  clear();
}

void ProgressPrinter::clear() {
  if (!on_screen_) return;
  std::fputs("\r\033[K", out_);
  std::fflush(out_);
  on_screen_ = false;
}

void ProgressPrinter::print(const std::string& line) {
  if (live_) {
    clear();
    std::fputs(cut_to_width(line, out_).c_str(), out_);
    on_screen_ = true;
  } else {
    std::fprintf(out_, "%s\n", line.c_str());
  }
  std::fflush(out_);
  last_ = Clock::now();
}

// Within a long step nobody calls update().
void ProgressPrinter::beat(const std::stop_token& stop) {
  const std::chrono::milliseconds silence(live_ ? 1000 : 7000);  // longer than what update() leaves
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    const auto next = last_ + silence;
    if (next > Clock::now()) {
      woken_.wait_until(lock, stop, next, [] { return false; });
      continue;
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - heard_).count();
    print(fmt::format("{}: {} for {}", last_line_.empty() ? label_ : last_line_, hand_, duration_text(seconds)));
  }
}

void ProgressPrinter::in_hand(const std::string& what) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  hand_ = what;
  heard_ = Clock::now();
}

void ProgressPrinter::begin(std::string label) {
  const std::lock_guard lock(mutex_);
  label_ = std::move(label);
  progress_ = Progress(label_);
  last_line_.clear();
  begin_ = due_ = heard_ = Clock::now();
}

void ProgressPrinter::update(double fraction, std::int64_t steps, const std::function<std::string()>& status,
                             const std::optional<StepRange>& all) {
  if (quiet_) return;
  const auto now = Clock::now();
  if (now < due_) return;
  const std::lock_guard lock(mutex_);
  const bool first = due_ == begin_;
  const double elapsed = std::chrono::duration<double>(now - begin_).count();
  due_ = now + std::chrono::milliseconds(std::lround(1000 * interval(live_, elapsed)));
  last_line_ = progress_.line(elapsed, fraction, steps, status(), all);
  hand_ = "in one step";
  heard_ = now;
  if (live_ || !first) print(last_line_);  // in a log nothing is known yet
}

void ProgressPrinter::say(const std::string& message) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  clear();
  std::fprintf(out_, "%s\n", message.c_str());
  std::fflush(out_);
  last_ = Clock::now();
}

}  // namespace crumble
