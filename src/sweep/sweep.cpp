#include "outrider/sweep/sweep.hpp"

#include <fmt/format.h>

#include <set>

#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

Status check_counts(const SweepRequest& request) {
  if (request.runs == 0 || request.runs > most_sweep_runs) {
    return bad_input(
        fmt::format("'{}' is not valid; expected a whole number from 1 to {}", request.runs, most_sweep_runs),
        "--runs");
  }
  if (request.chunk_runs == 0 || request.chunk_runs > most_chunk_runs) {
    return bad_input(fmt::format("'{}' is not valid; expected a whole number from 1 to {}",
                                 request.chunk_runs, most_chunk_runs),
                     "--chunk-runs");
  }
  if (request.seed > most_seed) {
    return bad_input(
        fmt::format("'{}' is not valid; expected a whole number from 0 to {}", request.seed, most_seed),
        "--seed");
  }
  return {};
}

Status parse_all(Sweep& sweep) {
  for (const std::string& text : sweep.request.vary) {
    auto varied = parse_varied(text);
    if (!varied) return pass_on(varied);
    sweep.varied.push_back(std::move(*varied));
  }
  for (const std::string& text : sweep.request.compare) {
    auto varied = parse_varied(text);
    if (varied && varied->grid.size() == 2 && varied->grid[0] != varied->grid[1]) {
      sweep.compared.push_back(std::move(*varied));
      continue;
    }
    return bad_input(
        fmt::format("'{}' is not valid; expected KEY=A,B with two different values", excerpt(text)),
        "--compare");
  }
  return {};
}

Status check_keys(const Sweep& sweep, JobTask& task) {
  std::set<std::string> seen;
  for (const std::string& key : keys_of(sweep)) {
    if (!seen.insert(key).second) {
      return bad_input("it varies twice; give it once, as --vary or --compare", key);
    }
    if (key == "seed" && sweep.has_seed) {
      return bad_input("each run has a seed of its own; give --seed and --runs instead", key);
    }
    if (key == "job") return bad_input("a sweep is of one job; make one for each", key);
  }
  for (const auto* list : {&sweep.varied, &sweep.compared}) {
    for (const Varied& varied : *list) {
      for (const std::string& value : extreme_values(varied)) {
        if (auto ok = change(task, {{varied.key, value}}); !ok) return ok;
      }
    }
  }
  return {};
}

/// Sets the sizes. Refuses more runs than a sweep may have, without overflow.
Status multiply(Sweep& sweep) {
  const std::uint64_t most = most_sweep_runs / sweep.request.runs / sweep.sides();
  for (const Varied& varied : sweep.varied) {
    if (varied.is_random()) continue;
    if (sweep.points > most / varied.grid.size()) {
      return bad_input(fmt::format("the grid has too many points for {} runs of each: a sweep has at most {} "
                                   "runs; give fewer values or fewer --runs",
                                   sweep.request.runs, most_sweep_runs),
                       varied.key);
    }
    sweep.points *= varied.grid.size();
  }
  if (most == 0) {
    return bad_input(fmt::format("{} runs of both sides are more than the {} that a sweep has at most; "
                                 "give half as many",
                                 sweep.request.runs, most_sweep_runs),
                     "--runs");
  }
  sweep.total = sweep.request.runs * sweep.points * sweep.sides();
  return {};
}

bool has_option(JobTask& task, std::string_view wanted) {
  for (const OptionGroup& group : task.options()) {
    for (const Option& option : group.options) {
      if (key_of(group, option) == wanted) return true;
    }
  }
  return false;
}

}  // namespace

Outcome<Sweep> prepare_sweep(const std::vector<Job>& jobs, const SweepRequest& request) {
  if (auto ok = check_counts(request); !ok) return pass_on(ok);
  auto job = job_of_scenario(jobs, request.scenario);
  if (!job) return pass_on(job);
  Sweep sweep{.request = request, .job = std::move(*job)};
  const auto task = sweep.job.blank();
  if (auto ok = read_scenario(*task, request.scenario); !ok) return pass_on(ok);
  sweep.has_seed = has_option(*task, "seed");
  if (auto ok = parse_all(sweep); !ok) return pass_on(ok);
  if (auto ok = check_keys(sweep, *task); !ok) return pass_on(ok);
  if (auto ok = multiply(sweep); !ok) return pass_on(ok);
  return sweep;
}

std::vector<std::string> keys_of(const Sweep& sweep) {
  std::vector<std::string> keys;
  for (const auto* list : {&sweep.varied, &sweep.compared}) {
    for (const Varied& varied : *list) keys.push_back(varied.key);
  }
  return keys;
}

SweepRun run_of(const Sweep& sweep, std::uint64_t number) {
  SweepRun run{.number = number};
  run.side = number % sweep.sides();
  run.point = number / sweep.sides() % sweep.points;
  run.sample = number / sweep.sides() / sweep.points;
  const Rng stream = Rng(sweep.request.seed).child(run.sample);
  run.seed = Rng(stream).below(most_seed);
  run.values.resize(sweep.varied.size());
  std::uint64_t point = run.point;
  for (std::size_t i = sweep.varied.size(); i-- > 0;) {
    const Varied& varied = sweep.varied[i];
    if (varied.is_random()) {
      run.values[i] = draw(varied, stream.child(varied.key));
      continue;
    }
    run.values[i] = varied.grid[point % varied.grid.size()];
    point /= varied.grid.size();
  }
  for (const Varied& varied : sweep.compared) run.values.push_back(varied.grid[run.side]);
  return run;
}

Changes changes_of(const Sweep& sweep, const SweepRun& run) {
  Changes changes;
  if (sweep.has_seed) changes.emplace_back("seed", fmt::format("{}", run.seed));
  const auto keys = keys_of(sweep);
  for (std::size_t i = 0; i < keys.size(); ++i) changes.emplace_back(keys[i], run.values[i]);
  return changes;
}

}  // namespace outrider
