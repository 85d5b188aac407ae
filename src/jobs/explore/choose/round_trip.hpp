// The best round through some stops, by dynamic programming over sets of them.
// Source: Held and Karp, A dynamic programming approach to sequencing problems (1962).
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace outrider {

/// Costs of the legs from the start to each stop, between stops (from row to column), and from each home.
struct RoundTrip {
  std::size_t count = 0;  ///< of stops, at most 16
  std::vector<double> out;
  std::vector<double> between;
  std::vector<double> home;
};

/// The least cost of a round that visits every stop, for each stop that may come first. O(count^2 2^count).
inline std::vector<double> wholes(const RoundTrip& round) {
  const std::size_t n = round.count, sets = std::size_t{1} << n;
  std::vector<double> least(sets * n);  // from stop i on, with a set of stops before it that i is not in
  for (std::size_t set = 0; set < sets; ++set) {
    for (std::size_t i = 0; i < n; ++i) {
      double best = set == 0 ? round.home[i] : std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < n; ++j) {
        const std::size_t bit = std::size_t{1} << j;
        if ((set & bit) != 0) best = std::min(best, round.between[i * n + j] + least[(set ^ bit) * n + j]);
      }
      least[set * n + i] = best;
    }
  }
  std::vector<double> whole(n);
  for (std::size_t i = 0; i < n; ++i) {
    whole[i] = round.out[i] + least[(sets - 1 - (std::size_t{1} << i)) * n + i];
  }
  return whole;
}

}  // namespace outrider
