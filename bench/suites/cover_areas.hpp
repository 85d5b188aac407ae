// Areas for the suite `cover`: twelve kinds of shape, drawn at random but the same in every run.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/jobs/cover/ground/problem.hpp"

namespace outrider::bench {

struct CoverKind {
  std::string_view name;
  CoverProblem (*draw)(Rng& rng);
};

/// Returns the kinds. Problems have a width of 0.8 m, an overlap of 0.1 and the largest tracking error that
/// it allows for.
const std::vector<CoverKind>& cover_kinds();

}  // namespace outrider::bench
