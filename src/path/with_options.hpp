// with_options(): a planner function as the catalogue holds it, with options of its own.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "outrider/path/catalog.hpp"

namespace outrider {

template <class Options>
using Planner = Outcome<Plan> (*)(const Problem&, const Options&, const Budget&, Workspace&);

template <class Options>
std::function<ConfiguredPlanner()> with_options(Planner<Options> planner) {
  return [planner] {
    const auto options = std::make_shared<Options>();
    return ConfiguredPlanner{
        describe(*options),
        [planner, options](const Problem& problem, const Budget& budget, Workspace& workspace) {
          return planner(problem, *options, budget, workspace);
        }};
  };
}

template <class Options>
using ManyPlanner = std::vector<Outcome<Plan>> (*)(const Problem&, const std::vector<Vec2>&, const Options&,
                                                   const Budget&, Workspace&);

template <class Options>
std::function<ConfiguredPlanner()> with_options(Planner<Options> planner, ManyPlanner<Options> many) {
  return [planner, many] {
    const auto options = std::make_shared<Options>();
    return ConfiguredPlanner{
        describe(*options),
        [planner, options](const Problem& problem, const Budget& budget, Workspace& workspace) {
          return planner(problem, *options, budget, workspace);
        },
        [many, options](const Problem& problem, const std::vector<Vec2>& goals, const Budget& budget,
                        Workspace& workspace) { return many(problem, goals, *options, budget, workspace); }};
  };
}

template <class Options>
using SaveIndex = Outcome<std::string> (*)(const IndexedGround&, const Options&, const Budget&, Workspace&);
template <class Options>
using LoadIndex = Status (*)(const IndexedGround&, const StoredIndex&, const Options&, Workspace&);

/// A planner whose index can be kept.
template <class Options, class Save = SaveIndex<Options>, class Load = LoadIndex<Options>>
std::function<ConfiguredPlanner()> with_options(Planner<Options> planner, Save save, Load load) {
  return [planner, save, load] {
    const auto options = std::make_shared<Options>();
    return ConfiguredPlanner{
        .options = describe(*options),
        .plan = [planner, options](
                    const Problem& problem, const Budget& budget,
                    Workspace& workspace) { return planner(problem, *options, budget, workspace); },
        .save_index = [save, options](
                          const IndexedGround& ground, const Budget& budget,
                          Workspace& workspace) { return save(ground, *options, budget, workspace); },
        .load_index = [load, options](
                          const IndexedGround& ground, const StoredIndex& stored,
                          Workspace& workspace) { return load(ground, stored, *options, workspace); }};
  };
}

}  // namespace outrider
