// The search of Polyanya, and the memory that it keeps between queries.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <set>
#include <vector>

#include "forced_turns.hpp"
#include "landmark.hpp"
#include "outrider/core/budget.hpp"
#include "outrider/core/trace.hpp"
#include "outrider/path/grid/grid_map.hpp"
#include "outrider/path/problem.hpp"
#include "outrider/search/labels.hpp"
#include "polyanya_frontier.hpp"
#include "taut_legs.hpp"

namespace outrider::polyanya_search {

/// The state of a block in a query.
struct BlockMark {
  std::uint32_t query = 0;                       ///< the last query that crosses the block
  std::uint32_t exit = LandmarkBounds::no_exit;  ///< as in LandmarkBounds, in that query
};

/// The mesh of a ground, and what follows from it.
struct Memory {
  std::shared_ptr<const GridMap> ground;  ///< ground of the mesh
  NavigationMesh mesh;
  ForcedTurns forced;
  TautLegs legs;
  bool keeps_legs = false;  ///< true if the query reads and finds them
  Landmark landmark;
  LandmarkBounds bounds;                                 ///< of the query
  Labels<double> roots;                                  ///< by turn; the start last
  std::vector<BlockMark> marks;                          ///< by block
  std::vector<std::uint32_t> around_start, around_goal;  ///< polygons
  std::vector<Cell> before_start, after_goal;  ///< vertices of the path beyond the ends of the search
  std::vector<std::uint32_t> up, down;         ///< blocks from the start and from the goal
  std::uint32_t query = 0;
  Frontier frontier;

  /// Makes the mesh follow the ground of a new query; returns false, and keeps nothing, at a stop.
  bool renew(const std::shared_ptr<const GridMap>& now, const std::stop_token& stop);
  /// Must be called at each expansion. Recomputes the blocks of a changed mesh once the expansions have taken
  /// as long as that; returns true if it did.
  bool found_blocks();

 private:
  void forget();
  void forget_what_follows();
  void find_what_is_worth();
  void begin_query();

  std::size_t most_sides_ = 0;           // number of sides above which a changed mesh is rebuilt
  std::size_t spent_ = 0;                // expansions since the mesh is as it is
  std::size_t spent_between_gates_ = 0;  // of these, in queries that cross several blocks
};

class Search {
 public:
  Search(Memory& memory, const GridQuery& query, Trace* trace);

  /// Returns the turns of the shortest path, including both ends.
  Outcome<std::vector<Cell>> run(BudgetMeter& meter);

  std::uint64_t generated = 0;

  // Functions of the viewer (mesh_sight.hpp) of the node that is expanded:
  [[nodiscard]] bool opens(const NavigationMesh::Side& side) const {
    return side.polygon != NavigationMesh::none && enters(side.block);
  }
  void see(const NavigationMesh::Side& turn, Arrow way, std::uint32_t block);
  void pass(const NavigationMesh::Side& side, Arrow from, Arrow to, Arrow right, Arrow left);

 private:
  [[nodiscard]] Cell at(std::uint32_t root) const { return root == first_ ? start_ : mesh_.turns[root].at; }
  [[nodiscard]] bool enters(std::uint32_t block) const { return memory_.marks[block].query == memory_.query; }
  std::vector<Cell> way_to(std::uint32_t root) const;

  bool join_ends(bool begins);
  std::uint32_t advance(Cell& end, std::vector<std::uint32_t>& around, std::uint32_t other,
                        std::vector<Cell>& way) const;
  std::array<std::uint32_t, 2> polygons_around(Cell v, std::vector<std::uint32_t>& found) const;
  bool join(std::uint32_t a, std::uint32_t b);
  bool climb(std::uint32_t& polygon, std::vector<std::uint32_t>& blocks);

  void record();
  void open(Cell root);
  bool reaches_goal();
  [[nodiscard]] bool sees_goal() const;
  [[nodiscard]] bool holds_goal(std::uint32_t polygon) const;
  void expand();
  void reach(Departure departure, Arrow way, std::uint32_t block);
  [[nodiscard]] double through(Arrow from, Arrow to, Arrow right, Arrow left) const;
  void add(const MeshNode& node, double f);

  const NavigationMesh& mesh_;
  Memory& memory_;
  Labels<double>& roots_;
  const GridMap& ground_;
  Cell start_, goal_;
  bool reversed_ = false;  // the search goes from the goal of the query to its start
  std::uint32_t first_;    // the start as a root
  MeshNode node_;          // the node that is expanded
  double least_ = 0.0;     // its f
  Trace* trace_;
  std::set<std::uint32_t> opened_;
};

}  // namespace outrider::polyanya_search
