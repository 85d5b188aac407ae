// Mappers that one thread uses at a time, and what has changed of a map since somebody looked.
#pragma once

#include <pybind11/pybind11.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

#include "occupancy.hpp"
#include "outrider/slam/landmark/landmark_slam.hpp"
#include "outrider/slam/laser/laser_slam.hpp"
#include "turn.hpp"

namespace outrider::python {

/// Changes of a map by version. Old ones are forgotten once they hold more cells than the map.
class MapChanges {
 public:
  [[nodiscard]] std::uint64_t version() const { return first_ + updates_.size(); }

  void note(MapUpdate update, std::size_t cells_of_map) {
    cells_ += update.cells.size();
    updates_.push_back(std::move(update));
    if (!updates_.back().redrawn && cells_ <= cells_of_map) return;
    first_ += updates_.size();
    updates_.clear();
    cells_ = 0;
  }
  /// Returns what has changed since a version; all may have, if that is forgotten.
  [[nodiscard]] MapUpdate since(std::uint64_t version) const {
    if (version < first_) return {true, {}};
    MapUpdate all;
    for (std::size_t i = version - first_; i < updates_.size(); ++i)
      all.cells.insert(all.cells.end(), updates_[i].cells.begin(), updates_[i].cells.end());
    std::ranges::sort(all.cells);
    const auto rest = std::ranges::unique(all.cells);
    all.cells.erase(rest.begin(), rest.end());
    return all;
  }

 private:
  std::uint64_t first_ = 1;  ///< version before the first of the updates
  std::vector<MapUpdate> updates_;
  std::size_t cells_ = 0;
};

/// A mapper that one thread uses at a time.
template <class Slam>
struct Mapper {
  explicit Mapper(Slam made) : slam(std::move(made)) {}

  template <class Work>
  auto with(Work work) {
    const auto mine = turn.take("map");
    const pybind11::gil_scoped_release others_may_run;
    return work(slam);
  }

  Slam slam;
  Turn turn;
};
using Landmarks = Mapper<LandmarkSlam>;

/// A mapper with a laser, whose map is copied only as far as it has changed.
struct Laser : Mapper<LaserSlam> {
  using Mapper<LaserSlam>::Mapper;

  /// Returns the map as it is now. As long as somebody holds the one before, that stays as it was.
  SharedOccupancy snapshot() {
    const Grid<std::uint8_t>& now = slam.map().occupancy();
    const MapUpdate changed = changes.since(std::exchange(copied_version, changes.version()));
    if (copy.use_count() != 1 || changed.redrawn || copy->frame != now.frame) {
      if (copy == nullptr || changed.redrawn || !changed.cells.empty())
        copy = std::make_shared<Grid<std::uint8_t>>(now);
      return copy;
    }
    for (const std::size_t cell : changed.cells) copy->cells[cell] = now.cells[cell];
    return copy;
  }

  MapChanges changes;
  SharedOccupancy copy;
  std::uint64_t copied_version = 0;
  const std::uint64_t id = next_id();

 private:
  static std::uint64_t next_id() {
    static std::atomic<std::uint64_t> last = 0;
    return ++last;
  }
};

}  // namespace outrider::python
