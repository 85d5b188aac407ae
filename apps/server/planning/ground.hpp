// A known map prepared for one robot: edited, inflated by the radius, and indexed for searching. Results are
// kept, so dragging a start or a goal recomputes nothing.
#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "outrider/jobs/plan/ground.hpp"
#include "planning/maps.hpp"

namespace outrider::server {

/// Describes a change to a map, as drawn on the page.
struct Edit {
  enum class Kind : std::uint8_t { block, free, set, remove, add };
  Kind kind = Kind::block;
  CellChange cells;             ///< for block, free: the cells that change
  std::size_t obstacle = 0;     ///< for set, remove: index; added obstacles follow those of the map
  std::vector<Vec2> corners{};  ///< for set, add
};

/// Describes the ground that a question needs.
struct GroundRequest {
  std::shared_ptr<const KnownMap> map;
  std::vector<Edit> edits;
  std::string edits_text;         ///< the edits as JSON, used as their name
  std::string earlier_text = {};  ///< all but the last edit; empty if there are none or if unknown
  PlanGroundOptions options;      ///< without changes, because edits precede inflation
};

/// Reads edits from JSON, for a map of cells or of polygons.
Outcome<std::vector<Edit>> edits_from_json(const Json& list, const KnownMap& map);

/// Returns the map after the edits. Fault: bad_input on edits that leave the map.
Outcome<KnownMap> edited(const KnownMap& map, const std::vector<Edit>& edits);

/// Keeps the grounds that were used last. Faults: bad_input on edits that leave the map; those of
/// plan_ground(). Thread rule: any thread may call.
class GroundStore {
 public:
  Outcome<std::shared_ptr<const PlanGround>> get(const GroundRequest& request);

 private:
  struct CachedGround {
    std::string name;
    std::shared_ptr<const PlanGround> ground;
  };
  /// Makes a ground. If the last edit adds an obstacle, builds on the kept ground without it, so dragging it
  /// is cheap.
  Outcome<PlanGround> make(const GroundRequest& request);

  std::mutex mutex_;
  std::list<CachedGround> rows_;  // most recently used first
};

}  // namespace outrider::server
