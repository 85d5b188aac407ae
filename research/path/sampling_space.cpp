#include "research/path/sampling_space.hpp"

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/samplers/InformedStateSampler.h>

#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

namespace ob = ompl::base;
using Space = ob::RealVectorStateSpace;

double area_of(const Box2& box) { return box.size().x * box.size().y; }

struct FreePoint : ob::StateValidityChecker {
  const PolygonGround& ground;
  FreePoint(const ob::SpaceInformationPtr& plane, const PolygonGround& on)
      : StateValidityChecker(plane), ground(on) {}
  bool isValid(const ob::State* state) const override { return ground.point_free(point_of(state)); }
};

/// Tests motions. OMPL only tests motions that begin at a valid state.
struct FreeMotion : ob::MotionValidator {
  const PolygonGround& ground;
  Met* met;
  FreeMotion(const ob::SpaceInformationPtr& plane, const Draws& draws)
      : MotionValidator(plane), ground(*draws.problem.polygons), met(draws.met) {}
  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    if (met != nullptr) met->meet(point_of(from));
    if (met != nullptr) met->meet(point_of(to));
    return ground.segment_free({point_of(from), point_of(to)});
  }
  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last) const override {
    if (checkMotion(from, to)) return true;
    last.second = 0.0;
    if (last.first != nullptr) place_at(last.first, point_of(from));
    return false;
  }
};

struct Sampler : ob::StateSampler {
  Draws& draws;
  Sampler(const ob::StateSpace* space, Draws& from) : StateSampler(space), draws(from) {}
  void sampleUniform(ob::State* state) override { place_at(state, draws.anywhere()); }
  void sampleUniformNear(ob::State* state, const ob::State* near, double reach) override {
    const double x = draws.rng.uniform(-reach, reach), y = draws.rng.uniform(-reach, reach);
    place_at(state, point_of(near) + Vec2{x, y});
  }
  void sampleGaussian(ob::State* state, const ob::State* mean, double deviation) override {
    const double x = draws.rng.normal(), y = draws.rng.normal();
    place_at(state, point_of(mean) + deviation * Vec2{x, y});
  }
};

struct InformedSampler : ob::InformedSampler {
  Draws& draws;
  InformedSampler(const ob::ProblemDefinitionPtr& definition, unsigned most_tries, Draws& from)
      : ob::InformedSampler(definition, most_tries), draws(from) {}

  bool sampleUniform(ob::State* state, const ob::Cost& most) override {
    return sampleUniform(state, ob::Cost(0.0), most);
  }
  bool sampleUniform(ob::State* state, const ob::Cost& least, const ob::Cost& most) override {
    for (unsigned tries = 0; tries < numIters_; ++tries) {
      const Vec2 p = draws.within(most.value());
      place_at(state, p);
      const double length = distance(draws.problem.start, p) + distance(p, draws.problem.goal);
      if (draws.ended() || (length >= least.value() && length < most.value())) return true;
    }
    return false;
  }
  bool hasInformedMeasure() const override { return true; }
  double getInformedMeasure(const ob::Cost& most) const override {
    return std::min(area_of(draws.problem.polygons->bounds), area_within(draws.problem, most.value()));
  }
};

struct PathLength : ob::PathLengthOptimizationObjective {
  Draws& draws;
  PathLength(const ob::SpaceInformationPtr& plane, Draws& from)
      : PathLengthOptimizationObjective(plane), draws(from) {}
  ob::InformedSamplerPtr allocInformedStateSampler(const ob::ProblemDefinitionPtr& definition,
                                                   unsigned most_tries) const override {
    return std::make_shared<InformedSampler>(definition, most_tries, draws);
  }
};

}  // namespace

Vec2 point_of(const ob::State* state) {
  const double* values = state->as<Space::StateType>()->values;
  return {values[0], values[1]};
}

void place_at(ob::State* state, Vec2 p) {
  double* values = state->as<Space::StateType>()->values;
  values[0] = p.x;
  values[1] = p.y;
}

void Draws::count() {
  over = over || meter.spent() >= most;
  refused = refused || (!over && !meter.spend());
}

Vec2 Draws::anywhere() {
  const Box2& box = problem.polygons->bounds;
  const double x = rng.uniform(box.low.x, box.high.x), y = rng.uniform(box.low.y, box.high.y);
  count();
  return {x, y};
}

Vec2 Draws::within(double length) {
  if (area_within(problem, length) >= area_of(problem.polygons->bounds)) return anywhere();
  const Vec2 between = problem.goal - problem.start;
  const double apart = norm(between);
  const double half_long = 0.5 * length, half_wide = 0.5 * std::sqrt(length * length - apart * apart);
  const double from_centre = std::sqrt(rng.uniform());
  const Vec2 on_disk = from_centre * direction(rng.uniform(0.0, 2.0 * pi));
  const Vec2 along = (1.0 / apart) * between;
  const Vec2 p = problem.start + 0.5 * between + half_long * on_disk.x * along +
                 half_wide * on_disk.y * perpendicular(along);
  count();
  return p;
}

double area_within(const Problem& problem, double length) {
  const double apart = distance(problem.start, problem.goal);
  return 0.25 * pi * length * std::sqrt(std::max(0.0, length * length - apart * apart));
}

ob::SpaceInformationPtr free_plane(Draws& draws) {
  const PolygonGround& ground = *draws.problem.polygons;
  const auto space = std::make_shared<Space>(2);
  ob::RealVectorBounds bounds(2);
  bounds.low = {ground.bounds.low.x, ground.bounds.low.y};
  bounds.high = {ground.bounds.high.x, ground.bounds.high.y};
  space->setBounds(bounds);
  space->setStateSamplerAllocator([&draws](const ob::StateSpace* on) -> ob::StateSamplerPtr {
    return std::make_shared<Sampler>(on, draws);
  });
  auto plane = std::make_shared<ob::SpaceInformation>(space);
  plane->setStateValidityChecker(std::make_shared<FreePoint>(plane, ground));
  plane->setMotionValidator(std::make_shared<FreeMotion>(plane, draws));
  plane->setup();
  return plane;
}

ob::OptimizationObjectivePtr path_length(const ob::SpaceInformationPtr& plane, Draws& draws) {
  auto length = std::make_shared<PathLength>(plane, draws);
  length->setCostToGoHeuristic(&ob::goalRegionCostToGo);
  return length;
}

}  // namespace outrider
