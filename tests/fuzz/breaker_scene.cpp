// A scene of the breaker, with an agglomerate that would break at 1 kPa.
#include <fmt/format.h>

#include "breaker/scene.hpp"
#include "tests/fuzz/scenes.hpp"

namespace crumble::fuzz {

std::string breaker_scene(std::string_view text) {
  return with_scene(text, breaker::breaker_parameters(), [](Scene& scene) {
    breaker::BreakerScene broken = breaker::breaker_scene(scene);
    adapt(broken, 1e3);
    return fmt::format("{} stages up to {:g} Pa", broken.protocol.stages().size(), broken.largest_stress);
  });
}

std::string mutated_breaker_scene(const std::string& text, Random& random) {
  return mutated_scene(text, breaker::breaker_parameters(), random);
}

}  // namespace crumble::fuzz
