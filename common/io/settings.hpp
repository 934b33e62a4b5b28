// Resolved scenes as files hold them, compared key by key, whatever program wrote them.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace crumble {

// "droplet.radius" -> "2.15e-07", every value of the text; those of repeated sections with their number. Empty where it
// is no scene.
using Settings = std::map<std::string, std::string>;
Settings settings_in(const std::string& resolved);

struct SettingDifference {
  std::string key, first, second;  // "not set" where only the other has it
};
std::vector<SettingDifference> differences(const Settings& first, const Settings& second);

}  // namespace crumble
