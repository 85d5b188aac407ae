// A known map made ready for one robot: edited, grown by the radius, prepared for searching. What was made is
// kept, so that dragging a start or a goal makes nothing anew.
#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "maps.hpp"
#include "outrider/jobs/plan/ground.hpp"

namespace outrider::server {

/// A change to a map, as the page drew it.
struct Edit {
  enum class Kind : std::uint8_t { block, free, set, remove, add };
  Kind kind = Kind::block;
  CellChange cells;             ///< block, free: cells that become occupied or free
  std::size_t obstacle = 0;     ///< set, remove: counted as the map was, those added after them
  std::vector<Vec2> corners{};  ///< set, add
};

/// What a question asks of the ground.
struct GroundRequest {
  std::shared_ptr<const KnownMap> map;
  std::vector<Edit> edits;
  std::string edits_text;         ///< the same as JSON: a name for them
  std::string earlier_text = {};  ///< all but the last of them; empty: there are none, or not told
  PlanGroundOptions options;      ///< without changes: edits come before the map is grown
};

/// Edits from their JSON form, for a map of cells or of polygons.
Outcome<std::vector<Edit>> edits_from_json(const Json& list, const KnownMap& map);

/// The map after the edits. Fault: bad_input on edits that leave the map.
Outcome<KnownMap> edited(const KnownMap& map, const std::vector<Edit>& edits);

/// The grounds that were used last. Faults: bad_input on edits that leave the map; those of plan_ground().
/// Thread rule: any thread may ask.
class GroundStore {
 public:
  Outcome<std::shared_ptr<const PlanGround>> get(const GroundRequest& request);

 private:
  struct CachedGround {
    std::string name;
    std::shared_ptr<const PlanGround> ground;
  };
  /// An obstacle that is added last, and dragged, leaves the ground without it as it was.
  Outcome<PlanGround> make(const GroundRequest& request);

  std::mutex mutex_;
  std::list<CachedGround> rows_;  // newest use first
};

}  // namespace outrider::server
