// `dryer conditions`: what a gas makes of a droplet and of the particles in it, before anything is dried.
#pragma once

namespace crumble::dryer {

int conditions_command(int argc, const char* const* argv);

}  // namespace crumble::dryer
