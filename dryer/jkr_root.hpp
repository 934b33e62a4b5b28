// The branch of JKR's law in vector registers.
#pragma once

#include "dryer/six_vector.hpp"

namespace crumble::dryer {

// Root c of x = h/L = (4 c - 6 c^4)/3 (common/contact/jkr.hpp): a polynomial in w = sqrt(x_f - x), x_f where the branch
// folds back, fitted from pull-off to x = -5.7 (nine times the equilibrium gap) such that the force is right to 4e-6 in
// single precision. Beyond, where 2 c^4 is -x and a little more, four steps of Newton.
HWY_INLINE Lane jkr_root(const Lane& x) {
  constexpr float fold = 0.5503212081491045f, fitted = 2.5f;
  const Lane below = fold - x, w = sqrt(max(below, 0));
  const Lane c =
      0.5508394749f +
      w * (0.5205727341f +
           w * (-0.1533251390f +
                w * (0.0666375065f +
                     w * (-0.0251484611f + w * (0.0067959171f + w * (-0.0011153681f + w * 0.0000820840826f))))));
  if (w.largest() <= fitted) return c;
  Lane deep = sqrt(sqrt(0.75f * max(below, fitted)));
  for (int step = 0; step < 4; ++step) {
    const Lane cubed = deep * deep * deep;
    deep = deep - (4 * deep - 6 * deep * cubed - 3 * x) / (4 - 24 * cubed);
  }
  return where_greater(w, fitted, deep, c);
}

}  // namespace crumble::dryer
