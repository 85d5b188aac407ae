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

/// The options of a planner function.
template <class Function>
struct OptionsOf;
template <class Options>
struct OptionsOf<Outcome<Plan> (*)(const Problem&, const Options&, const Budget&, Workspace&)> {
  using type = Options;
};

/// A planner whose index can be kept, with the functions that save and load it.
template <auto planner, auto save, auto load>
std::function<ConfiguredPlanner()> with_index() {
  return [] {
    const auto options = std::make_shared<typename OptionsOf<decltype(planner)>::type>();
    return ConfiguredPlanner{
        .options = describe(*options),
        .plan = [options](const Problem& problem, const Budget& budget,
                          Workspace& workspace) { return planner(problem, *options, budget, workspace); },
        .save_index = [options](const IndexedGround& ground, const Budget& budget,
                                Workspace& workspace) { return save(ground, *options, budget, workspace); },
        .load_index = [options](const IndexedGround& ground, const StoredIndex& stored,
                                Workspace& workspace) { return load(ground, stored, *options, workspace); }};
  };
}

}  // namespace outrider
