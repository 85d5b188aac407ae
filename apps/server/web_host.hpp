// What the connections of a server share. Only the web_*.cpp files see it, and with it Boost.
//
// One thread does all reading and writing on sockets, so a connection that waits costs a few kilobytes and no
// thread. Requests are answered by a pool of threads. What is not said to be for any thread belongs to the
// thread of the sockets.
#pragma once

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/system/error_code.hpp>
#include <list>
#include <set>

#include "app.hpp"
#include "byte_budget.hpp"

namespace outrider::server {

namespace asio = boost::asio;
using ErrorCode = boost::system::error_code;

class WebConnection;
class WebSocket;

inline constexpr std::size_t most_connections = 1000;
inline constexpr int most_sockets = 240;
inline constexpr std::size_t worker_threads = 32;
inline constexpr std::size_t most_requests = 256;    ///< that are answered or wait for it
inline constexpr std::chrono::seconds patience{10};  ///< with one who is slow to ask or to read

struct WebHost {
  explicit WebHost(App& the_app) : app(the_app) {}

  App& app;
  ByteBudget bodies{std::size_t{64} << 20U};  ///< of requests that have not been answered; for any thread
  std::set<WebConnection*> connections;
  std::list<WebConnection*> waiting;  ///< those of them that wait for their client, the longest first
  std::set<WebSocket*> sockets;
  std::atomic<int> open_sockets{0};  ///< for any thread
  std::size_t requests = 0;
  bool worked = false;  ///< since memory was given back last
  asio::thread_pool workers{worker_threads};
  asio::io_context io{1};
};

}  // namespace outrider::server
