#include "http/web_server.hpp"
#include "outrider/core/text.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <thread>

#include "http/web_connection.hpp"
#include "http/web_host.hpp"
#include "http/web_socket.hpp"

namespace outrider::server {
namespace {

using asio::ip::tcp;

constexpr std::chrono::seconds between_trims{5};

/// Limits malloc arenas, so that the memory of many short requests returns to the system and is not spread
/// over one arena per thread.
void keep_memory_together() {
  ::mallopt(M_ARENA_MAX, 2);
  ::mallopt(M_MMAP_THRESHOLD, 1 << 20U);
  ::mallopt(M_TRIM_THRESHOLD, 4 << 20U);
}

/// Raises the limit of open files, since each connection is one; most systems allow 1024 by default.
void allow_many_files() {
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) != 0) return;
  files.rlim_cur = files.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &files);
}

tl::unexpected<Fault> cannot_listen(const Listen& listen, const ErrorCode& error) {
  if (error == asio::error::address_in_use) {
    return bad_input(
        fmt::format("the port {} is taken; give another, or 0 for one that is free", listen.port), "--port");
  }
  return bad_input(
      fmt::format("{}:{} cannot be listened at ({})", listen.address, listen.port, error.message()),
      error == asio::error::access_denied ? "--port" : "--listen");
}

class BeastServer : public WebServer {
 public:
  explicit BeastServer(App& app) : host_(app), acceptor_(host_.io), timer_(host_.io) {}
  ~BeastServer() override { stop(); }
  BeastServer(const BeastServer&) = delete;
  BeastServer& operator=(const BeastServer&) = delete;
  [[nodiscard]] int port() const override { return port_; }

  Status listen(const Listen& listen) {
    ErrorCode error;
    const auto address = asio::ip::make_address(listen.address, error);
    if (error) {
      return bad_input(fmt::format("'{}' is no address; give one of this machine, such as 0.0.0.0 for all",
                                   excerpt(listen.address)),
                       "--listen");
    }
    const tcp::endpoint place(address, static_cast<std::uint16_t>(listen.port));
    acceptor_.open(place.protocol(), error);
    if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor_.bind(place, error);
    if (!error) acceptor_.listen(256, error);
    if (error) return cannot_listen(listen, error);
    port_ = acceptor_.local_endpoint(error).port();
    accept();
    trim();
    thread_ = std::thread([this] { host_.io.run(); });
    return {};
  }

 private:
  void accept() {
    acceptor_.async_accept([this](const ErrorCode& error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error) greet(std::move(socket));
      if (error) return accept_later();  // no file descriptor is left
      accept();
    });
  }

  void greet(tcp::socket socket) {
    if (host_.connections.size() >= most_connections) {
      if (host_.waiting.empty()) return;
      host_.waiting.front()->drop();
    }
    std::make_shared<WebConnection>(std::move(socket), host_)->start();
  }

  void accept_later() {
    if (!host_.waiting.empty()) host_.waiting.front()->drop();
    asio::post(host_.io, [this] {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      accept();
    });
  }

  /// Returns unused memory to the system if work was done since the last time.
  void trim() {
    timer_.expires_after(between_trims);
    timer_.async_wait([this](const ErrorCode& error) {
      if (error) return;
      if (std::exchange(host_.worked, false)) ::malloc_trim(0);
      trim();
    });
  }

  void stop() {
    host_.app.close();
    if (!thread_.joinable()) return;
    asio::post(host_.io, [this] {
      ErrorCode ignored;
      acceptor_.close(ignored);
      timer_.cancel();
      for (WebConnection* connection : host_.connections) connection->drop();
      for (WebSocket* socket : host_.sockets) socket->drop();
    });
    host_.workers.join();
    thread_.join();  // io.run() returns when nothing is pending
  }

  WebHost host_;
  tcp::acceptor acceptor_;
  asio::steady_timer timer_;
  std::thread thread_;
  int port_ = 0;
};

}  // namespace

Outcome<std::unique_ptr<WebServer>> WebServer::start(App& app, const Listen& listen) {
  keep_memory_together();
  allow_many_files();
  auto server = std::make_unique<BeastServer>(app);
  if (auto ok = server->listen(listen); !ok) return pass_on(ok);
  return std::unique_ptr<WebServer>(std::move(server));
}

}  // namespace outrider::server
