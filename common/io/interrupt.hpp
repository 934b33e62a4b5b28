// SIGINT (Ctrl-C) and SIGTERM ask a run to save its state and stop; a second one ends it at once.
#pragma once

namespace crumble {

void watch_for_interrupts();

// The signal that has come since `watch_for_interrupts`, or 0. Cheap enough for every step of a run.
int interrupt_signal() noexcept;

}  // namespace crumble
