#include "reading.hpp"

#include <fmt/format.h>

#include <condition_variable>
#include <iostream>
#include <iterator>
#include <memory>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>

#include "child.hpp"
#include "maps.hpp"
#include "message.hpp"
#include "outrider/core/base64.hpp"
#include "scenarios.hpp"
#include "scene.hpp"
#include "yard_scenarios.hpp"

namespace outrider::server {
namespace {

constexpr std::size_t most_answer_bytes = std::size_t{64} << 20U;

Outcome<Json> packed_map(const std::string& path, const Folder& folder) {
  const auto read = read_map(path, folder);
  return read ? Outcome<Json>(packed(read->map)) : tl::unexpected(read.error());
}

Outcome<Json> changed_yard(const Json& request, const std::string& path, const Folder& folder) {
  auto files = yard_files(path, request, folder);
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
    return fault(FaultCode::budget_exhausted,
                 fmt::format("reading it takes longer than {} s, and is given up; use a simpler file",
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

/// Lets a limited number of threads pass at once; others wait, up to a time limit.
class Turnstile {
 public:
  explicit Turnstile(int places) : places_(places) {}
  bool enter(std::chrono::seconds longest_wait, const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    if (!left_.wait_for(lock, stop, longest_wait, [this] { return places_ > 0; })) return false;
    --places_;
    return true;
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
};

}  // namespace

Outcome<Json> answer_reading(const Json& question, const Folder& folder) {
  Fields fields(question, "");
  const bool map = fields.has("map"), scenario = fields.has("scenario"), scene = fields.has("scene");
  const std::string path = fields.text(map ? "map" : scenario ? "scenario" : scene ? "scene" : "save_as");
  const Json* yard = map || scenario || scene ? nullptr : fields.object("yard");
  if (auto ok = fields.end(); !ok) return pass_on(ok);
  if (map) return packed_map(path, folder);
  if (scenario) return shown_scenario(path, folder);
  if (scene) return scenario_scene(path, folder);
  return changed_yard(*yard, path, folder);
}

ReadFiles reading_in_a_child(const ReaderSettings& settings) {
  const auto turnstile = std::make_shared<Turnstile>(settings.at_once);
  return [settings, turnstile](const Folder& folder, const Json& question,
                               const std::stop_token& stop) -> Outcome<Json> {
    if (!turnstile->enter(settings.longest_wait, stop)) {
      return fault(FaultCode::budget_exhausted, "other files are being read; ask again");
    }
    struct Leaving {  // whatever happens in between
      Turnstile& turnstile;
      ~Leaving() { turnstile.leave(); }
    } const leaving{*turnstile};
    const ChildResult child = run_child({.words = {settings.tool, "serve-reader"},
                                         .folder = folder.root().string(),
                                         .input = text_of(question),
                                         .limit = settings.limit,
                                         .memory_bytes = settings.memory_bytes,
                                         .most_output_bytes = most_answer_bytes},
                                        stop, {});
    return answer_of(child, settings);
  };
}

int serve_reader() {
  const std::string text{std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>()};
  Json answer;
  try {
    const auto question = parse_json(text, "question");
    const auto folder = Folder::open(".");
    auto found = !question ? Outcome<Json>(tl::unexpected(question.error()))
                 : !folder ? Outcome<Json>(tl::unexpected(folder.error()))
                           : answer_reading(*question, *folder);
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
