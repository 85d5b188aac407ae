// The legs on which shortest paths leave a turn, kept from one search to the next.
//
// A path that turns winds around the blocked cell there: it arrives in one of the two quadrants of directions
// beside that cell, continues in the same one, between its own direction and the border of the cell, and ends
// its leg at a turn around whose cell it can wind in its turn. Turn and quadrant are a departure. The legs of
// a departure do not depend on start and goal, so they are found once the departure has been expanded a few
// times; later searches read them in place of the polygons in sight. They are stored by block, then by angle
// from the border, so a search skips blocks it does not enter, and stops at its own direction. Where a
// departure looks over many polygons, more expansions are waited for, or the legs are never found: a search
// needs few of those polygons.
//
// Memory: 8 bytes a turn, 4 a leg, and 8 for each block that a departure sees. Thread rule: one instance per
// thread.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/mesh_sight.hpp"

namespace outrider::polyanya_search {

/// A turn and the quadrant in which a path arrives and leaves.
class Departure {
 public:
  Departure() = default;
  /// `number`: from number().
  explicit Departure(std::uint32_t number) : number_(number) {}
  /// `side` begins at the turn; `level`: the path continues along the border of the blocked cell that is
  /// parallel to the x axis, else along the other one.
  Departure(const NavigationMesh::Side& side, bool level)
      : number_(std::uint32_t{side.turn} << 3U | std::uint32_t{side.blocked} << 1U | (level ? 1U : 0U)) {}

  /// Returns true if a path that arrives along `came` can wind around the blocked cell.
  static bool winds(const NavigationMesh::Side& side, Arrow came, bool& level) {
    const std::int32_t x = (side.blocked & 1U) != 0 ? came.x : -came.x;  // > 0 towards the blocked cell
    const std::int32_t y = (side.blocked & 2U) != 0 ? came.y : -came.y;
    level = x >= 0 && y < 0;
    return level || (x < 0 && y >= 0);
  }

  [[nodiscard]] std::uint32_t number() const { return number_; }
  [[nodiscard]] std::uint32_t turn() const { return number_ >> 3U; }
  /// Returns the border of the blocked cell along which the path continues at most.
  [[nodiscard]] Arrow border() const {
    const std::int32_t x = (number_ & 2U) != 0 ? 1 : -1, y = (number_ & 4U) != 0 ? 1 : -1;
    return (number_ & 1U) != 0 ? Arrow{x, 0} : Arrow{0, y};
  }
  /// Returns the direction of arrival that is farthest from the border.
  [[nodiscard]] Arrow farthest() const {
    const std::int32_t x = (number_ & 2U) != 0 ? 1 : -1, y = (number_ & 4U) != 0 ? 1 : -1;
    return (number_ & 1U) != 0 ? Arrow{0, -y} : Arrow{-x, 0};
  }
  /// Returns true if the path turns to the left.
  [[nodiscard]] bool to_left() const { return (0x96U >> (number_ & 7U) & 1U) != 0; }
  /// Returns the directions in which a path continues that arrives along `came`.
  [[nodiscard]] Cone cone(Arrow came) const {
    return to_left() ? Cone{came, border()} : Cone{border(), came};
  }

 private:
  std::uint32_t number_ = 0;
};

/// Finds the turns that a corner sees.
class TautSweep {
 public:
  struct SeenTurn {
    Departure departure;
    bool taut;            ///< a path can arrive there and wind
    std::uint32_t block;  ///< of a side at which it was seen
    Arrow way;
  };

  /// Finds the turns in a cone from a turn. Returns false if it would have to look through more than `most`
  /// sides. O(sides of the polygons seen).
  bool from_turn(const NavigationMesh& mesh, std::uint32_t turn, const Cone& cone,
                 std::size_t most = std::numeric_limits<std::size_t>::max());
  /// Finds the turns that a corner of a polygon sees through that polygon.
  void from_polygon(const NavigationMesh& mesh, Cell corner, std::uint32_t polygon);
  /// Returns the turns found, in no particular order, some of them several times.
  [[nodiscard]] std::vector<SeenTurn>& seen() { return seen_; }

  // Functions of a viewer (mesh_sight.hpp):
  static bool opens(const NavigationMesh::Side& side) { return side.polygon != NavigationMesh::none; }
  void see(const NavigationMesh::Side& turn, Arrow way, std::uint32_t block) {
    bool level = false;
    const bool taut = Departure::winds(turn, way, level);
    seen_.push_back({Departure(turn, level), taut, block, way});
  }
  void pass(const NavigationMesh::Side& side, Arrow /*from*/, Arrow /*to*/, Arrow right, Arrow left) {
    views_.push_back({{right, left}, side.polygon, side.behind});
  }

 private:
  struct View {
    Cone cone;
    std::uint32_t polygon, side;
  };
  bool look_on(const NavigationMesh& mesh, Cell at, std::size_t most);

  std::vector<SeenTurn> seen_;
  std::vector<View> views_;
};

class TautLegs {
 public:
  struct Leg {
    Departure departure;  ///< at the end of the leg
    Arrow way;
  };

  /// Forgets all legs.
  void forget() {
    lists_.clear();
    words_.clear();
  }
  [[nodiscard]] std::size_t bytes() const { return 4 * (lists_.capacity() + words_.capacity()); }

  /// Must be called before a departure is expanded. Returns true if its legs are known, now or before.
  bool known(const NavigationMesh& mesh, Departure departure) {
    if (lists_.empty()) lists_.resize(2 * mesh.turns.size(), 0);
    std::uint32_t& list = list_of(departure);
    if (list >= most_tries) return true;
    if (list + 1 < most_tries) ++list;
    return (list == 6 || list == 24 || list == 60) && add(mesh, departure, std::size_t{sides_a_try} * list);
  }
  /// Calls visit(leg, block) for the known legs on which a path that arrives along `came` can continue, in
  /// the blocks for which enters(block) is true.
  template <class Enters, class Visit>
  void each(const NavigationMesh& mesh, Departure departure, Arrow came, Enters enters, Visit visit) {
    const Cell at = mesh.turns[departure.turn()].at;
    const bool to_left = departure.to_left();
    const std::uint32_t* const list = words_.data() + (list_of(departure) - most_tries);
    const std::uint32_t *head = list + 1, *leg = head + 2 * std::size_t{list[0]};
    const std::uint32_t* const legs = leg;
    for (; head != legs; head += 2) {
      const std::uint32_t* const end = legs + head[1];
      if (enters(head[0])) {
        for (; leg != end; ++leg) {
          const Departure next(*leg);
          const Arrow way = arrow(at, mesh.turns[next.turn()].at);
          const std::int64_t left = turned(came, way);
          if (to_left ? left < 0 : left > 0) break;
          visit(Leg{next, way}, head[0]);
        }
      }
      leg = end;
    }
  }

 private:
  static constexpr std::uint32_t most_tries = 64;  ///< above the expansions at which legs are looked for
  static constexpr std::uint32_t sides_a_try =
      32;  ///< sides looked through in the time of an expansion, about

  [[nodiscard]] std::uint32_t& list_of(Departure departure) {
    return lists_[departure.number() >> 3U << 1U | (departure.number() & 1U)];
  }
  bool add(const NavigationMesh& mesh, Departure departure, std::size_t most_sides);
  void store(std::vector<TautSweep::SeenTurn>& seen, bool to_left);

  // For each departure, its number of expansions, or its place in words_ + most_tries.
  std::vector<std::uint32_t> lists_;
  // A list: number of blocks; of each the block and the number of legs up to its last; the departures at
  // the ends of the legs.
  std::vector<std::uint32_t> words_;
  TautSweep sweep_;
};

}  // namespace outrider::polyanya_search
