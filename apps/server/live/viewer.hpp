// Viewer: one WebSocket without its socket: takes what the client sends, and writes what it is sent on a
// thread of its own, so nothing else waits for it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>

namespace outrider::server {

enum class FrameKind { text, binary };

/// Sends one message and waits until it is sent. Returns false if the client is gone.
using SendFrame = std::function<bool(FrameKind, const std::string&)>;

/// Thread rule: any thread may call receive(), wake() and close(); serve() runs on one.
class Viewer {
 public:
  virtual ~Viewer() = default;
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /// Takes a text message from the client. Returns false if the connection must end, because the message is
  /// not a JSON object or unread answers pile up. Never waits.
  virtual bool receive(const std::string& text) = 0;
  /// Writes until close() is called or `send` fails. Call it on its own thread.
  virtual void serve(const SendFrame& send) = 0;
  /// Says that there may be something new to send.
  void wake();
  virtual void close();

 protected:
  using Clock = std::chrono::steady_clock;
  Viewer() = default;
  /// Waits for wake() or close(), but not beyond `latest`. Returns false once the viewer is closed.
  bool wait(Clock::time_point latest = Clock::now() + std::chrono::hours(1));
  [[nodiscard]] bool closed();

  std::mutex mutex_;  // guards the members of the derived class that receive() and serve() share

 private:
  std::mutex waking_;  // guards the members below
  std::condition_variable changed_;
  bool awake_ = true;
  bool closed_ = false;
};

}  // namespace outrider::server
