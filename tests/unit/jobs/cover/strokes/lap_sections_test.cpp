#include "strokes/lap_sections.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "outrider/jobs/cover/strokes/plan.hpp"
#include "strokes/field_work.hpp"
#include "support/cover_areas.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

double driven_m(const cover::Lap& lap) {
  return std::accumulate(lap.begin(), lap.end(), 0.0,
                         [](double sum, const PathPiece& piece) { return sum + length_of(piece); });
}

/// Sections follow each other, close the lap, and are as long as it.
TEST(LapSections, AreTheLapInParts) {
  Rng rng(51);
  int cut = 0;
  for (int k = 0; k < testing::cases(20); ++k) {
    const CoverProblem problem = testing::random_cover_problem(rng);
    const auto ground = cover_ground(problem);
    ASSERT_TRUE(ground);
    const CoverField& field = ground->fields.front();
    const Region core = cover::core_of(problem, field, 0.5 * problem.stride_m());
    std::vector<cover::SweepCell> cells;
    for (const auto& choice : cover::cells_of(core, problem, cover::sweep_headings(field, 2), {}))
      cells.push_back(choice.front());
    for (const cover::Lap& lap : cover::laps_within(*field.ground, field.standing, ground->arc_m)) {
      const auto sections = cover::lap_sections(lap, cells, problem.stride_m(), problem.stride_m());
      double sum_m = 0.0;
      Vec2 at = sections.back().back().to;
      for (const cover::Lap& section : sections) {
        for (const PathPiece& piece : section) {
          EXPECT_LT(distance(at, piece.from), 1e-9);
          at = piece.to;
        }
        sum_m += driven_m(section);
      }
      EXPECT_NEAR(sum_m, driven_m(lap), 1e-9);
      cut += sections.size() > 1 ? 1 : 0;
    }
  }
  EXPECT_GT(cut, 0);
}

/// The lanes of a needle end far from each other: the ways between them lead along sections of its lap.
TEST(LapSections, ANeedleTakesLessThanATenthOfEmptyMoves) {
  CoverProblem problem;
  problem.boundary = {{0, 0}, {40, -0.5}, {40, 3.5}};
  problem.width_m = 0.8;
  problem.tracking_error_m = 0.04;
  const auto plan = find_cover_method("quickest")->plan(problem, {}, {});
  ASSERT_TRUE(plan);
  const auto proof = prove(*plan, problem);
  ASSERT_TRUE(proof) << to_string(proof.error());
  EXPECT_GT(plan->laps, 1U) << "sections count as laps";
  EXPECT_LT(plan->sums.length_m, 1.2 * area_of(plan->ground.reach) / problem.stride_m());
  double moves_m = 0.0;
  for (std::size_t i = 0; i < plan->roles.size(); ++i)
    moves_m += plan->roles[i] == PieceRole::move ? length_of(plan->track.pieces[i]) : 0.0;
  EXPECT_LT(moves_m, 0.1 * plan->sums.length_m);
}

}  // namespace
}  // namespace outrider
