#include "dryer/continuum_command.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "common/io/errors.hpp"
#include "common/io/number_list.hpp"
#include "common/io/output_lock.hpp"
#include "common/io/program.hpp"
#include "common/io/provenance.hpp"
#include "common/io/report.hpp"
#include "dryer/continuum.hpp"

namespace crumble::dryer {

namespace {

struct Raw {
  std::string peclet, theta, output, report;
};

InputError misuse(const std::string& wrong) {
  return InputError(
      fmt::format("dryer continuum: {}\nusage: dryer continuum --peclet P --theta T1,T2,... -o FILE.csv\n"
                  "dryer continuum --help explains",
                  wrong));
}

std::vector<double> numbers(const std::string& option, const std::string& list) {
  try {
    return number_list(list);
  } catch (const std::invalid_argument& error) {
    throw misuse(fmt::format("{}: {}", option, error.what()));
  }
}

double number(const std::string& option, const std::string& text) {
  const std::vector<double> one = numbers(option, text);
  if (one.size() != 1) throw misuse(fmt::format("{}: '{}' is not a number", option, text));
  return one.front();
}

OwnedOutputs own_outputs(const Raw& raw) {
  std::vector<WrittenFile> written{{.what = "-o", .name = raw.output, .is_text = true}};
  if (!raw.report.empty()) written.push_back({.what = "--report", .name = raw.report, .is_text = true});
  try {
    return {written, {}};
  } catch (const InputError& error) {
    throw misuse(error.what());
  }
}

std::string csv(const std::vector<ContinuumProfile>& profiles) {
  std::string text = "theta,rho,gamma\n";
  for (const auto& p : profiles)
    for (std::size_t row = 0; row < p.rho.size(); ++row)
      text += fmt::format("{:g},{:.12g},{:.12g}\n", p.theta, p.rho[row], p.gamma[row]);
  return text;
}

std::string table(const std::vector<ContinuumProfile>& profiles) {
  std::string text = "theta     Gamma(0)    Gamma(1)    error\n";
  for (const auto& p : profiles)
    text += fmt::format("{:<8g}  {:<10.6g}  {:<10.6g}  {:.0e}\n", p.theta, p.gamma.front(), p.gamma.back(), p.error);
  return text + "error: of Gamma, a third of the difference to half the cells and half the steps\n";
}

void write_report(const std::string& file, Report& report, double peclet,
                  const std::vector<ContinuumProfile>& profiles) {
  std::vector<double> theta, center, wall;
  double error = 0, defect = 0;
  for (const auto& p : profiles) {
    theta.push_back(p.theta), center.push_back(p.gamma.front()), wall.push_back(p.gamma.back());
    error = std::max(error, p.error), defect = std::max(defect, std::abs(p.mass_defect));
  }
  report.result("peclet", peclet);
  report.result("theta", theta);
  report.result("gamma_center", center);
  report.result("gamma_wall", wall);
  report.error("gamma", error, "a third of the difference to half the cells and half the steps, largest of all rows");
  report.error("mass_relative", defect, "change of the number of particles, largest of all theta");
  report.left_out.push_back("the size of the particles: the continuum model counts centres up to the surface");
  report.write(file);
}

}  // namespace

int continuum_command(int argc, const char* const* argv) {
  CLI::App app(
      "The continuum model of drying (Vasquez Giuliano et al. 2022, Eqs. 24-30): concentration Gamma = C/C0 of point "
      "particles against rho = r/R(t) at theta = t/lifetime, as CSV with the columns theta, rho, gamma.",
      "dryer continuum");
  Raw raw;
  app.add_option("--peclet", raw.peclet, "Peclet number R0^2/(D lifetime)")->type_name("P");
  app.add_option("--theta", raw.theta, "times, increasing, at least 0 and below 1")->type_name("T1,T2,...");
  app.add_option("-o,--output", raw.output, "where the profiles go")->type_name("FILE.csv");
  app.add_option("--report", raw.report, "results, their errors and the cost of the run as JSON")
      ->type_name("FILE.json");
  app.footer("Example:\n  dryer continuum --peclet 1 --theta 0.2,0.4 -o continuum.csv");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    deliver(app.help());
    return 0;
  } catch (const CLI::ParseError& error) {
    throw misuse(error.what());
  }
  if (raw.peclet.empty() || raw.theta.empty() || raw.output.empty())
    throw misuse("--peclet, --theta and -o are all needed");
  const double peclet = number("--peclet", raw.peclet);
  const std::vector<double> theta = numbers("--theta", raw.theta);
  const OwnedOutputs owned = own_outputs(raw);
  Report report("dryer continuum", make_provenance("dryer", {argv, argv + argc}, 0, "none").version, "", {});
  try {
    const auto profiles = continuum_profiles(peclet, theta);
    write_text_file(raw.output, csv(profiles));
    deliver(table(profiles), [&] { write_report(raw.report, report, peclet, profiles); });
  } catch (const std::domain_error& error) {
    throw misuse(error.what());
  }
  return 0;
}

}  // namespace crumble::dryer
