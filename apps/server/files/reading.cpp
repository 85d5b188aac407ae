#include "files/reading.hpp"

#include <fmt/format.h>

#include <condition_variable>
#include <iostream>
#include <iterator>
#include <memory>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>

#include "files/file_kinds.hpp"
#include "http/message.hpp"
#include "outrider/core/base64.hpp"
#include "planning/maps.hpp"
#include "runs/child.hpp"
#include "runs/kept_runs.hpp"
#include "scenarios/scenarios.hpp"
#include "scenarios/scene.hpp"
#include "scenarios/yard_scenarios.hpp"

namespace outrider::server {
namespace {

constexpr std::size_t most_answer_bytes = std::size_t{64} << 20U;

Outcome<Json> packed_map(const std::string& path) {
  const auto read = read_map(path);
  return read ? Outcome<Json>(packed(read->map)) : pass_on(read);
}

Outcome<Json> changed_yard(const Json& request, const std::string& path) {
  auto files = yard_files(path, request);
  if (!files) return pass_on(files);
  Json list = Json::array();
  for (const auto& [name, content] : *files) {
    list.push_back({{"path", name}, {"base64", base64_encoded(content)}});
  }
  return Json{{"files", std::move(list)}};
}

Json fault_json(const Fault& fault) {
  return {{"fault", error_json(fault.sentence, to_string(fault.code), fault.where)}};
}

/// Returns what the reader printed, or the reason that it printed nothing.
Outcome<Json> answer_of(const ChildResult& child, const ReaderSettings& settings) {
  if (child.cancelled) return fault(FaultCode::cancelled, "nobody waits for it any more");
  if (child.timed_out) {
    return fault(
        FaultCode::budget_exhausted,
        fmt::format("reading it takes more than {} s of a processor, and is given up; use a simpler file",
                    settings.limit.count()));
  }
  Json answer = Json::parse(child.output, nullptr, false);
  if (!answer.is_object()) {
    return fault(
        FaultCode::budget_exhausted,
        fmt::format("reading it takes more than {} MiB of memory, and is given up; use a simpler file",
                    settings.memory_bytes >> 20U));
  }
  if (!answer.contains("fault")) return answer;
  const Json& refused = answer["fault"];
  const bool budget = refused.value("code", "") == to_string(FaultCode::budget_exhausted);
  return fault(budget ? FaultCode::budget_exhausted : FaultCode::bad_input, refused.value("error", ""),
               refused.value("where", ""));
}

/// Lets a limited number of threads pass at once; a limited number of others waits.
class Turnstile {
 public:
  Turnstile(int places, int waiting) : places_(places), may_wait_(waiting) {}
  bool enter(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    if (places_ == 0 && may_wait_ == 0) return false;
    --may_wait_;
    const bool entered = left_.wait(lock, stop, [this] { return places_ > 0; });
    ++may_wait_;
    if (entered) --places_;
    return entered;
  }
  void leave() {
    {
      const std::lock_guard lock(mutex_);
      ++places_;
    }
    left_.notify_one();
  }

 private:
  std::mutex mutex_;
  std::condition_variable_any left_;
  int places_;
  int may_wait_;
};

}  // namespace

Outcome<Json> answer_reading(const Json& question, const Folder& folder, const std::vector<Job>& jobs) {
  Fields fields(question, "");
  for (const auto& [key, answer] : {std::pair("kinds", &file_kind), std::pair("states", &kept_state)}) {
    const Json* names = fields.has(key) ? fields.list(key) : nullptr;
    Json answers = Json::array();
    for (const Json& name : names ? *names : Json::array()) answers.push_back(answer(name, folder));
    if (names != nullptr) return Json{{key, std::move(answers)}};
  }
  if (fields.has("head")) return scenario_head(fields.text("head"), fields.text("name"), jobs);
  const bool map = fields.has("map"), scenario = fields.has("scenario"), scene = fields.has("scene");
  auto path = checked_path(fields.text(map ? "map" : scenario ? "scenario" : scene ? "scene" : "save_as"));
  const Json* yard = map || scenario || scene ? nullptr : fields.object("yard");
  if (auto ok = fields.end(); !ok) return pass_on(ok);
  if (!path) return pass_on(path);
  if (map) return packed_map(*path);
  if (scenario) return shown_scenario(*path);
  if (scene) return scenario_scene(*path);
  return changed_yard(*yard, *path);
}

ReadFiles reading_in_a_child(const ReaderSettings& settings) {
  const auto turnstile = std::make_shared<Turnstile>(settings.at_once, settings.waiting);
  return [settings, turnstile](const Folder& folder, const Json& question,
                               const std::stop_token& stop) -> Outcome<Json> {
    if (!turnstile->enter(stop)) {
      return fault(FaultCode::cancelled, "other files are being read; ask again");
    }
    struct Leaving {  // whatever happens in between
      Turnstile& turnstile;
      ~Leaving() { turnstile.leave(); }
    } const leaving{*turnstile};
    const ChildResult child = run_child({.words = {settings.tool, "serve-reader"},
                                         .folder = folder.gate(),
                                         .input = text_of(question),
                                         .limit = settings.limit,
                                         .memory_bytes = settings.memory_bytes,
                                         .most_output_bytes = most_answer_bytes},
                                        stop, {});
    return answer_of(child, settings);
  };
}

int serve_reader(const std::vector<Job>& jobs) {
  const std::string text{std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>()};
  Json answer;
  try {
    const auto question = parse_json(text, "question");
    const auto folder = Folder::open(".");
    auto found = !question ? Outcome<Json>(pass_on(question))
                 : !folder ? Outcome<Json>(pass_on(folder))
                           : answer_reading(*question, *folder, jobs);
    answer = found ? std::move(*found) : fault_json(found.error());
  } catch (const std::bad_alloc&) {
    answer = fault_json({FaultCode::budget_exhausted,
                         "reading it takes more memory than is allowed, and is given up; use a simpler file",
                         {}});
  }
  fmt::print("{}\n", text_of(answer));
  return 0;
}

}  // namespace outrider::server
