#include "live/foxglove_viewer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

namespace outrider::server {
namespace {

constexpr std::size_t most_waiting = 4096;           // that wait to be obeyed
constexpr std::size_t most_message_values = 20'000;  // JSON values in a message
// A client subscribes to its channels one by one, and has them in the order of time if they begin together.
constexpr std::chrono::milliseconds settling{100};
constexpr std::chrono::milliseconds pause{20};  // until there is memory again

}  // namespace

FoxgloveViewer::FoxgloveViewer(Runs& runs, Shared& shared, std::string version, std::string run)
    : runs_(runs), shared_(shared), version_(std::move(version)), wanted_run_(std::move(run)) {}

bool FoxgloveViewer::receive(const std::string& text) {
  const auto lease = shared_.values.take(memory_of_json(text));
  if (!lease) return false;
  const auto message = parse_json(text, "message", most_message_values);
  if (!message || !message->is_object()) return false;
  const auto requests = foxglove::requests_of(*message);
  {
    const std::lock_guard lock(mutex_);
    if (!requests) {
      statuses_.push_back(foxglove::status(foxglove::Level::error, requests.error().sentence));
    } else if (!requests->empty()) {
      if (requests_.empty()) requests_since_ = Clock::now();
      requests_.insert(requests_.end(), requests->begin(), requests->end());
    }
    if (requests_.size() > most_waiting || statuses_.size() > most_waiting) return false;
  }
  wake();
  return true;
}

bool FoxgloveViewer::send_statuses(const SendFrame& send) {
  std::deque<std::string> statuses;
  {
    const std::lock_guard lock(mutex_);
    statuses = std::exchange(statuses_, {});
  }
  return std::ranges::all_of(statuses, [&](const std::string& text) { return send(FrameKind::text, text); });
}

/// Turns to the run that is to be followed by now: withdraws the channels of the one before.
FoxgloveViewer::Step FoxgloveViewer::turn_to_newest(const SendFrame& send) {
  const std::string run = wanted_run_.empty() ? runs_.newest_begun() : wanted_run_;
  if (followed_ && followed_->run == run) return Step::idle;
  auto message = runs_.next(run, 0);
  if (!message || !message->log) return Step::idle;
  const std::size_t count = followed_ ? followed_->advertised : 0;
  if (count > 0 && !send(FrameKind::text, foxglove::unadvertise(first_channel_, count))) return Step::gone;
  first_channel_ += static_cast<std::uint32_t>(count);
  const std::string path = message->log->path();
  followed_.emplace(Followed{run, std::move(message->log), LogFeed(path)});
  return Step::more;
}

void FoxgloveViewer::obey(const foxglove::Request& request) {
  const auto refuse = [&](const std::string& sentence) {
    const std::lock_guard lock(mutex_);
    statuses_.push_back(foxglove::status(foxglove::Level::warning, sentence));
  };
  if (!followed_) return;
  Followed& run = *followed_;
  const auto known = run.subscriptions.find(request.subscription);
  if (!request.begins) {
    if (known == run.subscriptions.end()) return;
    run.feed.unsubscribe(known->second);
    run.subscribed.erase(known->second);
    run.subscriptions.erase(known);
    return;
  }
  const std::size_t channel = request.channel - first_channel_;
  if (request.channel < first_channel_ || channel >= run.advertised)
    return refuse(fmt::format("there is no channel {}", request.channel));
  if (known != run.subscriptions.end())
    return refuse(fmt::format("the subscription {} exists", request.subscription));
  if (!run.subscribed.emplace(channel, request.subscription).second)
    return refuse(fmt::format("the channel {} has a subscription already", request.channel));
  run.subscriptions.emplace(request.subscription, channel);
  run.feed.subscribe(channel);
}

/// Obeys what the client asked, once it has had the time to ask for all that it wants.
void FoxgloveViewer::obey_requests() {
  std::deque<foxglove::Request> requests;
  {
    const std::lock_guard lock(mutex_);
    if (requests_.empty() || Clock::now() < requests_since_ + settling) return;
    requests = std::exchange(requests_, {});
  }
  for (const foxglove::Request& request : requests) obey(request);
}

bool FoxgloveViewer::send_message(const LogMessage& message, const SendFrame& send) {
  const auto subscription = followed_->subscribed.find(message.channel);
  if (subscription == followed_->subscribed.end()) return true;
  if (message.time_ns > followed_->clock_ns) {
    followed_->clock_ns = message.time_ns;
    if (!send(FrameKind::binary, foxglove::time(message.time_ns))) return false;
  }
  return send(FrameKind::binary, foxglove::message_data(subscription->second, message.time_ns, message.data));
}

/// Sends the messages of the next part of the log, and announces the channels in it.
FoxgloveViewer::Step FoxgloveViewer::send_part(std::uint64_t bytes, const SendFrame& send) {
  ByteBudget& memory = shared_.messages;
  const auto lease = memory.take(std::min(2 * static_cast<std::size_t>(bytes), memory.all()));
  memory_is_short_ = !lease;
  if (!lease) return Step::idle;
  Followed& run = *followed_;
  bool gone = false;
  const Status read =
      run.feed.read([&](const LogMessage& message) { gone = gone || !send_message(message, send); });
  if (gone) return Step::gone;
  if (!read) return finish(foxglove::Level::error, read.error().sentence, send);
  const std::span<const Channel> channels = run.feed.channels();
  if (channels.size() == run.advertised) return Step::more;
  const auto first = first_channel_ + static_cast<std::uint32_t>(run.advertised);
  const std::string text = foxglove::advertise(channels.subspan(run.advertised), first);
  run.advertised = channels.size();
  return send(FrameKind::text, text) ? Step::more : Step::gone;
}

/// Says once that no more comes of this run. Channels that are subscribed later are still sent.
FoxgloveViewer::Step FoxgloveViewer::finish(foxglove::Level level, const std::string& sentence,
                                            const SendFrame& send) {
  if (std::exchange(followed_->over, true)) return Step::idle;
  return send(FrameKind::text, foxglove::status(level, sentence)) ? Step::idle : Step::gone;
}

FoxgloveViewer::Step FoxgloveViewer::step(const SendFrame& send) {
  obey_requests();
  if (!send_statuses(send)) return Step::gone;
  const Step turned = turn_to_newest(send);
  if (turned != Step::idle || !followed_) return turned;
  Followed& run = *followed_;
  const std::string stopped = run.log->stopped();
  const bool ended = run.log->ended();  // asked first: what was appended before is read next
  const auto bytes = run.feed.next();
  if (!bytes) return finish(foxglove::Level::error, bytes.error().sentence, send);
  if (*bytes > 0) return send_part(*bytes, send);
  if (!stopped.empty()) return finish(foxglove::Level::warning, stopped, send);
  return ended ? finish(foxglove::Level::info, fmt::format("the run {} has ended", run.run), send)
               : Step::idle;
}

/// Returns when to look again even if nobody wakes the viewer.
FoxgloveViewer::Clock::time_point FoxgloveViewer::next_look() {
  constexpr std::chrono::hours long_time{1};
  const std::lock_guard lock(mutex_);
  if (memory_is_short_) return Clock::now() + pause;
  return requests_.empty() ? Clock::now() + long_time : requests_since_ + settling;
}

void FoxgloveViewer::serve(const SendFrame& send) {
  if (!send(FrameKind::text, foxglove::server_info(version_))) return;
  if (!send(FrameKind::text, foxglove::advertise({}, first_channel_))) return;
  while (!closed()) {
    const Step done = step(send);
    if (done == Step::gone) return;
    if (done == Step::idle && !wait(next_look())) return;
  }
}

}  // namespace outrider::server
