#include "live/page_viewer.hpp"

#include <nlohmann/json.hpp>

#include "http/message.hpp"

namespace outrider::server {
namespace {

constexpr std::size_t most_replies = 1024;
constexpr std::size_t largest_frame = std::size_t{64} << 10U;  // of a log
constexpr std::int64_t most_id = 1'000'000'000'000;
constexpr std::chrono::hours longest_wait{1};  // a newer plan request or closing ends it sooner
constexpr std::size_t most_waiting = 1000;     // viewers
constexpr std::size_t most_values = 200'000;   // JSON values in a message
constexpr std::chrono::milliseconds plan_patience{
    200};  // a plan that takes longer is cancelled for a newer one

std::string error_text(const Fault& fault, const Json& id) {
  Json message = {{"type", "error"}};
  message.update(error_json(fault.sentence, to_string(fault.code), fault.where));
  if (!id.is_null()) message["id"] = id;
  return text_of(message);
}

/// Returns the number that the answer to the message must carry; null if the message has no valid one.
Json id_of(const Json& message) {
  const auto id = message.find("id");
  return id != message.end() && id->is_number_unsigned() ? *id : Json();
}

std::string superseded(const Json& message) {
  return text_of(Json{{"type", "plan"}, {"id", id_of(message)}, {"superseded", true}});
}

/// As answer_plan(); an exception, which is a bug of ours, is a fault like any other.
Outcome<Json> plan_or_bug(const Json& request, PlanningMemory& memory, Workspace& workspace,
                          const std::stop_token& stop) {
  try {
    return answer_plan(request, memory, workspace, stop);
  } catch (const std::exception& broken) {
    return bad_input(std::string("this is a bug: ") + broken.what());
  }
}

}  // namespace

PageViewer::PageViewer(Runs& runs, Shared& shared, std::string hello) : runs_(runs), shared_(shared) {
  replies_.push_back(std::move(hello));
}

void PageViewer::close() {
  {
    const std::lock_guard lock(mutex_);
    planning_.request_stop();
  }
  Viewer::close();
}

bool PageViewer::receive(const std::string& text) {
  const auto lease = shared_.values.take(memory_of_json(text));
  if (!lease) return false;
  auto parsed = parse_json(text, "message", most_values);
  if (!parsed || !parsed->is_object()) return false;
  const auto message = std::make_shared<const Json>(std::move(*parsed));
  const Status ok = obey(message);
  {
    const std::lock_guard lock(mutex_);
    if (!ok) replies_.push_back(error_text(ok.error(), id_of(*message)));
    if (replies_.size() > most_replies) return false;
  }
  wake();
  return true;
}

Status PageViewer::obey(const Message& message) {
  Fields fields(*message, "");
  const std::string type = fields.text("type");
  const Json id = fields.has("id") ? Json(fields.integer("id", 0, most_id)) : Json();
  if (type == "watch") return watch(fields);
  const Json* request = type == "plan" ? fields.object("request") : nullptr;
  if (type == "plan" && request == nullptr)
    fields.refuse("request", "expected an object, as POST /api/v1/plan");
  if (auto ok = fields.end(); !ok) return ok;
  const bool known = type == "unwatch" || type == "runs" || type == "plan" || type == "ping";
  if (!known) return bad_input("expected watch, unwatch, runs, plan or ping", "type");
  if (type == "plan") want_plan(message);
  const std::lock_guard lock(mutex_);
  if (type == "unwatch") watch_ = {.generation = watch_.generation + 1};
  if (type == "runs") wants_list_ = true;
  if (type == "runs") list_seen_.reset();
  if (type == "ping") replies_.push_back(text_of(Json{{"type", "pong"}, {"id", id}}));
  return {};
}

Status PageViewer::watch(Fields& fields) {
  const std::string run = fields.text("run");
  const auto from = static_cast<std::uint64_t>(fields.integer("from", 0, 1'000'000'000, 0));
  const auto log = static_cast<std::uint64_t>(fields.integer("log", 0, 1'000'000'000'000, 0));
  if (auto ok = fields.end(); !ok) return ok;
  if (auto known = runs_.next(run, from); !known) return pass_on(known);
  const std::lock_guard lock(mutex_);
  watch_ = {.run = run, .from = from, .log = log, .generation = watch_.generation + 1};
  return {};
}

void PageViewer::want_plan(const Message& message) {
  const std::lock_guard lock(mutex_);
  if (plan_) replies_.push_back(superseded(*plan_));
  plan_ = message;
  if (std::chrono::steady_clock::now() - planning_since_ > plan_patience) planning_.request_stop();
}

PageViewer::Work PageViewer::next_work() {
  const std::lock_guard lock(mutex_);
  Work work{std::exchange(replies_, {}), std::exchange(plan_, nullptr), watch_, false};
  const std::uint64_t states = runs_.state_changes();
  work.list = wants_list_ && list_seen_ != states;
  if (wants_list_) list_seen_ = states;
  if (closed()) work.plan.reset();
  if (work.plan) planning_ = {};
  if (work.plan) planning_since_ = std::chrono::steady_clock::now();
  return work;
}

/// Sends the next bytes of the log, if there are any. Before the first ones it says where they begin, and
/// after the last ones why there are no more, unless that is because the mission has ended.
bool PageViewer::send_log(Watch& watch, const GrowingLog* log, const SendFrame& send) {
  const auto announce = [&](const std::string& stopped) {
    Json message = {{"type", "log"}, {"run", watch.run}, {"from", watch.log}};
    if (!stopped.empty()) message["stopped"] = stopped;
    return send(FrameKind::text, text_of(message));
  };
  const std::string stopped = log == nullptr
                                  ? "the live log of this run is not kept any more; fetch its log instead"
                                  : log->stopped();
  const std::string bytes = log == nullptr ? "" : log->part(watch.log, largest_frame);
  if (!bytes.empty()) {
    if (!std::exchange(watch.log_announced, true) && !announce({})) return false;
    watch.log += bytes.size();
    return send(FrameKind::binary, bytes);
  }
  if (stopped.empty() || std::exchange(watch.stop_announced, true)) return true;
  return announce(stopped);
}

/// Sends the next message of the watched run and the next bytes of its log. The message `end` waits until all
/// of the log is sent.
bool PageViewer::send_run(Watch watch, const SendFrame& send) {
  if (watch.run.empty()) return true;
  const auto message = runs_.next(watch.run, watch.from);
  if (!message) return true;
  const bool begun = message->log != nullptr || message->log_gone;
  const std::uint64_t log_before = watch.log;
  if (begun && !send_log(watch, message->log.get(), send)) return false;
  const bool more = watch.log != log_before;
  const bool waits = message->last && more;
  if (message->text && !waits) {
    if (!send(FrameKind::text, *message->text)) return false;
    watch.from = message->seq;
  }
  const std::lock_guard lock(mutex_);
  if (watch.generation == watch_.generation) watch_ = watch;
  if (message->text || more) wake();
  return true;
}

std::string PageViewer::answer(const Json& message) {
  std::stop_token stop;
  {
    const std::lock_guard lock(mutex_);
    stop = planning_.get_token();
  }
  auto place = shared_.workspaces.take(this, longest_wait, most_waiting, stop);
  if (!place) return superseded(message);
  auto plan = plan_or_bug(message["request"], shared_.planning, place->workspace(), stop);
  if (!plan && plan.error().code == FaultCode::cancelled) return superseded(message);
  if (!plan) return error_text(plan.error(), id_of(message));
  Json answer = {{"type", "plan"}, {"id", id_of(message)}};
  answer["result"] = std::move(*plan);
  return text_of(answer);
}

/// Sends the answer to a plan request. All viewers share a memory limit for answers that nobody has read.
bool PageViewer::send_plan(const Json& message, const SendFrame& send) {
  const std::string text = answer(message);
  const auto lease = shared_.answers.take(text.size());
  if (lease) return send(FrameKind::text, text);
  return send(FrameKind::text,
              error_text({FaultCode::budget_exhausted, "too many answers wait to be read; ask again", {}},
                         id_of(message)));
}

void PageViewer::serve(const SendFrame& send) {
  while (wait()) {
    const Work work = next_work();
    for (const std::string& reply : work.replies) {
      if (!send(FrameKind::text, reply)) return;
    }
    if (work.list) {
      Json list = {{"type", "runs"}};
      list.update(runs_.list());
      if (!send(FrameKind::text, text_of(list))) return;
    }
    if (!send_run(work.watch, send)) return;
    if (work.plan && !send_plan(*work.plan, send)) return;
  }
}

}  // namespace outrider::server
