#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <string>
#include <thread>

#include "common/io/errors.hpp"
#include "common/io/interrupt.hpp"
#include "common/io/program.hpp"

using namespace crumble;

namespace {

struct Ended {
  int code;
  std::string said;
};

Ended run(const std::function<int()>& body) {
  ::testing::internal::CaptureStderr();
  const int code = run_program("dryer", body);
  return {code, ::testing::internal::GetCapturedStderr()};
}

std::string printed(bool quiet, const std::function<void(ProgressPrinter&)>& use) {
  std::FILE* file = std::tmpfile();
  {
    ProgressPrinter printer(file, "hollow", quiet);
    use(printer);
  }
  std::rewind(file);
  std::string out(1000, '\0');
  out.resize(std::fread(out.data(), 1, out.size(), file));
  std::fclose(file);
  return out;
}

}  // namespace

TEST(Program, ends_with_the_code_of_its_body) {
  EXPECT_EQ(run([] { return 0; }).code, 0);
  EXPECT_EQ(run([] { return 0; }).said, "");
  EXPECT_EQ(run([] { return 1; }).code, 1);
}

TEST(Program, turns_each_failure_into_one_message_and_its_code) {
  const Ended input = run([]() -> int { throw InputError("a.toml:3: wrong"); });
  EXPECT_EQ(input.code, 2);
  EXPECT_EQ(input.said, "a.toml:3: wrong\n");
  const Ended format = run([]() -> int { throw FormatError("a.h5: no /h5md"); });
  EXPECT_EQ(format.code, 3);
  EXPECT_EQ(format.said, "dryer: a.h5: no /h5md\n");
  const Ended failure = run([]() -> int { throw std::runtime_error("no convergence"); });
  EXPECT_EQ(failure.code, 1);
  EXPECT_EQ(failure.said, "dryer: no convergence\n");
  const Ended ours = run([]() -> int { throw std::logic_error("x"); });
  EXPECT_EQ(ours.code, 1);
  EXPECT_EQ(ours.said, "dryer: internal error: x\n");
  EXPECT_EQ(run([]() -> int { throw std::bad_alloc(); }).code, 1);
  EXPECT_EQ(run([]() -> int { throw Interrupted(SIGINT); }).code, 130);
  EXPECT_EQ(run([]() -> int { throw Interrupted(SIGTERM, "stopped; state in x"); }).said,
            "dryer: stopped; state in x\n");
  EXPECT_EQ(run([]() -> int { throw Interrupted(SIGTERM); }).code, 143);
}

TEST(Interrupt, signals_are_seen_by_a_run_that_polls) {
  for (const int signal_number : {SIGINT, SIGTERM}) {
    int before = -1, after = -1;
    run([&] {
      before = interrupt_signal();
      std::raise(signal_number);
      after = interrupt_signal();
      return 0;
    });
    EXPECT_EQ(before, 0);
    EXPECT_EQ(after, signal_number);
  }
}

TEST(Interrupt, a_second_signal_ends_the_program_at_once) {
  EXPECT_EXIT(
      {
        watch_for_interrupts();
        const AtSuddenEnd never_done([]() -> std::string {
          for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
        });
        std::raise(SIGINT);
        std::this_thread::sleep_for(std::chrono::milliseconds(1200));
        std::raise(SIGTERM);
      },
      ::testing::ExitedWithCode(143), "");
}

// A scheduler and the command that it runs may both send one.
TEST(Interrupt, signals_that_come_together_are_one_request) {
  int after = -1;
  run([&] {
    std::raise(SIGTERM);
    std::raise(SIGINT);
    after = interrupt_signal();
    return 0;
  });
  EXPECT_EQ(after, SIGTERM);
}

TEST(Progress, time_left_follows_the_recent_speed) {
  Progress progress("hollow");
  EXPECT_EQ(progress.line(0, 0, 0, ""), "hollow:   0 %");
  // Slow for a minute, then 1 % a second: 8 reports later only the new speed counts.
  EXPECT_EQ(progress.line(60, 0.06, 600, "R = 200 nm"), "hollow:   6 %, 10 steps/s, 15 min 40 s left, R = 200 nm");
  std::string line;
  for (int i = 1; i <= 9; ++i) line = progress.line(60 + i, 0.06 + 0.01 * i, 600 + 1000 * i, "");
  EXPECT_EQ(line, "hollow:  15 %, 1e+03 steps/s, 1 min 25 s left");
}

TEST(Progress, of_a_run_that_begins_anew_begins_anew) {
  Progress progress("hollow");
  progress.line(0, 0, 0, "");
  progress.line(60, 0.5, 600, "");
  EXPECT_EQ(progress.line(61, 0, 1, ""), "hollow:   0 %");
  EXPECT_EQ(progress.line(62, 0.01, 11, ""), "hollow:   1 %, 10 steps/s, 1 min 39 s left");
}

TEST(Progress, durations_are_words_of_two_units) {
  EXPECT_EQ(duration_text(0.04), "0.0 s");
  EXPECT_EQ(duration_text(9.94), "9.9 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(59.6), "1 min 0 s");
  EXPECT_EQ(duration_text(3725), "1 h 2 min");
  EXPECT_EQ(duration_text(90000), "1 d 1 h");
  EXPECT_EQ(duration_text(std::nan("")), "unknown time");
}

TEST(Progress, quiet_prints_nothing) {
  EXPECT_EQ(printed(true,
                    [](ProgressPrinter& p) {
                      p.say("no noise: D = 0");
                      p.update(0.5, 10, [] { return ""; });
                    }),
            "");
}

TEST(Progress, a_log_gets_whole_lines_and_no_control_codes) {
  EXPECT_EQ(printed(false,
                    [](ProgressPrinter& p) {
                      p.say("no noise: D = 0");
                      for (int i = 0; i < 1000; ++i) p.update(1e-3 * i, i, [] { return ""; });
                    }),
            "no noise: D = 0\n");  // no interval has passed in this loop
}
