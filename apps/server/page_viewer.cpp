#include "live.hpp"

#include <nlohmann/json.hpp>

#include "message.hpp"

namespace outrider::server {
namespace {

constexpr std::size_t most_replies = 1024;
constexpr std::int64_t most_id = 1'000'000'000'000;
constexpr std::chrono::hours longest_wait{1};       // a newer plan request or closing ends it sooner
constexpr std::size_t most_waiting = 1000;          // viewers
constexpr std::size_t most_values = 200'000;        // JSON values in a message
constexpr std::chrono::milliseconds patience{200};  // a plan that takes longer is cancelled for a newer one

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

}  // namespace

Viewer::Viewer(Runs& runs, Shared& shared, std::string hello) : runs_(runs), shared_(shared) {
  replies_.push_back(std::move(hello));
}

void Viewer::wake() {
  {
    const std::lock_guard lock(mutex_);
    awake_ = true;
  }
  changed_.notify_one();
}

void Viewer::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    planning_.request_stop();
  }
  wake();
}

bool Viewer::receive(const std::string& text) {
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

Status Viewer::obey(const Message& message) {
  Fields fields(*message, "");
  const std::string type = fields.text("type");
  const Json id = fields.has("id") ? Json(fields.integer("id", 0, most_id)) : Json();
  if (type == "watch") {
    const std::string run = fields.text("run");
    const auto from = static_cast<std::uint64_t>(fields.integer("from", 0, 1'000'000'000, 0));
    if (auto ok = fields.end(); !ok) return ok;
    if (auto known = runs_.next(run, from); !known) return pass_on(known);
    const std::lock_guard lock(mutex_);
    run_ = run;
    from_ = from;
    return {};
  }
  const Json* request = type == "plan" ? fields.object("request") : nullptr;
  if (type == "plan" && request == nullptr)
    fields.refuse("request", "expected an object, as POST /api/v1/plan");
  if (auto ok = fields.end(); !ok) return ok;
  const bool known = type == "unwatch" || type == "runs" || type == "plan" || type == "ping";
  if (!known) return bad_input("expected watch, unwatch, runs, plan or ping", "type");
  if (type == "plan") want_plan(message);
  const std::lock_guard lock(mutex_);
  if (type == "unwatch") run_.clear();
  if (type == "runs") wants_list_ = true;
  if (type == "runs") list_seen_.reset();
  if (type == "ping") replies_.push_back(text_of(Json{{"type", "pong"}, {"id", id}}));
  return {};
}

void Viewer::want_plan(const Message& message) {
  const std::lock_guard lock(mutex_);
  if (plan_) replies_.push_back(superseded(*plan_));
  plan_ = message;
  if (std::chrono::steady_clock::now() - planning_since_ > patience) planning_.request_stop();
}

Viewer::Work Viewer::next_work() {
  const std::lock_guard lock(mutex_);
  Work work{std::exchange(replies_, {}), std::exchange(plan_, nullptr), run_, from_, false};
  const std::uint64_t states = runs_.state_changes();
  work.list = wants_list_ && list_seen_ != states;
  if (wants_list_) list_seen_ = states;
  if (closed_) work.plan.reset();
  if (work.plan) planning_ = {};
  if (work.plan) planning_since_ = std::chrono::steady_clock::now();
  return work;
}

/// Sends one message of the watched run, if there is one.
bool Viewer::send_run(const Work& work, const std::function<bool(const std::string&)>& send) {
  if (work.run.empty()) return true;
  const auto message = runs_.next(work.run, work.from);
  if (!message || !message->text) return true;
  if (!send(*message->text)) return false;
  const std::lock_guard lock(mutex_);
  awake_ = true;  // more messages may follow
  if (run_ == work.run && from_ == work.from) from_ = message->seq;
  return true;
}

std::string Viewer::answer(const Json& message) {
  std::stop_token stop;
  {
    const std::lock_guard lock(mutex_);
    stop = planning_.get_token();
  }
  auto place = shared_.workspaces.take(this, longest_wait, most_waiting, stop);
  if (!place) return superseded(message);
  Outcome<Json> plan = bad_input("");
  try {
    plan = answer_plan(message["request"], shared_.planning, place->workspace(), stop);
  } catch (const std::exception& broken) {
    plan = bad_input(std::string("this is a bug: ") + broken.what());
  }
  if (!plan && plan.error().code == FaultCode::cancelled) return superseded(message);
  if (!plan) return error_text(plan.error(), id_of(message));
  Json answer = {{"type", "plan"}, {"id", id_of(message)}};
  answer["result"] = std::move(*plan);
  return text_of(answer);
}

/// Sends the answer to a plan request. All viewers share a memory limit for answers that nobody has read.
bool Viewer::send_plan(const Json& message, const std::function<bool(const std::string&)>& send) {
  const std::string text = answer(message);
  const auto lease = shared_.answers.take(text.size());
  if (lease) return send(text);
  return send(error_text({FaultCode::budget_exhausted, "too many answers wait to be read; ask again", {}},
                         id_of(message)));
}

void Viewer::serve(const std::function<bool(const std::string&)>& send) {
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return awake_ || closed_; });
      if (closed_) return;
      awake_ = false;
    }
    const Work work = next_work();
    for (const std::string& reply : work.replies) {
      if (!send(reply)) return;
    }
    if (work.list) {
      Json list = {{"type", "runs"}};
      list.update(runs_.list());
      if (!send(text_of(list))) return;
    }
    if (!send_run(work, send)) return;
    if (work.plan && !send_plan(*work.plan, send)) return;
  }
}

Live::Live(Runs& runs, Shared& shared, std::string version)
    : runs_(runs),
      shared_(shared),
      hello_(text_of(Json{{"type", "hello"}, {"api", 1}, {"version", version}})),
      register_(std::make_shared<Register>()) {
  runs_.on_change([known = register_] {
    std::vector<std::shared_ptr<Viewer>> viewers;
    {
      const std::lock_guard lock(known->mutex);
      for (const auto& viewer : known->viewers) viewers.push_back(viewer.lock());
    }
    for (const auto& viewer : viewers) {
      if (viewer) viewer->wake();
    }
  });
}

Live::~Live() {
  runs_.on_change({});
  close();
}

std::shared_ptr<Viewer> Live::open() {
  auto viewer = std::make_shared<Viewer>(runs_, shared_, hello_);
  const std::lock_guard lock(register_->mutex);
  std::erase_if(register_->viewers, [](const auto& other) { return other.expired(); });
  register_->viewers.push_back(viewer);
  if (register_->closed) viewer->close();
  return viewer;
}

void Live::close() {
  std::vector<std::weak_ptr<Viewer>> viewers;
  {
    const std::lock_guard lock(register_->mutex);
    register_->closed = true;
    viewers = register_->viewers;
  }
  for (const auto& viewer : viewers) {
    if (const auto one = viewer.lock()) one->close();
  }
}

}  // namespace outrider::server
