#include "common/io/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>

namespace crumble {
namespace {

constexpr const char* exit_codes =
    "Exit codes:\n"
    "  0    done\n"
    "  1    the run failed (not finite, no convergence, a limit reached)\n"
    "  2    the scene or the command line is wrong\n"
    "  3    a data file is not what its format says\n"
    "  130  stopped by SIGINT (Ctrl-C), 143 by SIGTERM; the same command resumes where a checkpoint was left\n";

bool declares_seed(const ParameterTable& table) {
  for (const auto& section : table)
    for (const auto& p : section.parameters)
      if (section.name == "run" && p.name == "seed") return true;
  return false;
}

std::string help_footer(const ProgramDescription& program) {
  std::string out = "Examples:\n";
  for (const auto& example : program.examples) out += fmt::format("  {}\n      {}\n", example.what, example.meaning);
  out += fmt::format("  {} --print-defaults > scene.toml\n      every parameter with its meaning, unit and default\n\n",
                     program.name);
  return out + exit_codes + "\nResults go to files, answers to stdout, messages to stderr.";
}

// What CLI11 has read, still as text: its own conversions and ranges have messages that nobody can read.
struct Raw {
  std::vector<std::string> files, sets;
  std::string output, report, seed, threads, at, fit_to;
  bool check = false, quiet = false, restart = false, overwrite = false, version = false, defaults = false,
       reference = false;
};

void declare(CLI::App& app, Raw& raw, const ProgramDescription& program) {
  std::string files = "SCENE.toml: the scene";
  for (const auto& input : program.inputs) files += fmt::format("; {}: {}", input.what, input.meaning);
  app.add_option("FILES", raw.files, files)->type_name("");
  app.add_option("-o,--output", raw.output, "where the result goes; it appears only when it is complete")
      ->type_name("FILE.h5");
  app.add_option("--set", raw.sets, "override a value of the scene, as often as needed")
      ->type_name("section.key=value")
      ->allow_extra_args(false);
  if (declares_seed(program.parameters))
    app.add_option("--seed", raw.seed, "short for --set run.seed=N")->type_name("N");
  app.add_option("--threads", raw.threads, "number of threads")->type_name("N");
  app.add_option("--report", raw.report, "results, their errors and the cost of the run as JSON")
      ->type_name("FILE.json");
  if (program.loads_granules)
    app.add_option("--at", raw.at,
                   "does it hold there? A flow stress, a shear rate in the liquid, or the dissipation rate of "
                   "turbulence, each with its unit: \"100 Pa\", \"1e4 1/s\", \"10 W/kg\"")
        ->type_name("LOAD");
  if (program.fits_scenes)
    app.add_option("--fit-to", raw.fit_to,
                   "print the scene of a smaller droplet that stands for this one: with so many particles, or that "
                   "dries in this time on one core (\"1 h\"); runs nothing")
        ->type_name("N|TIME");
  app.add_flag("--check", raw.check, "read and build everything, run nothing");
  app.add_flag("--overwrite", raw.overwrite, "replace what stands at -o, although it is the result of another scene");
  if (program.keeps_checkpoint)
    app.add_flag("--restart", raw.restart,
                 "go on from the checkpoint of -o, which must be there; without this a run goes on if there is one and "
                 "begins if there is none");
  app.add_flag("--quiet", raw.quiet, "no progress on stderr");
  app.add_flag("--print-defaults", raw.defaults, "print a complete commented scene");
  app.add_flag("--print-reference", raw.reference, "print the manual's page of all parameters (Markdown)");
  app.add_flag("--version", raw.version, "print version, git commit, compiler and libraries");
}

std::string usage(const ProgramDescription& program) {
  std::string out = program.name + " SCENE.toml";
  for (const auto& input : program.inputs) out += " " + input.what;
  return out + " -o FILE.h5 [options]";
}

class UsageFormatter : public CLI::Formatter {
 public:
  explicit UsageFormatter(std::string usage) : usage_(std::move(usage)) { column_width(32); }
  std::string make_usage(const CLI::App*, std::string) const override { return "Usage: " + usage_ + "\n"; }

 private:
  std::string usage_;
};

InputError misuse(const ProgramDescription& program, const std::string& wrong) {
  return InputError(
      fmt::format("{}: {}\nusage: {}\n{} --help explains", program.name, wrong, usage(program), program.name));
}

std::string unknown_option(const CLI::App& app, const std::string& word) {
  std::vector<std::string> known;
  for (const auto* option : app.get_options())
    for (const auto& name : option->get_lnames()) known.push_back("--" + name);
  const auto guess = nearest(word.substr(0, word.find('=')), known);
  return "unknown option '" + word + "'" + (guess ? "; did you mean '" + *guess + "'?" : "");
}

std::int64_t whole_number(const ProgramDescription& program, const std::string& option, const std::string& text,
                          std::int64_t low, std::int64_t high) {
  std::int64_t value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size() || value < low || value > high)
    throw misuse(program, fmt::format("{} {}: must be a whole number {} to {}", option, text, low, high));
  return value;
}

void check_outputs(const ProgramDescription& program, CommandLine& command) {
  std::vector<ReadFile> read;
  for (const auto& input : command.inputs) read.push_back({"the input", input});
  read.push_back({"the input", command.scene});
  if (!command.output.empty())
    command.written.push_back({.what = "-o", .name = command.output, .has_checkpoint = program.keeps_checkpoint});
  if (!command.report.empty()) command.written.push_back({.what = "--report", .name = command.report, .is_text = true});
  try {
    require_separate(command.written, read);
  } catch (const InputError& error) {
    throw misuse(program, error.what());
  }
  if (!command.output.empty()) command.output = followed(command.output).string();
}

void take_files(const ProgramDescription& program, const Raw& raw, CommandLine& command) {
  std::string wanted = "SCENE.toml";
  for (const auto& input : program.inputs) wanted += " " + input.what;
  if (raw.files.size() != 1 + program.inputs.size())
    throw misuse(program, fmt::format("{} file name{} given, wanted: {}", raw.files.size(),
                                      raw.files.size() == 1 ? " is" : "s are", wanted));
  command.scene = raw.files.front();
  command.inputs.assign(raw.files.begin() + 1, raw.files.end());
  command.output = raw.output;
  command.report = raw.report;
  if (command.output.empty() && !raw.check && raw.fit_to.empty()) throw misuse(program, "-o FILE.h5 is missing");
  check_outputs(program, command);
}

CommandLine interpret(const ProgramDescription& program, const Raw& raw) {
  CommandLine command;
  if (raw.version) command.answer = program.version;
  if (raw.defaults) command.answer = default_scene(program.parameters);
  if (raw.reference) command.answer = reference_page(program);
  if (command.answer) return command;
  take_files(program, raw, command);
  for (const auto& argument : raw.sets) command.overrides.push_back(parse_override(argument));
  if (!raw.seed.empty()) {
    whole_number(program, "--seed", raw.seed, 0, std::numeric_limits<std::int64_t>::max());
    command.overrides.push_back({"run.seed", raw.seed, "--seed"});
  }
  if (!raw.threads.empty())
    command.threads = static_cast<int>(whole_number(program, "--threads", raw.threads, 1, 1024));
  command.at = raw.at;
  command.fit_to = raw.fit_to;
  command.check = raw.check;
  command.quiet = raw.quiet;
  command.restart = raw.restart;
  command.overwrite = raw.overwrite;
  return command;
}

}  // namespace

std::string reference_page(const ProgramDescription& program) {
  return fmt::format(
      "# Parameters of `{0}`\n\nWritten by `{0} --print-reference`. A value is in the unit given here and in no "
      "other.\n\n{1}",
      program.name, parameter_page(program.parameters));
}

CommandLine parse_command_line(const ProgramDescription& program, int argc, const char* const* argv) {
  CLI::App app(program.purpose, program.name);
  Raw raw;
  declare(app, raw, program);
  app.formatter(std::make_shared<UsageFormatter>(usage(program)));
  app.footer(help_footer(program));
  app.allow_extras();  // so that the message about an unknown option is ours
  CommandLine command;
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    command.answer = app.help();
    return command;
  } catch (const CLI::ParseError& error) {
    throw misuse(program, error.what());
  }
  if (!app.remaining().empty()) throw misuse(program, unknown_option(app, app.remaining().front()));
  return interpret(program, raw);
}

}  // namespace crumble
