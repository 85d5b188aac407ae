#include "outrider/core/rng.hpp"

#include <cmath>
#include <numbers>

namespace outrider {
namespace {

/// Applies the finaliser of SplitMix64 (Steele, Lea and Flood, 2014): a bijection that mixes every bit.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

/// Returns the FNV-1a hash of a name.
std::uint64_t hash(std::string_view name) {
  std::uint64_t h = 0xcbf29ce484222325ULL;
  for (const char c : name) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return h;
}

}  // namespace

Rng::Rng(std::uint64_t seed) : seed_(seed), engine_(mix(seed)) {}

Rng Rng::child(std::string_view name) const { return Rng(mix(seed_ ^ mix(hash(name)))); }
Rng Rng::child(std::uint64_t index) const { return Rng(mix(seed_ + mix(index) * 2 + 1)); }

double Rng::uniform() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }

std::uint64_t Rng::below(std::uint64_t count) {
  const std::uint64_t limit = -count % count;  // 2^64 mod count: draws below it would be biased
  for (;;) {
    const std::uint64_t draw = bits();
    if (draw >= limit) return draw % count;
  }
}

double Rng::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

}  // namespace outrider
