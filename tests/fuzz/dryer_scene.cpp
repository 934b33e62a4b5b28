// A scene of the dryer up to what stands before the first step.
#include <fmt/format.h>

#include "dryer/process_inputs.hpp"
#include "dryer/regime.hpp"
#include "dryer/scene.hpp"
#include "tests/fuzz/scenes.hpp"

namespace crumble::fuzz {

std::string dryer_scene(std::string_view text) {
  using namespace dryer;
  return with_scene(text, drying_parameters(), [](Scene& scene) {
    inherit_from_gas(scene);
    Machine small;
    small.memory = memory_of(2000);  // particles, so that none takes a second
    const DryingScene dried = drying_scene(scene, small);
    std::string facts;
    for (const std::string& fact : describe(dried)) facts += " " + fact;
    return fmt::format("{} particles;{}", dried.radius.size(), facts);
  });
}

std::string mutated_dryer_scene(const std::string& text, Random& random) {
  return mutated_scene(text, dryer::drying_parameters(), random);
}

}  // namespace crumble::fuzz
