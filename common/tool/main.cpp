// agglomerate VERB FILE...: the file tool.
#include <iostream>
#include <variant>

#include "common/io/program.hpp"
#include "common/tool/options.hpp"
#include "common/tool/verbs.hpp"

namespace {

using namespace crumble::tool;

struct Run {
  const Typed& typed;
  std::ostream& out;

  int operator()(const Answer& a) const { return out << a.text, 0; }
  int operator()(const CheckOptions& o) const { return check(o, out); }
  int operator()(const InfoOptions& o) const { return info(o, out); }
  int operator()(const CompareOptions& o) const { return compare(o, out); }
  int operator()(const ImportFileOptions& o) const { return import_file(o, typed, out); }
  int operator()(const ExportOptions& o) const { return export_frames(o, out); }
  int operator()(const MorphologyOptions& o) const { return morphology(o, out); }
  int operator()(const ScaleOptions& o) const { return scale(o, typed, out); }
  int operator()(const SchemaOptions&) const { return schema(out); }
};

}  // namespace

int main(int argc, char** argv) {
  const Typed typed(argv, argv + argc);
  return crumble::run_program("agglomerate", [&] {
    const int code = std::visit(Run{typed, std::cout}, parse_options(argc, argv));
    std::cout.flush();
    if (!std::cout) throw std::runtime_error("the answer could not be written to stdout");
    return code;
  });
}
