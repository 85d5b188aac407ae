// The viewer of the page: the messages of /api/v1/live. docs/server.md describes them.
//
// It holds no queue of run messages, only a position in the messages of the run and an offset in its log, and
// only the newest plan request that waits. So a viewer that reads slowly, or not at all, costs its own
// connection and nothing more.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "live/live.hpp"
#include "live/viewer.hpp"
#include "runs/runs.hpp"

namespace outrider::server {

class PageViewer final : public Viewer {
 public:
  PageViewer(Runs& runs, Shared& shared, std::string hello);

  bool receive(const std::string& text) override;
  void serve(const SendFrame& send) override;
  void close() override;

 private:
  using Message = std::shared_ptr<const Json>;

  /// The run that is watched, and the parts of it that were sent.
  struct Watch {
    std::string run = {};
    std::uint64_t from = 0;        ///< number of the last message that was sent
    std::uint64_t log = 0;         ///< bytes of the log that were sent
    bool log_announced = false;    ///< the message `log` was sent
    bool stop_announced = false;   ///< the client knows that the log ends early
    std::uint64_t generation = 0;  ///< counts the watches of this client
  };
  struct Work {
    std::deque<std::string> replies;
    Message plan;  ///< the newest plan request; null if there is none
    Watch watch;
    bool list = false;
  };

  Status obey(const Message& message);
  Status watch(Fields& fields);
  void want_plan(const Message& message);
  Work next_work();
  bool send_run(Watch watch, const SendFrame& send);
  bool send_log(Watch& watch, const GrowingLog* log, const SendFrame& send);
  std::string answer(const Json& message);
  bool send_plan(const Json& message, const SendFrame& send);

  Runs& runs_;
  Shared& shared_;
  std::deque<std::string> replies_;
  Message plan_;
  std::stop_source planning_;
  Clock::time_point planning_since_;
  Watch watch_;
  bool wants_list_ = false;
  std::optional<std::uint64_t> list_seen_;
};

}  // namespace outrider::server
