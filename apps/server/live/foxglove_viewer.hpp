// A viewer that speaks the Foxglove WebSocket protocol: Foxglove, Lichtblick, or any program that knows it.
//
// It reads the live log of a run from its file at the pace of its client. It holds the offsets of at most two
// readers and one part of the log while that is sent: 64 KiB, or one message that is larger.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "live/foxglove.hpp"
#include "live/live.hpp"
#include "live/log_feed.hpp"
#include "live/viewer.hpp"
#include "runs/runs.hpp"

namespace outrider::server {

class FoxgloveViewer final : public Viewer {
 public:
  /// Follows a run; if `run` is empty, the newest that has begun, and then each that begins.
  FoxgloveViewer(Runs& runs, Shared& shared, std::string version, std::string run);

  bool receive(const std::string& text) override;
  void serve(const SendFrame& send) override;

 private:
  enum class Step { idle, more, gone };  // nothing to send by now; there may be more; the client has left

  /// The run that is followed, and what the client knows of it.
  struct Followed {
    std::string run;
    std::shared_ptr<const GrowingLog> log;
    LogFeed feed;
    std::size_t advertised = 0;                               ///< channels
    std::map<std::uint32_t, std::size_t> subscriptions = {};  ///< id -> channel
    std::map<std::size_t, std::uint32_t> subscribed = {};     ///< channel -> id
    std::int64_t clock_ns = -1;                               ///< time that the client was sent last
    bool over = false;                                        ///< the client knows that no more comes
  };

  bool send_statuses(const SendFrame& send);
  Step turn_to_newest(const SendFrame& send);
  void obey(const foxglove::Request& request);
  void obey_requests();
  Step step(const SendFrame& send);
  Step finish(foxglove::Level level, const std::string& sentence, const SendFrame& send);
  Step send_part(std::uint64_t bytes, const SendFrame& send);
  bool send_message(const LogMessage& message, const SendFrame& send);
  Clock::time_point next_look();

  Runs& runs_;
  Shared& shared_;
  std::string version_;
  std::string wanted_run_;
  std::deque<foxglove::Request> requests_;  // guarded by mutex_
  std::deque<std::string> statuses_;        // guarded by mutex_
  Clock::time_point requests_since_;        // guarded by mutex_
  // The rest belongs to the thread of serve().
  std::optional<Followed> followed_;
  std::uint32_t first_channel_ = 1;  // id of the first channel of the run that is followed
  bool memory_is_short_ = false;
};

}  // namespace outrider::server
