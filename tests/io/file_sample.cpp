// Writes a sample file with what its readers should find in it, as JSON on stdout: for the Python test.
#include <cstdio>

#include "common/agglomerate/morphology.hpp"
#include "tests/io/sample_agglomerate.hpp"

int main(int, char** arguments) {
  using namespace crumble;
  test::write_sample(arguments[1]);
  const Particles particles = test::sample_particles(test::sample_size);
  std::printf("[");
  for (int t = 0; t < test::sample_frames; ++t) {
    const Frame frame = test::sample_frame(test::sample_size, 10 + 7 * t);
    std::printf("%s{\"step\": %ld, \"time_s\": %.17g, \"radius_of_gyration_nm\": %.17g, \"position_nm\": [",
                t ? ", " : "", static_cast<long>(frame.step), frame.time,
                1e9 * radius_of_gyration(frame.position, particles.mass));
    for (std::size_t k = 0; k < frame.position.size(); ++k) {
      const Vector3 x = 1e9 * frame.position[k];
      std::printf("%s[%.17g, %.17g, %.17g]", k ? ", " : "", x.x(), x.y(), x.z());
    }
    std::printf("]}");
  }
  std::printf("]\n");
}
