#include "common/agglomerate/saved_frame.hpp"

namespace crumble {

void saved_frame(SavedFields f, Frame& frame) {
  f("step", frame.step);
  f("time", frame.time);
  f("position", frame.position);
  f("velocity", frame.velocity);
  f("angular_velocity", frame.angular_velocity);
  f("force", frame.force);
  f("torque", frame.torque);
  f("orientation", frame.orientation);
  f.size("contacts", frame.contacts);
  SavedFields c = f.in("contacts");
  const auto column = [&](const char* name, auto member) { c.column(name, frame.contacts, member); };
  column("i", &Contact::i);
  column("j", &Contact::j);
  column("normal", &Contact::normal);
  column("gap", &Contact::gap);
  column("sliding", &Contact::sliding);
  column("rolling", &Contact::rolling);
  column("twisting", &Contact::twisting);
  column("normal_force", &Contact::normal_force);
  column("sliding_force", &Contact::sliding_force);
  column("rolling_torque", &Contact::rolling_torque);
  column("twisting_torque", &Contact::twisting_torque);
  column("born", &Contact::born);
  column("at_limit", &Contact::at_limit);
}

}  // namespace crumble
