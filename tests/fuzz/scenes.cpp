#include "tests/fuzz/scenes.hpp"

#include <fmt/format.h>

#include "tests/fuzz/mutation.hpp"

namespace crumble::fuzz {

namespace {

const char* const name = "scene.toml";

std::string any_value(const Parameter& p, Random& random) {
  if (below(random, 8) == 0) return any_number(random);
  if (!p.choices.empty() && (p.kind == Parameter::Kind::choice || below(random, 4) == 0))
    return '"' + one_of(random, p.choices) + '"';
  switch (p.kind) {
    case Parameter::Kind::flag:
      return below(random, 2) ? "true" : "false";
    case Parameter::Kind::text:
      return below(random, 2) ? "\"nothing.csv\"" : "\"\"";
    case Parameter::Kind::list:
      return fmt::format("[{}, {}]", any_number(random), any_number(random));
    default:
      break;
  }
  // Around the default, where a scene means something.
  if (p.fallback && below(random, 3) == 0) return toml_text(*p.fallback);
  return any_number(random);
}

}  // namespace

std::string with_scene(std::string_view text, const ParameterTable& table,
                       const std::function<std::string(Scene&)>& use) {
  return outcome([&] {
    Scene scene = Scene::parse(std::string(text), name, table);
    const std::string resolved = scene.resolved();
    std::string again;
    try {
      again = Scene::parse(resolved, name, table).resolved();
    } catch (const InputError& error) {
      throw Finding(std::string("a resolved scene is not read back: ") + error.what());
    }
    if (again != resolved) throw Finding("a resolved scene reads back to another: " + again);
    return use(scene);
  });
}

std::string mutated_scene(const std::string& text, const ParameterTable& table, Random& random) {
  // Keys with their sections, in any order: TOML takes a dotted key at the top of a file.
  return mutated_lines(text, random, 0, [&]() -> std::string {
    const Section& section = one_of(random, table);
    if (section.repeated) return "[[" + section.name + "]]";
    if (below(random, 12) == 0) return "[" + section.name + "]";
    const Parameter& p = one_of(random, section.parameters);
    const bool dotted = below(random, 4) > 0;
    std::string key = p.name;
    if (!p.synonyms.empty() && below(random, 3) == 0) key = p.synonyms[below(random, p.synonyms.size())].name;
    return fmt::format("{}{} = {}", dotted ? section.name + "." : "", key, any_value(p, random));
  });
}

}  // namespace crumble::fuzz
