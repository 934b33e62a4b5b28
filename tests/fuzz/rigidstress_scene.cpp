#include <fmt/format.h>

#include "rigidstress/scene.hpp"
#include "tests/fuzz/scenes.hpp"

namespace crumble::fuzz {

std::string rigidstress_scene(std::string_view text) {
  return with_scene(text, rigidstress::stress_parameters(), [](Scene& scene) {
    const rigidstress::StressScene loaded = rigidstress::stress_scene(scene);
    return fmt::format("{} starts, order {}, key of {} letters", loaded.orbit.starts.size(), loaded.hydrodynamics.order,
                       rigidstress::response_key(scene).size());
  });
}

std::string mutated_rigidstress_scene(const std::string& text, Random& random) {
  return mutated_scene(text, rigidstress::stress_parameters(), random);
}

}  // namespace crumble::fuzz
