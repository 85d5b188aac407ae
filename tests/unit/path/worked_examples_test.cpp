// Examples of free-direction A* small enough to follow by hand, on corners named as on the page
// docs/planners/free-direction-examples.md: rows A, B, C ... from the top, columns 1, 2, 3 ...
// The pictures and tables of that page are compared with what the search does.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>

#include "grid/terrain/cost_over_parent.hpp"
#include "outrider/path/grid/a_star.hpp"
#include "outrider/path/grid/theta_star.hpp"
#include "outrider/path/mesh/polyanya/polyanya.hpp"
#include "outrider/search/best_first.hpp"
#include "outrider/search/compact_labels.hpp"
#include "support/costly_cases.hpp"
#include "support/grid_oracle.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

using oracle::Blocked;
using Names = std::vector<std::string>;

std::string name_of(Cell v, int height) {
  return fmt::format("{}{}", static_cast<char>('A' + height - v.y), v.x + 1);
}
Cell vertex(const std::string& name, int height) { return {name[1] - '1', height - (name[0] - 'A')}; }

struct Example {
  Blocked grid;
  Cell start;
  Cell goal;
  std::shared_ptr<const GridMap> ground = nullptr;

  Example(Blocked blocked, Cell from, Cell to)
      : grid(std::move(blocked)),
        start(from),
        goal(to),
        ground(std::make_shared<const GridMap>(*GridMap::of(grid, GridModel::corners))) {}
  Example(const std::vector<std::string>& rows, const std::string& from, const std::string& to)
      : Example(drawn(rows), vertex(from, static_cast<int>(rows.size())),
                vertex(to, static_cast<int>(rows.size()))) {}

  [[nodiscard]] Problem problem() const { return {ground, ground->point(start), ground->point(goal)}; }
  [[nodiscard]] std::string name(Cell v) const { return name_of(v, grid.frame.height); }
  [[nodiscard]] std::string name(State s) const { return name(ground->at(s)); }
  [[nodiscard]] Names names(const std::vector<Cell>& vertices) const {
    Names all;
    for (const Cell v : vertices) all.push_back(name(v));
    return all;
  }
};

struct Searched {
  Plan plan;
  Trace trace;
  Workspace workspace;
};
Searched free_direction(const Example& example) {
  Searched run;
  run.workspace.trace = &run.trace;
  run.plan = theta_star(example.problem(), {}, {}, run.workspace).value();
  run.workspace.trace = nullptr;
  return run;
}
Plan shortest(const Example& example) {
  Workspace workspace;
  return polyanya(example.problem(), {}, {}, workspace).value();
}

Names expanded(const Example& example, const Trace& trace) {
  Names names;
  for (const Expansion& e : trace.expansions) names.push_back(example.name(e.state));
  return names;
}
Names parents(const Example& example, const Trace& trace) {
  Names names;
  for (const Expansion& e : trace.expansions) names.push_back(example.name(e.parent));
  return names;
}

/// The grid in characters: S and G are start and goal, o where the path turns, x where the shortest does.
std::string picture(const Example& example, const Plan& plan, const Plan& least) {
  const GridFrame& frame = example.grid.frame;
  const auto mark = [&](Cell v) {
    const auto turns = [v](const Plan& p) {
      return std::find(p.vertices.begin(), p.vertices.end(), v) != p.vertices.end();
    };
    if (v == example.start) return 'S';
    if (v == example.goal) return 'G';
    return turns(plan) ? 'o' : turns(least) ? 'x' : '+';
  };
  std::string text = " ";
  for (int x = 0; x <= frame.width; ++x) text += fmt::format("  {} ", x + 1);
  text.back() = '\n';
  for (int y = frame.height; y >= 0; --y) {
    text += fmt::format("{}  ", name_of({0, y}, frame.height)[0]);
    for (int x = 0; x <= frame.width; ++x) {
      text += mark({x, y});
      text += x < frame.width ? "---" : "\n";
    }
    if (y == 0) break;
    text += "   ";
    for (int x = 0; x <= frame.width; ++x) {
      text += '|';
      text += x == frame.width ? "\n" : oracle::blocked(example.grid, x, y - 1) ? "###" : "   ";
    }
  }
  return text;
}

std::string table(const Example& example, const Trace& trace) {
  std::string text =
      "| expanded | parent |      f |      g |      h |\n"
      "|:---------|:-------|-------:|-------:|-------:|\n";
  for (const Expansion& e : trace.expansions) {
    text += fmt::format("| {:<8} | {:<6} | {:.4f} | {:.4f} | {:.4f} |\n", example.name(e.state),
                        example.name(e.parent), e.f, e.g, e.h);
  }
  return text;
}

/// The page holds the picture of the example and its trace, one after the other.
void expect_on_page(const Example& example) {
  std::ifstream file(OUTRIDER_SOURCE_DIR "/docs/planners/free-direction-examples.md");
  std::ostringstream page;
  page << file.rdbuf();
  const Searched run = free_direction(example);
  const std::string wanted = fmt::format(
      "```text\n{}```\n\n{}", picture(example, run.plan, shortest(example)), table(example, run.trace));
  EXPECT_NE(page.str().find(wanted), std::string::npos) << "the page lacks\n" << wanted;
}

/// The largest fall of f below that of a vertex expanded before; at vertices other than the goal alone if
/// asked.
double largest_fall(const Trace& trace, bool with_goal) {
  double highest = 0.0, fall = 0.0;
  for (const Expansion& e : trace.expansions) {
    if (with_goal || e.h > 0.0) fall = std::max(fall, highest - e.f);
    highest = std::max(highest, e.f);
  }
  return fall;
}

/// Every grid of so many cells, in every shape, with every pair of its vertices that a path joins.
void for_each_example(int cells, const std::function<void(const Example&, const Searched&)>& visit) {
  Searched run;
  for (int height = 1; height <= cells; ++height) {
    if (cells % height != 0) continue;
    const GridFrame frame{{}, 1.0, cells / height, height};
    const int columns = frame.width + 1, vertices = columns * (height + 1);
    for (unsigned pattern = 0; pattern < 1U << static_cast<unsigned>(cells); ++pattern) {
      Blocked grid(frame);
      for (std::size_t i = 0; i < grid.cells.size(); ++i) grid.cells[i] = (pattern >> i) & 1U;
      Example example(grid, {}, {});
      for (int i = 0; i < vertices * vertices; ++i) {
        example.start = {i % vertices % columns, i % vertices / columns};
        example.goal = {i / vertices % columns, i / vertices / columns};
        run.trace.expansions.clear();
        run.workspace.trace = &run.trace;
        auto plan = theta_star(example.problem(), {}, {}, run.workspace);
        if (!plan) continue;
        run.plan = std::move(*plan);
        visit(example, run);
      }
    }
  }
}

/// A twin written from the paper: the least length among all orders in which vertices of equal f can be
/// taken.
class EveryOrder {
 public:
  explicit EveryOrder(const Example& example) : example_(example), columns_(example.grid.frame.width + 1) {
    std::vector<Corner> corners(static_cast<std::size_t>(columns_ * (example.grid.frame.height + 1)));
    corners[number(example.start)] = {0.0, example.start, State::open};
    follow(corners);
  }
  [[nodiscard]] double least() const { return least_; }

 private:
  enum class State { unknown, open, closed };
  struct Corner {
    double g = std::numeric_limits<double>::infinity();
    Cell parent{};
    State state = State::unknown;
  };

  [[nodiscard]] std::size_t number(Cell v) const { return static_cast<std::size_t>(v.y * columns_ + v.x); }
  [[nodiscard]] Cell at(std::size_t i) const {
    return {static_cast<int>(i) % columns_, static_cast<int>(i) / columns_};
  }
  [[nodiscard]] bool legal(Cell a, Cell b) const {
    return oracle::legal(example_.grid, GridModel::corners, a, b);
  }
  static double distance(Cell a, Cell b) { return std::hypot(a.x - b.x, a.y - b.y); }

  void follow(const std::vector<Corner>& corners) {
    double least_f = std::numeric_limits<double>::infinity();
    const auto f = [&](std::size_t i) { return corners[i].g + distance(at(i), example_.goal); };
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (corners[i].state == State::open) least_f = std::min(least_f, f(i));
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (corners[i].state != State::open || f(i) > least_f + 1e-9) continue;
      if (at(i) == example_.goal) {
        least_ = std::min(least_, corners[i].g);
        continue;
      }
      std::vector<Corner> next = corners;
      expand(next, at(i));
      follow(next);
    }
  }

  void expand(std::vector<Corner>& corners, Cell v) const {
    Corner& here = corners[number(v)];
    here.state = State::closed;
    if (oracle::pinch(example_.grid, v) && !(v == example_.start)) return;
    for (const Cell move : grid_moves) {
      const Cell to{v.x + move.x, v.y + move.y};
      if (!example_.ground->contains(to) || !legal(v, to)) continue;
      Corner& there = corners[number(to)];
      const Cell parent = legal(here.parent, to) ? here.parent : v;
      const double g = corners[number(parent)].g + distance(parent, to);
      if (there.state != State::closed && g < there.g - 1e-12) there = {g, parent, State::open};
    }
  }

  const Example& example_;
  int columns_;
  double least_ = std::numeric_limits<double>::infinity();
};

/// The grid of both worked examples; they come out the same when the cell in the corner is free.
const std::vector<std::string> worked = {"##..", "...."};

TEST(WorkedExamples, SuccessorsOfB3) {
  const Example example(worked, "A4", "C1");
  const Cell b3 = vertex("B3", 2);
  Names names, legal;
  for (const Cell move : grid_moves) {
    const Cell next{b3.x + move.x, b3.y + move.y};
    if (oracle::legal(example.grid, GridModel::corners, b3, next)) legal.push_back(example.name(next));
  }
  for (unsigned i = 0; i < grid_moves.size(); ++i) {
    if ((example.ground->moves[example.ground->index(b3)] >> i & 1U) == 0) continue;
    names.push_back(example.name(Cell{b3.x + grid_moves[i].x, b3.y + grid_moves[i].y}));
  }
  std::sort(names.begin(), names.end());
  std::sort(legal.begin(), legal.end());
  EXPECT_EQ(names, (Names{"A3", "A4", "B2", "B4", "C2", "C3", "C4"}));
  EXPECT_EQ(names, legal);
}

TEST(WorkedExamples, OctileAStar) {
  for (const auto& rows : {worked, std::vector<std::string>{".#..", "...."}}) {
    const Example example(rows, "A4", "C1");
    Trace trace;
    Workspace workspace;
    workspace.trace = &trace;
    const Plan plan = a_star(example.problem(), {}, {}, workspace).value();
    EXPECT_EQ(expanded(example, trace), (Names{"A4", "B3", "C2", "C1"}));
    EXPECT_EQ(parents(example, trace), (Names{"A4", "A4", "B3", "C2"}));  // so this is also the path
    EXPECT_EQ(example.names(plan.vertices), (Names{"A4", "C2", "C1"}));   // where it turns
    EXPECT_DOUBLE_EQ(plan.cost, 1.0 + 2.0 * std::numbers::sqrt2);
  }
}

TEST(WorkedExamples, FreeDirectionAStar) {
  for (const auto& rows : {worked, std::vector<std::string>{".#..", "...."}}) {
    const Example example(rows, "A4", "C1");
    Searched run = free_direction(example);
    EXPECT_EQ(expanded(example, run.trace), (Names{"A4", "B3", "B2", "C1"}));
    EXPECT_EQ(parents(example, run.trace), (Names{"A4", "A4", "B3", "B3"}));
    EXPECT_EQ(example.names(run.plan.vertices), (Names{"A4", "B3", "C1"}));
    EXPECT_DOUBLE_EQ(run.plan.cost, std::numbers::sqrt2 + std::sqrt(5.0));
    EXPECT_DOUBLE_EQ(run.plan.cost, shortest(example).cost);

    const auto& labels = run.workspace.get<CompactMemory<CostOverParent>>().labels;
    const auto parent = [&](const char* name) {
      return example.name(labels.parent(example.ground->index(vertex(name, 2))));
    };
    EXPECT_EQ(parent("B2"), "B3");
    for (const char* name : {"C2", "C3", "C4"}) EXPECT_EQ(parent(name), "A4") << name;
    // C2 has the f of B2, up to rounding.
    const double f_of_c2 = labels.g(example.ground->index(vertex("C2", 2))).g + 1.0;
    EXPECT_NEAR(f_of_c2, run.trace.expansions[2].f, 1e-12);
  }
  expect_on_page(Example(worked, "A4", "C1"));
}

TEST(WorkedExamples, PriorityFalls) {
  const Example least({".."}, "B1", "A3");
  const Searched run = free_direction(least);
  EXPECT_EQ(expanded(least, run.trace), (Names{"B1", "A2", "A3"}));
  EXPECT_DOUBLE_EQ(largest_fall(run.trace, true), 1.0 + std::numbers::sqrt2 - std::sqrt(5.0));
  expect_on_page(least);

  const Example before_goal({"...."}, "B1", "A5");
  const Searched longer = free_direction(before_goal);
  EXPECT_EQ(expanded(before_goal, longer.trace), (Names{"B1", "B2", "A3", "A4", "A5"}));
  EXPECT_NEAR(largest_fall(longer.trace, false), 1.0 + std::sqrt(5.0) - std::sqrt(10.0), 1e-12);
  expect_on_page(before_goal);
}

TEST(WorkedExamples, NoSmallerGridHasAPriorityThatFalls) {
  for (int cells = 1; cells <= 4; ++cells) {
    double anywhere = 0.0, before_goal = 0.0;
    for_each_example(cells, [&](const Example&, const Searched& run) {
      anywhere = std::max(anywhere, largest_fall(run.trace, true));
      before_goal = std::max(before_goal, largest_fall(run.trace, false));
    });
    EXPECT_EQ(anywhere > 1e-9, cells >= 2) << cells;
    EXPECT_EQ(before_goal > 1e-9, cells >= 4) << cells;
  }
}

TEST(WorkedExamples, LongerThanTheShortestByATie) {
  const Example example({"....", "#..."}, "B1", "C5");
  const Searched run = free_direction(example);
  EXPECT_EQ(example.names(run.plan.vertices), (Names{"B1", "B3", "C5"}));
  EXPECT_EQ(example.names(shortest(example).vertices), (Names{"B1", "B2", "C5"}));
  EXPECT_DOUBLE_EQ(run.plan.cost, 2.0 + std::sqrt(5.0));
  EXPECT_DOUBLE_EQ(shortest(example).cost, 1.0 + std::sqrt(10.0));
  EXPECT_NEAR(run.plan.cost / shortest(example).cost, 1.017728, 5e-7);
  EXPECT_NEAR(EveryOrder(example).least(), shortest(example).cost, 1e-12);
  expect_on_page(example);
}

TEST(WorkedExamples, LongerThanTheShortestInEveryOrder) {
  const Example example({".....", "..#.."}, "A1", "C6");
  const Searched run = free_direction(example);
  const Plan least = shortest(example);
  EXPECT_EQ(example.names(run.plan.vertices), (Names{"A1", "B5", "C6"}));
  EXPECT_EQ(example.names(least.vertices), (Names{"A1", "B4", "C6"}));
  EXPECT_DOUBLE_EQ(run.plan.cost, std::sqrt(17.0) + std::numbers::sqrt2);
  EXPECT_DOUBLE_EQ(least.cost, std::sqrt(10.0) + std::sqrt(5.0));
  EXPECT_NEAR(run.plan.cost / least.cost, 1.025744, 5e-7);
  EXPECT_NEAR(EveryOrder(example).least(), run.plan.cost, 1e-12);
  expect_on_page(example);
}

TEST(WorkedExamples, NoSmallerGridHasALongerPath) {
  for (int cells = 1; cells <= (testing::in_full() ? 10 : 8); ++cells) {
    bool longer = false, in_every_order = false;
    for_each_example(cells, [&](const Example& example, const Searched& run) {
      if (run.plan.vertices.size() < 3) return;
      const double least = shortest(example).cost;
      if (run.plan.cost < least + 1e-9) return;
      longer = true;
      in_every_order = in_every_order || EveryOrder(example).least() > least + 1e-9;
    });
    EXPECT_EQ(longer, cells == 8 || cells == 10) << cells;
    EXPECT_EQ(in_every_order, cells == 10) << cells;
  }
}

TEST(WorkedExamples, SeededSearchForTheLongestPath) {
  Rng rng = Rng(6).child("free direction");
  double worst = 1.0;
  std::vector<Example> found;
  for (int i = 0; i < 2000; ++i) {
    const Blocked grid = random_grid(rng, 6);
    const auto draw = [&](int cells) {
      return static_cast<int>(rng.below(static_cast<std::uint64_t>(cells) + 1));
    };
    const Cell start{draw(grid.frame.width), draw(grid.frame.height)};
    const Cell goal{draw(grid.frame.width), draw(grid.frame.height)};
    const Example example(grid, start, goal);
    Workspace workspace;
    const auto plan = theta_star(example.problem(), {}, {}, workspace);
    if (!plan || start == goal) continue;
    const double ratio = plan->cost / shortest(example).cost;
    ASSERT_GE(ratio, 1.0 - 1e-12);
    if (ratio <= worst + 1e-9) continue;
    worst = ratio;
    found.assign(1, example);
  }
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(worst, (4.0 + std::numbers::sqrt2) / (2.0 + std::sqrt(10.0)), 1e-12);
  EXPECT_NEAR(EveryOrder(found.front()).least(), shortest(found.front()).cost, 1e-12);
  expect_on_page(found.front());
}

}  // namespace
}  // namespace outrider
