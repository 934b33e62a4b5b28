// Names that lead to one file, files that get their names, and who may write them.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "common/io/file_errors.hpp"
#include "common/io/output_file.hpp"
#include "common/io/output_lock.hpp"
#include "tests/temporary_folder.hpp"

using namespace crumble;
namespace fs = std::filesystem;

namespace {

void put(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

template <class Work>
std::string refusal(Work work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string refusal_of(const std::vector<WrittenFile>& written, const std::vector<ReadFile>& read) {
  return refusal([&] { require_separate(written, read); });
}

// What a second run is told while `holder` holds the output; empty if it is let in.
std::string told_to_another_process(const fs::path& output) {
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    const std::string text = refusal([&] { const OutputLock lock(output); });
    _exit(write(ends[1], text.data(), text.size()) < 0);
  }
  close(ends[1]);
  std::string text(4096, '\0');
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, read(ends[0], text.data(), text.size()))));
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return text;
}

}  // namespace

TEST(OutputFile, two_names_of_one_file_are_refused_whatever_their_spelling) {
  const test::Folder folder;
  const std::string here = folder.path().string();
  put(here + "/scene.toml", "a");
  put(here + "/o.h5.tmp", "b");
  fs::create_symlink("scene.toml", here + "/link.h5");
  fs::create_hard_link(here + "/scene.toml", here + "/hard.h5");
  fs::create_directory_symlink(".", here + "/again");
  const auto out = [&](const std::string& name) {
    return WrittenFile{.what = "-o", .name = here + "/" + name, .has_checkpoint = true};
  };
  const auto report = [&](const std::string& name) {
    return WrittenFile{.what = "--report", .name = here + "/" + name, .is_text = true};
  };
  const ReadFile scene{"the input", here + "/scene.toml"};
  EXPECT_EQ(refusal_of({out("a.h5"), report("a.json")}, {scene}), "");
  for (const char* same : {"scene.toml", "./scene.toml", "again/scene.toml", "link.h5", "hard.h5"})
    EXPECT_NE(refusal_of({out(same)}, {scene}).find("would overwrite the input"), std::string::npos) << same;
  EXPECT_NE(refusal_of({out("o.h5")}, {{"the input", here + "/again/o.h5.tmp"}}).find("with its '.tmp'"),
            std::string::npos);
  for (const char* ending : {".lock", ".frames", ".checkpoint", ".checkpoint.tmp"})
    EXPECT_NE(refusal_of({out("new.h5")}, {{"the input", here + "/./new.h5" + ending}}), "") << ending;
  for (const char* same : {"a.h5", "./a.h5", "again/a.h5", "a.h5.tmp", "a.h5.checkpoint"})
    EXPECT_NE(refusal_of({out("a.h5"), report(same)}, {}).find("are the same file"), std::string::npos) << same;
}

TEST(OutputFile, what_cannot_be_written_is_known_before_the_start) {
  const test::Folder folder;
  const std::string here = folder.path().string();
  const auto of = [&](const std::string& name) { return refusal_of({{.what = "-o", .name = name}}, {}); };
  EXPECT_NE(of(here + "/nowhere/a.h5").find("there is no folder '" + here + "/nowhere'"), std::string::npos);
  EXPECT_NE(of(here).find("this is a folder"), std::string::npos);
  EXPECT_NE(of(here + "/" + std::string(255, 'a')).find("260 bytes, 255 are possible"), std::string::npos);
  EXPECT_EQ(of(here + "/" + std::string(250, 'a')), "");
  EXPECT_NE(refusal([] { const OutputLock lock("/proc/a.h5"); }).find("cannot be written: /proc/a.h5.lock: "),
            std::string::npos);
  fs::create_symlink("no/such/folder/a.h5", here + "/dangling.h5");
  EXPECT_NE(of(here + "/dangling.h5").find("there is no folder"), std::string::npos);
  fs::create_symlink("elsewhere", here + "/b.h5.tmp");
  EXPECT_NE(of(here + "/b.h5").find("is there already but not a file"), std::string::npos);
}

TEST(OutputFile, a_stream_is_written_to_and_never_replaced) {
  const test::Folder folder;
  const fs::path pipe = folder / "pipe", link = folder / "stdout.json";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  fs::create_symlink("/dev/null", link);
  EXPECT_TRUE(is_stream(pipe));
  EXPECT_TRUE(is_stream(link));
  EXPECT_TRUE(is_stream("/dev/stdout"));
  EXPECT_FALSE(is_stream(folder / "a"));
  EXPECT_NE(refusal_of({{.what = "-o", .name = "/dev/null"}}, {}).find("is a device"), std::string::npos);
  EXPECT_EQ(refusal_of({{.what = "--report", .name = link.string(), .is_text = true}}, {}), "");
  write_text_file(link, "gone");
  EXPECT_TRUE(fs::is_symlink(fs::symlink_status(link)));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THROW(write_text_file("/dev/full", "x"), WriteError);

  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  write_text_file(pipe, "through");
  std::string text(100, '\0');
  text.resize(static_cast<std::size_t>(read(reader, text.data(), text.size())));
  close(reader);
  EXPECT_EQ(text, "through");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

// As `--report /dev/stdout > FILE`: what stands there already stays, and what comes later follows.
TEST(OutputFile, a_descriptor_goes_on_where_it_is) {
  const test::Folder folder;
  const int file = open((folder / "a").c_str(), O_WRONLY | O_CREAT, 0600);
  ASSERT_EQ(write(file, "before ", 7), 7);
  write_text_file("/dev/fd/" + std::to_string(file), "text ");
  ASSERT_EQ(write(file, "after", 5), 5);
  close(file);
  EXPECT_EQ(text_of(folder / "a"), "before text after");
}

TEST(OutputFile, a_link_is_followed) {
  const test::Folder folder;
  fs::create_directory(folder / "sub");
  fs::create_symlink("sub/real.json", folder / "link.json");
  write_text_file(folder / "link.json", "text");
  EXPECT_TRUE(fs::is_symlink(folder / "link.json"));
  EXPECT_EQ(text_of(folder / "sub/real.json"), "text");
}

TEST(OutputFile, an_unfinished_text_never_has_its_name) {
  const test::Folder folder;
  put(folder / "a.csv", "old");
  {
    TextFile file(folder / "a.csv");
    file.stream() << "new";
  }
  EXPECT_EQ(text_of(folder / "a.csv"), "old");
  EXPECT_FALSE(fs::exists(folder / "a.csv.tmp"));
}

TEST(OutputLock, a_second_run_is_told_who_holds_the_output) {
  const test::Folder folder;
  const fs::path output = folder / "a.h5";
  fs::create_symlink("a.h5", folder / "link.h5");
  {
    const OutputLock lock(output);
    const std::string told = told_to_another_process(output);
    EXPECT_NE(told.find("is being written by process " + std::to_string(getpid()) + " on "), std::string::npos) << told;
    EXPECT_NE(told_to_another_process(folder / "link.h5"), "");
    EXPECT_EQ(told_to_another_process(folder / "b.h5"), "");
  }
  EXPECT_FALSE(fs::exists(folder / "a.h5.lock"));
  EXPECT_EQ(told_to_another_process(output), "");
}

TEST(OutputLock, what_a_killed_run_left_is_taken_over) {
  const test::Folder folder;
  const fs::path output = folder / "a.h5";
  const pid_t child = fork();
  if (child == 0) {
    const OutputLock lock(output);
    raise(SIGKILL);
  }
  waitpid(child, nullptr, 0);
  ASSERT_TRUE(fs::exists(folder / "a.h5.lock"));
  EXPECT_EQ(told_to_another_process(output), "");
  // On a disk of this machine a lock that is to be had has no owner, whatever the text says.
  put(folder / "a.h5.lock", "process 1 on another-host since 2026-01-01T00:00:00Z (start 1)\n");
  EXPECT_EQ(told_to_another_process(output), "");
  EXPECT_FALSE(fs::exists(folder / "a.h5.lock"));
}

TEST(OutputLock, an_owner_is_known_by_host_process_and_its_start) {
  const LockOwner own = LockOwner::of_this_process();
  const auto read = LockOwner::from_text(own.text());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->text(), own.text());
  EXPECT_EQ(read->is_alive(), std::optional(true));
  LockOwner other = own;
  other.host = "another-host";
  EXPECT_EQ(other.is_alive(), std::nullopt);
  other = own;
  other.start = "1";  // the same number, given out again
  EXPECT_EQ(other.is_alive(), std::optional(false));
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  other = own;
  other.process = child;
  EXPECT_EQ(other.is_alive(), std::optional(false));
  EXPECT_FALSE(LockOwner::from_text(""));
  EXPECT_FALSE(LockOwner::from_text("process x on host since now (start 3)\n"));
}
