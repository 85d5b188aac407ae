// Supplies: the water tank and the battery of a guard robot, and the stations that fill them.
//
// Both stores are full at the start. tour/supply/supply.hpp defines how they are used and filled. Plans never
// use the fraction `reserve` of the battery; it is left for deviations from the plan.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/geometry/vec.hpp"
#include "outrider/tour/supply/supply.hpp"

namespace outrider {

/// A place where the robot can fill its tank, its battery or both.
struct Station {
  std::string name;
  Vec2 position;
  bool gives_water = false;
  bool gives_charge = false;

  [[nodiscard]] bool gives(Store store) const { return store == Store::water ? gives_water : gives_charge; }
};

struct Supplies {
  double tank = 0.0;               ///< capacity in litres, or in shots if shot_water is 1; 0: unlimited
  double shot_water = 1.0;         ///< water per shot, in the unit of the tank
  double battery_wh = 0.0;         ///< capacity, Wh; 0: unlimited
  double reserve = 0.1;            ///< fraction of the battery that plans do not use
  double drive_jpm = 40.0;         ///< energy per metre driven, J/m
  double power_w = 15.0;           ///< constant power draw, W
  double shot_j = 20.0;            ///< energy per shot, J
  double refill_s = 10.0;          ///< fixed time of a refill with water
  double refill_per_unit_s = 0.0;  ///< additional time per unit of water
  double recharge_s = 10.0;        ///< fixed time of a recharge
  double recharge_per_wh_s = 0.0;  ///< additional time per Wh
  std::string stations_text;       ///< name=x,y,kind with kind water, charge or both; separated by blanks
  std::vector<Station> stations;   ///< parsed from the text when the scenario is loaded

  /// Returns true if a store is limited. Otherwise the other members have no effect.
  [[nodiscard]] bool any() const { return tank > 0.0 || battery_wh > 0.0; }
  /// Returns true if the store is limited.
  [[nodiscard]] bool ends(Store store) const { return store == Store::water ? tank > 0.0 : battery_wh > 0.0; }
  /// Returns the capacity of a store, J for charge; infinite if the store is unlimited.
  [[nodiscard]] double full(Store store) const;
  /// Returns the time to add `missing` to a store, s.
  [[nodiscard]] double filling_s(Store store, double missing) const;
  /// Returns the energy used in `seconds` with `metres` driven, without shots, J.
  [[nodiscard]] double charge_of(double seconds, double metres) const {
    return power_w * seconds + drive_jpm * metres;
  }
};

std::vector<Option> describe(Supplies& supplies);

/// A stop at a station to fill one store.
struct StationCall {
  std::size_t station = 0;  ///< index in Supplies::stations
  Store store = Store::water;
  friend bool operator==(const StationCall&, const StationCall&) = default;
};

std::string_view to_string(Store store);

}  // namespace outrider
