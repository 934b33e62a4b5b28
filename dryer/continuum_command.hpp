// `dryer continuum --peclet P --theta 0.2,0.4 -o OUT.csv`.
#pragma once

namespace crumble::dryer {

// The arguments behind the word `continuum`, which stands in argv[0]. Returns the exit code; throws InputError on what
// cannot be meant.
int continuum_command(int argc, const char* const* argv);

}  // namespace crumble::dryer
