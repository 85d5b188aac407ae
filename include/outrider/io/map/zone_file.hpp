// Zones from text and from files (world/zone.hpp).
//
//   text           "keep_out 1,1 2,1 2,2; slow 0.3 4,0 6,0 6,2": the kind, of a slow zone its largest speed
//   in
//                  m/s, and the corners x,y of a simple polygon in m; several with ; between
//   GeoJSON        polygons in features with the property "kind": "keep_out", or "slow" and "speed" in m/s.
//   Their
//                  coordinates are metres in the frame of the map
//   filter masks   of Nav2: a YAML file of map_server and its image. With the mode `scale` or `raw` a pixel
//   has
//                  a value from 0 to 100, as map_server reads it. Keep-out: a value of 100 is kept out of;
//                  less is a preference, and said in a warning. Speed: the limit is base + multiplier *
//                  value, in percent of the largest speed of the robot (type 1) or in m/s (type 2). The value
//                  0 and limits of 0 stand for none, as in Nav2. Unknown pixels, and what lies off the mask,
//                  are free.
//
// Faults: bad_input with the key, or the file and the place in it: polygons that are not simple, kinds,
// speeds and limits that make no sense. Source: Nav2, costmap filters (keepout_filter.cpp, speed_filter.cpp,
// filter_values.hpp).
#pragma once

#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/geometry/box.hpp"
#include "outrider/world/zone.hpp"

namespace outrider {

/// The texts and files that zones come from; each may be empty.
struct ZoneSources {
  std::string areas;          ///< text
  std::string file;           ///< path of GeoJSON
  std::string keep_out_mask;  ///< path of a mask
  std::string speed_mask;     ///< path of a mask
  double speed_base = 100.0;  ///< limit where the speed mask is 0, in its units
  double speed_multiplier = -1.0;
  bool speed_percent = true;  ///< its limits are percent (type 1 of Nav2); false: m/s (type 2)
};
std::vector<Option> describe(ZoneSources& sources);

struct LoadedZones {
  std::vector<Zone> zones;
  std::vector<std::string> warnings = {};
};

/// Reads all of them, for a robot of that speed on that ground. Faults: besides, a mask of which nothing lies
/// on the ground.
Outcome<LoadedZones> load_zones(const ZoneSources& sources, double most_mps, const Box2& ground);

Outcome<std::vector<Zone>> zones_from_text(const std::string& text, const std::string& where);
Outcome<std::vector<Zone>> zones_from_geojson(std::string_view text, const std::string& name);

}  // namespace outrider
