// State shared by the connections of a server. Only the web_*.cpp files include this file, and with it Boost.
//
// One thread does all reading and writing on sockets, so a waiting connection costs a few kilobytes and no
// thread. A pool of threads answers requests. Everything not marked "for any thread" belongs to the socket
// thread.
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
inline constexpr std::size_t worker_threads = 48;    ///< more than may wait for readers and plans
inline constexpr std::size_t most_requests = 256;    ///< requests in progress or waiting
inline constexpr std::chrono::seconds patience{10};  ///< time limit of a slow client

struct WebHost {
  explicit WebHost(App& the_app) : app(the_app) {}

  App& app;
  ByteBudget bodies{std::size_t{64} << 20U};  ///< for unanswered requests; for any thread
  std::set<WebConnection*> connections;
  std::list<WebConnection*> waiting;  ///< connections that wait for their client, longest first
  std::set<WebSocket*> sockets;
  std::atomic<int> open_sockets{0};  ///< for any thread
  std::size_t requests = 0;
  bool worked = false;  ///< since memory was last released
  asio::thread_pool workers{worker_threads};
  asio::io_context io{1};
};

}  // namespace outrider::server
