// Relaxation: the dynamic program of Held and Karp (1962) over sets of goals, with headings known only
// by sector and the gun's aim bounded from below. Its values never exceed the true times to go, so it
// guides the exact search, and from the start it is a lower bound.
#pragma once

#include <bit>
#include <limits>
#include <vector>

#include "instance.hpp"
#include "outrider/core/budget.hpp"

namespace outrider::tour {

/// In place of a sector: the drive takes no time and leaves the heading as it is.
inline constexpr std::uint8_t same_sector = 255;

struct RelaxedDrives {
  std::uint32_t sectors = 1;
  std::vector<float> time_to;  // [to * stops + from], without the first turn
  std::vector<float> turn;     // [(to * stops + from) * sectors + sector]: least first turn; empty for
                               // one sector
  std::vector<std::uint8_t> arriving;  // [to * stops + from]: sector of arrival_rad, or `same_sector`; empty
                                       // for one sector
};

/// The drives as they are, the turn circle cut into equal sectors (a power of two, at most 128).
RelaxedDrives sectored(const Instance& instance, std::uint32_t sectors);

struct Relaxation {
  std::uint32_t stops = 0;
  std::uint32_t sectors = 1;
  std::vector<std::uint32_t> goals;    // bit -> goal
  std::vector<std::uint32_t> covered;  // stop -> the bits it can serve
  std::vector<float> least_aim;        // node -> least time to aim after another service at its stop
  std::vector<float> arrived;  // [(set * stops + stop) * sectors + sector]: time to serve the set, having
                               // just come to the stop, where at least one of the set is served
  std::vector<float> served;   // the same, having just served at the stop; 0 for no goals

  [[nodiscard]] std::size_t index(std::uint32_t set, std::uint32_t stop, std::uint32_t sector) const {
    return (std::size_t{set} * stops + stop) * sectors + sector;
  }
};

std::uint32_t sector_of(double heading, std::uint32_t sectors);

/// The time of what cannot be: a drive that there is not, goals that are not served.
inline constexpr float never = std::numeric_limits<float>::infinity();

/// Sums of floats are rounded; scaled by this, a value of the relaxation is a bound for certain.
inline constexpr double rounded_down = 1.0 - 1e-5;

/// Solves it for every subset of `goals`. O(2^goals * stops^2 * sectors) time, 2^goals * stops * sectors
/// memory. The fault is the meter's; one expansion a subset.
Outcome<Relaxation> relax(const Instance& instance, std::vector<std::uint32_t> goals,
                          const RelaxedDrives& drives, BudgetMeter& meter);

}  // namespace outrider::tour
