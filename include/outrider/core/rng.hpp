// Rng: a random number generator with named child streams. Outrider draws all its random numbers from it.
//
// The generator is std::mt19937_64, whose output is standardised. The distributions are implemented here,
// because those of the standard library differ between implementations. A child stream depends only on the
// seed and its name, not on the numbers drawn elsewhere: a new sensor does not change the noise of another
// one.
#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace outrider {

/// A stream of random numbers.
class Rng {
 public:
  explicit Rng(std::uint64_t seed);

  /// Return the child stream of that name or index.
  [[nodiscard]] Rng child(std::string_view name) const;
  [[nodiscard]] Rng child(std::uint64_t index) const;

  /// Draws 64 random bits.
  std::uint64_t bits() { return engine_(); }
  /// Draws uniformly from [0, 1), with 53 bits.
  double uniform();
  /// Draws uniformly from [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Draws uniformly from {0, ..., count - 1}, without bias; count > 0.
  std::uint64_t below(std::uint64_t count);
  /// Draws from the normal distribution with mean 0 and standard deviation 1 (Box-Muller, one branch).
  double normal();

 private:
  std::uint64_t seed_;
  std::mt19937_64 engine_;
};

}  // namespace outrider
