#include "common/tool/options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <functional>
#include <map>
#include <memory>

#include "common/io/errors.hpp"
#include "common/io/parameters.hpp"
#include "common/io/plausible.hpp"
#include "common/io/provenance.hpp"

namespace crumble::tool {
namespace {

constexpr const char* purpose =
    "Looks into agglomerate files, checks them, brings others in and gives them to viewers.";

constexpr const char* overview =
    "Examples:\n"
    "  agglomerate info granule.h5\n"
    "      what is in the file, and where it comes from\n"
    "  agglomerate morphology granule.h5\n"
    "      diameter, crust, contacts and other numbers of its last frame\n"
    "  agglomerate compare old.h5 new.h5\n"
    "      what differs, and whether it is more than the errors\n"
    "  agglomerate import packing.csv --radius 10 -o packing.h5\n"
    "      an agglomerate from sphere centres in nm\n"
    "  agglomerate export granule.h5 -o granule.xyz\n"
    "      all frames for OVITO (granule.hdf: for ParaView)\n"
    "  agglomerate scale granule.h5 --radius 100 -o large.h5\n"
    "      the same contacts between spheres of 100 nm\n"
    "  agglomerate VERB --help\n"
    "      more about one verb\n"
    "\n"
    "Exit codes: 0 done; 1 failed (check: a file is not valid; compare: a result differs); 2 the command line is wrong "
    "or a file cannot be\n"
    "opened; 3 a file is not what its format says. Answers go to stdout, messages to stderr.";

InputError misuse(const std::string& verb, const std::string& wrong) {
  const std::string command = verb.empty() ? "agglomerate" : "agglomerate " + verb;
  return InputError(fmt::format("agglomerate: {}\n{} --help explains", wrong, command));
}

// CLI11 has its own conversions, whose messages nobody can read: values stay text until here.
double number(const std::string& verb, const std::string& option, const std::string& text, double low, bool open_low,
              double high = 1e300) {
  double value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = problem == std::errc() && end == text.data() + text.size();
  if (!is_number || !(open_low ? value > low : value >= low) || !(value <= high)) {
    throw misuse(verb, fmt::format("{} {}: must be a number {} {}{}", option, text, open_low ? ">" : ">=", low,
                                   high < 1e300 ? fmt::format(" and <= {}", high) : ""));
  }
  return value;
}

FrameChoice frame_choice(const std::string& verb, const std::string& text) {
  if (text == "all") return {FrameChoice::Kind::all};
  if (text == "last") return {FrameChoice::Kind::last};
  std::size_t k = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), k);
  if (problem != std::errc() || end != text.data() + text.size()) {
    throw misuse(verb, "--frame " + text + ": must be all, last or a number from 0");
  }
  return {FrameChoice::Kind::one, k};
}

double unit_named(const std::string& text) {
  static const std::map<std::string, double> units{{"nm", 1e-9}, {"um", 1e-6}, {"m", 1}};
  const auto found = units.find(text);
  if (found == units.end()) throw misuse("import", "--unit " + text + ": must be nm, um or m");
  return found->second;
}

// All values as text, as they were typed.
struct Raw {
  std::vector<std::string> files;
  std::string output, unit = "nm", radius, tolerance = "0.02", frame;
  std::string youngs_modulus, poisson_ratio, surface_energy, density;
  bool json = false, csv = false, cdf = false;
};

class Verb {
 public:
  Verb(CLI::App& app, const std::string& name, const std::string& meaning, const std::string& examples)
      : app_(app.add_subcommand(name, meaning)), name_(name) {
    app_->footer(examples);
    app_->group("Verbs");
  }
  Verb& files(Raw& raw, const std::string& type, const std::string& meaning) {
    app_->add_option("FILE", raw.files, meaning)->required()->type_name(type)->expected(1, 1 << 20);
    return *this;
  }
  Verb& text(std::string& value, const std::string& flag, const std::string& type, const std::string& meaning,
             bool required = false) {
    app_->add_option(flag, value, meaning)->type_name(type)->required(required);
    return *this;
  }
  Verb& flag(bool& value, const std::string& flag, const std::string& meaning) {
    app_->add_flag(flag, value, meaning);
    return *this;
  }
  // What the equilibrium gap follows from, and what later stages take.
  Verb& material(Raw& raw, const std::string& otherwise = "") {
    const Material table_1;
    const auto without = [&](double value) { return fmt::format("; without it {}{:g}", otherwise, value); };
    return text(raw.youngs_modulus, "--youngs-modulus", "PA", "E" + without(table_1.youngs_modulus))
        .text(raw.poisson_ratio, "--poisson-ratio", "NU", "nu" + without(table_1.poisson_ratio))
        .text(raw.surface_energy, "--surface-energy", "J/M2",
              "gamma_s of one surface" + without(table_1.surface_energy));
  }

 private:
  CLI::App* app_;
  std::string name_;
};

void declare(CLI::App& app, Raw& raw) {
  Verb(app, "check", "are the files valid? Every violation on a line of its own",
       "Example:\n  agglomerate check runs/*.h5\n"
       "Exit codes: 0 all valid, 1 a file is not valid, 2 a file cannot be opened.")
      .files(raw, "FILE.h5...", "agglomerate files");
  Verb(app, "info", "what is in a file, and where it comes from", "Example:\n  agglomerate info granule.h5 --json")
      .files(raw, "FILE.h5", "an agglomerate file")
      .flag(raw.json, "--json", "for programs");
  Verb(
      app, "compare", "what differs between two files: scene, provenance, results beyond their errors",
      "Example:\n  agglomerate compare seed-1.h5 seed-2.h5\n"
      "A result differs if it does by more than the errors that both files state together; one without a stated error\n"
      "differs if it is not the same number. Last frames are compared.\n"
      "Exit codes: 0 no result differs, 1 one does, 2 a file cannot be opened, 3 it is not what its format says.")
      .files(raw, "FILE.h5", "two agglomerate files");
  Verb(app, "import", "make an agglomerate from sphere centres",
       "Examples:\n"
       "  agglomerate import packing.csv --radius 10 -o packing.h5\n"
       "      packing.csv begins with the line x,y,z; lengths are in nm; semicolons and decimal commas are understood\n"
       "  agglomerate import cluster.xyz --unit um --radius 0.1 --contact-tolerance 0.05 -o cluster.h5\n"
       "Pairs with a gap below the tolerance become contacts, and these are closed: the spheres are moved until\n"
       "every contact is free of force. A pair that overlaps by more than the tolerance beyond that is an error.")
      .files(raw, "FILE.csv|.xyz", "table with a header x,y,z[,radius or diameter], XYZ or extended XYZ")
      .text(raw.output, "-o,--output", "OUT.h5", "where the agglomerate goes", true)
      .text(raw.unit, "--unit", "nm|um|m", "of the lengths in the file and of --radius, default nm")
      .text(raw.radius, "--radius", "R", "of all spheres, if the file has no radii")
      .text(raw.tolerance, "--contact-tolerance", "F", "as a fraction of the radius, default 0.02")
      .material(raw)
      .text(raw.density, "--density", "KG/M3", fmt::format("default {:g}", Material().density));
  Verb(app, "export", "write frames for a viewer, chosen by the ending of OUT",
       "Examples:\n"
       "  agglomerate export granule.h5 -o granule.xyz\n"
       "      OVITO: open granule.xyz, add the modifier Load trajectory, choose granule.bonds.dump there\n"
       "  agglomerate export granule.h5 -o granule.hdf\n"
       "      ParaView: open granule.hdf.series (granule.hdf if there is one frame); Glyph by radius for spheres\n"
       "  agglomerate export granule.h5 --frame last -o end.xyz")
      .files(raw, "FILE.h5", "an agglomerate file")
      .text(raw.output, "-o,--output", "OUT.xyz|OUT.hdf", "extended XYZ with bonds, or VTKHDF", true)
      .text(raw.frame, "--frame", "all|last|K", "which frames, default all; K counts from 0");
  Verb(app, "morphology", "diameter, crust thickness, axes, contacts, fragments, pores",
       "Examples:\n"
       "  agglomerate morphology granule.h5\n"
       "  agglomerate morphology granule.h5 --frame all --csv > drying.csv\n"
       "  agglomerate morphology granule.h5 --cdf > radial.csv")
      .files(raw, "FILE.h5", "an agglomerate file")
      .flag(raw.json, "--json", "for programs, with the distribution of radial positions")
      .flag(raw.csv, "--csv", "one row a frame")
      .flag(raw.cdf, "--cdf", "CSV of the cumulative distribution of radial positions, one row a particle")
      .text(raw.frame, "--frame", "all|last|K", "which frames, default last; K counts from 0");
  Verb(app, "scale", "the same contacts between spheres of another size",
       "Example:\n  agglomerate scale granule.h5 --radius 100 -o large.h5\n"
       "Takes the last frame. The contacts are kept and closed to the equilibrium gap of the new radius, without\n"
       "history; what self-stress remains is printed and stored.")
      .files(raw, "FILE.h5", "an agglomerate file")
      .text(raw.output, "-o,--output", "OUT.h5", "where the scaled agglomerate goes", true)
      .text(raw.radius, "--radius", "R_NM", "new radius (mean radius, if they differ), nm", true)
      .material(raw, "that of the file or ");
  Verb(app, "schema", "print the page that documents the file format", "Example:\n  agglomerate schema > SCHEMA.md");
}

// What was typed of it.
Properties material_of(const std::string& verb, const Raw& raw) {
  Properties m;
  if (!raw.youngs_modulus.empty())
    m["material.youngs_modulus"] = number(verb, "--youngs-modulus", raw.youngs_modulus, 0, true);
  if (!raw.poisson_ratio.empty())
    m["material.poisson_ratio"] = number(verb, "--poisson-ratio", raw.poisson_ratio, 0, false, 0.5);
  if (!raw.surface_energy.empty())
    m["material.surface_energy"] = number(verb, "--surface-energy", raw.surface_energy, 0, true);
  if (!raw.density.empty()) m["material.density"] = number(verb, "--density", raw.density, 0, true);
  return m;
}

Options interpret(const std::string& verb, const Raw& raw) {
  if (raw.json + raw.csv + raw.cdf > 1) throw misuse(verb, "--json, --csv and --cdf exclude each other");
  const Format format = raw.json ? Format::json : raw.csv ? Format::csv : raw.cdf ? Format::cdf : Format::table;
  if (verb == "check") return CheckOptions{raw.files};
  if (verb == "schema") return SchemaOptions{};
  if (verb == "compare") {
    if (raw.files.size() != 2) throw misuse(verb, fmt::format("two files are wanted, {} given", raw.files.size()));
    return CompareOptions{raw.files[0], raw.files[1]};
  }
  if (raw.files.size() > 1) {
    throw misuse(verb,
                 fmt::format("one file is wanted, {} are given, the second is '{}'", raw.files.size(), raw.files[1]));
  }
  const std::string& file = raw.files.front();
  if (verb == "info") return InfoOptions{file, format};
  if (verb == "morphology") {
    const FrameChoice frame = raw.frame.empty() ? FrameChoice{} : frame_choice(verb, raw.frame);
    if (format == Format::cdf && frame.kind == FrameChoice::Kind::all) {
      throw misuse(verb, "--cdf is of one frame: give --frame last or a number");
    }
    return MorphologyOptions{file, format, frame};
  }
  if (verb == "export") {
    return ExportOptions{file, raw.output, frame_choice(verb, raw.frame.empty() ? "all" : raw.frame)};
  }
  if (verb == "scale") {
    const double radius = 1e-9 * number(verb, "--radius", raw.radius, 0, true);
    if (const std::string wrong = radius_complaint(radius); !wrong.empty())
      throw misuse(verb, "--radius " + raw.radius + " nm: " + wrong);
    return ScaleOptions{file, raw.output, radius, material_of(verb, raw)};
  }
  ImportFileOptions import{file, raw.output, {}, material_of(verb, raw)};
  import.how.unit = unit_named(raw.unit);
  if (!raw.radius.empty()) import.how.radius = import.how.unit * number(verb, "--radius", raw.radius, 0, true);
  import.how.contact_tolerance = number(verb, "--contact-tolerance", raw.tolerance, 0, false, 0.5);
  return import;
}

std::string unknown_option(const CLI::App& app, const std::string& word) {
  std::vector<std::string> known;
  for (const auto* option : app.get_options())
    for (const auto& name : option->get_lnames()) known.push_back("--" + name);
  const auto guess = nearest(word.substr(0, word.find('=')), known);
  return "unknown argument '" + word + "'" + (guess ? "; did you mean '" + *guess + "'?" : "");
}

}  // namespace

Options parse_options(int argc, const char* const* argv) {
  CLI::App app(purpose, "agglomerate");
  app.footer(overview);
  bool version = false;
  app.add_flag("--version", version, "print version, git commit, compiler and libraries");
  app.require_subcommand(0, 1);
  app.get_formatter()->column_width(34);
  app.get_formatter()->label("SUBCOMMAND", "VERB FILE...");
  Raw raw;
  declare(app, raw);
  for (CLI::App* verb : app.get_subcommands({})) verb->allow_extras();  // so that the message is ours
  app.allow_extras();
  std::string verb;
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return Answer{app.help()};
  } catch (const CLI::ParseError& error) {
    if (!app.get_subcommands().empty()) verb = app.get_subcommands().front()->get_name();
    throw misuse(verb, error.what());
  }
  if (version) return Answer{version_text("agglomerate")};
  if (app.get_subcommands().empty()) {
    const std::vector<std::string> verbs{"check",  "info",       "compare", "import",
                                         "export", "morphology", "scale",   "schema"};
    const std::string word = app.remaining().empty() ? "" : app.remaining().front();
    const auto guess = nearest(word, verbs);
    throw misuse("", word.empty()
                         ? "a verb is missing: check, info, compare, import, export, morphology, scale or schema"
                         : "unknown verb '" + word + "'" + (guess ? "; did you mean '" + *guess + "'?" : ""));
  }
  const CLI::App& chosen = *app.get_subcommands().front();
  verb = chosen.get_name();
  if (!app.remaining(true).empty()) throw misuse(verb, unknown_option(chosen, app.remaining(true).front()));
  return interpret(verb, raw);
}

}  // namespace crumble::tool
