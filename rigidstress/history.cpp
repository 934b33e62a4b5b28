#include "rigidstress/history.hpp"

namespace crumble::rigidstress {

HistoryResult follow_history(const LoadedBody& body, const GradientHistory& history,
                             const std::vector<Quaternion>& starts, double tolerance, Keeping keeping) {
  HistoryResult result;
  for (const Quaternion& start : starts) {
    result.orbits.push_back(keeping.value(
        result.orbits.size(),
        [&] {
          return follow(
              body, start, history.times(), [&](double t) { return history(t); }, tolerance);
        },
        [](SavedFields& f, Orbit& orbit) { orbit.fields(f); }));
    const Orbit& orbit = result.orbits.back();
    result.mean_peak_tension += orbit.peak.tension / static_cast<double>(starts.size());
    if (orbit.peak.use > result.orbits[result.worst_orbit].peak.use) result.worst_orbit = result.orbits.size() - 1;
  }
  return result;
}

}  // namespace crumble::rigidstress
