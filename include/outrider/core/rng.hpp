// Rng: a seed and named child streams. Nothing else in the tree draws random numbers.
//
// The generator is std::mt19937_64, whose output the standard fixes; the distributions are our own
// because those of the standard differ between libraries. A child stream depends on the seed and its
// name only, never on how much was drawn elsewhere: adding a sensor does not change another's noise.
#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace outrider {

class Rng {
 public:
  explicit Rng(std::uint64_t seed);

  [[nodiscard]] Rng child(std::string_view name) const;
  [[nodiscard]] Rng child(std::uint64_t index) const;

  std::uint64_t bits() { return engine_(); }
  /// Uniform in [0, 1), 53 bits.
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in {0, ..., count - 1}; count > 0. Unbiased.
  std::uint64_t below(std::uint64_t count);
  /// Mean 0, standard deviation 1 (Box-Muller, one branch).
  double normal();

 private:
  std::uint64_t seed_;
  std::mt19937_64 engine_;
};

}  // namespace outrider
