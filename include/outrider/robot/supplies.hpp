// Supplies: the water and the charge that a guard robot carries, and the stations that fill them up.
//
// Both are full at the start. The model of what is used and of how a station fills is that of
// tour/supply.hpp; plans leave `reserve` of the battery untouched for what goes otherwise than planned.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/geometry/vec.hpp"
#include "outrider/tour/supply.hpp"

namespace outrider {

struct Station {
  std::string name;
  Vec2 position;
  bool gives_water = false;
  bool gives_charge = false;

  [[nodiscard]] bool gives(Store store) const { return store == Store::water ? gives_water : gives_charge; }
};

struct Supplies {
  double tank = 0.0;        ///< that it holds, in litres, or in shots where a shot takes 1; 0: no end
  double shot_water = 1.0;  ///< of a shot, in the unit of the tank
  double battery_wh = 0.0;  ///< 0: no end
  double reserve = 0.1;     ///< part of the battery that plans leave
  double drive_jpm = 40.0;  ///< for each metre driven
  double power_w = 15.0;    ///< all the time
  double shot_j = 20.0;     ///< for each shot
  double refill_s = 10.0;   ///< of a refill, whatever the level
  double refill_per_unit_s = 0.0;
  double recharge_s = 10.0;  ///< of a recharge, whatever the level
  double recharge_per_wh_s = 0.0;
  std::string stations_text;      ///< name=x,y,water or charge or both, with blanks between
  std::vector<Station> stations;  ///< of the text, once loaded

  /// False where nothing ends: then the rest counts for nothing.
  [[nodiscard]] bool any() const { return tank > 0.0 || battery_wh > 0.0; }
  [[nodiscard]] bool ends(Store store) const { return store == Store::water ? tank > 0.0 : battery_wh > 0.0; }
  /// What is there when full, J for charge; infinite without an end.
  [[nodiscard]] double full(Store store) const;
  [[nodiscard]] double filling_s(Store store, double missing) const;
  /// J of that time and that way, without shots.
  [[nodiscard]] double charge_of(double seconds, double metres) const {
    return power_w * seconds + drive_jpm * metres;
  }
};

std::vector<Option> describe(Supplies& supplies);

/// A fill that a plan or a mission calls for.
struct StationCall {
  std::size_t station = 0;  ///< index in the supplies
  Store store = Store::water;
  friend bool operator==(const StationCall&, const StationCall&) = default;
};

std::string_view to_string(Store store);

}  // namespace outrider
