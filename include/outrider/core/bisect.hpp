// Bisection for the point at which a condition ceases to hold.
#pragma once

namespace outrider {

/// Returns the point in [low, high] at which a condition that holds at `low` ceases to hold; at most
/// 2^-steps * (high - low) before it. Where it ceases several times, one of these points.
template <class Condition>
double last_while(double low, double high, int steps, const Condition& holds) {
  for (int i = 0; i < steps; ++i) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

/// Returns the largest value in [0, most] up to which a condition holds; it holds for 0.
template <class Condition>
double largest_up_to(double most, int steps, const Condition& holds) {
  return holds(most) ? most : last_while(0.0, most, steps, holds);
}

}  // namespace outrider
