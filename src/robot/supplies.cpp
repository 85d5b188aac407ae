#include "outrider/robot/supplies.hpp"

#include <limits>

namespace outrider {
namespace {

constexpr double joules_per_wh = 3600.0;

}  // namespace

double Supplies::full(Store store) const {
  if (!ends(store)) return std::numeric_limits<double>::infinity();
  return store == Store::water ? tank : battery_wh * joules_per_wh;
}

double Supplies::filling_s(Store store, double missing) const {
  return store == Store::water ? refill_s + refill_per_unit_s * missing
                               : recharge_s + recharge_per_wh_s * missing / joules_per_wh;
}

std::vector<Option> describe(Supplies& supplies) {
  return {
      {"tank", "", 0.0, 1e6, "water that the tank holds: litres, or shots where shot_water is 1; 0: no end",
       &supplies.tank},
      {"shot_water", "", 0.0, 1e6, "water of a shot, in the unit of the tank", &supplies.shot_water},
      {"battery", "Wh", 0.0, 1e6, "charge that the battery holds; 0: no end", &supplies.battery_wh},
      {"reserve", "", 0.0, 0.9, "part of the battery that plans leave for what goes otherwise",
       &supplies.reserve},
      {"drive", "J/m", 0.0, 1e6, "charge for each metre driven", &supplies.drive_jpm},
      {"power", "W", 0.0, 1e6, "charge for each second, but at a station", &supplies.power_w},
      {"shot", "J", 0.0, 1e6, "charge for each shot", &supplies.shot_j},
      {"refill", "s", 0.0, 1e5, "time of a refill, whatever the level", &supplies.refill_s},
      {"refill_per_unit", "s", 0.0, 1e5, "time for each unit of water filled in, besides",
       &supplies.refill_per_unit_s},
      {"recharge", "s", 0.0, 1e5, "time of a recharge, whatever the level", &supplies.recharge_s},
      {"recharge_per_wh", "s", 0.0, 1e5, "time for each Wh charged, besides", &supplies.recharge_per_wh_s},
      {"stations", "", 0, 0, "name=x,y,water or name=x,y,charge or name=x,y,both, m, with blanks between",
       &supplies.stations_text},
  };
}

std::string_view to_string(Store store) { return store == Store::water ? "water" : "charge"; }

}  // namespace outrider
