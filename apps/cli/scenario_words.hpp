// What a job with a scenario takes from the command line: in its own command every key of the scenario as a
// flag, in `run` the file and little else.
//
// A request has the members `scenario`, `scenario_path` and `out`, and describe_output() lists its words
// about output.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command.hpp"
#include "flags.hpp"
#include "output.hpp"
#include "outrider/core/options.hpp"
#include "outrider/io/scenario.hpp"

namespace outrider::cli {

/// Each option and its value with the unit, as reports keep them.
std::vector<std::pair<std::string, std::string>> settings_of(const std::vector<OptionGroup>& groups);

/// Refuses what `run` does not take beside the words named.
Status refuse_other_words(const Command& words, const std::vector<std::string>& taken, const std::string& job,
                          const std::string& scenario_path);

/// A scenario of the job may stand in the place of the file that a command takes: then it is the scenario,
/// and no file is given.
void tell_scenario_from_file(std::string& file, std::string& scenario_path, std::string_view job);

template <class Request>
Status read_output_words(const Command& words, Request& request) {
  if (auto ok = apply_flags(words, {describe_output(request)}); !ok) return ok;
  return words.given("--out") ? check_folder(request.out) : Status{};
}

/// The words of the job's own command: the scenario first, then the flags, which win.
template <class Request>
Status read_job_words(const Command& words, Request& request) {
  if (auto ok = read_output_words(words, request); !ok) return ok;
  const auto groups = describe(request.scenario);
  if (!request.scenario_path.empty()) {
    if (auto ok = load_scenario(request.scenario_path, groups); !ok) return ok;
    resolve_paths(request.scenario, request.scenario_path);
  }
  return apply_flags(words, groups);
}

/// The words of `run PATH`. A job without chance has no seed.
template <class Request>
Status read_run_words(const Command& words, const std::string& path, const std::string& job, Request& request,
                      std::int64_t* seed = nullptr) {
  if (auto ok = load_scenario(path, describe(request.scenario)); !ok) return ok;
  resolve_paths(request.scenario, path);
  std::vector<std::string> taken = {"--json", "--out", "--stdin"};
  if (seed != nullptr) taken.emplace_back("--seed");
  if (auto ok = refuse_other_words(words, taken, job, path); !ok) return ok;
  if (seed != nullptr) {
    if (auto ok = apply_flags(words, {{"", "", {{"seed", "", 0, 1e15, "", seed}}}}); !ok) return ok;
  }
  return read_output_words(words, request);
}

}  // namespace outrider::cli
