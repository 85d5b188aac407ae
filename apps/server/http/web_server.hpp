// The server on sockets: HTTP and WebSockets through Boost.Beast, which only web_*.cpp use.
//
// Limits: 1000 connections, of which the one that has waited longest for its client makes room for the next;
// 240 WebSockets; 64 MiB of bodies; 128 MiB of unread answers. A client that is slow to ask, send or read is
// disconnected after ten seconds. Files are streamed from the disk.
#pragma once

#include <memory>
#include <string>

#include "app.hpp"
#include "outrider/core/outcome.hpp"

namespace outrider::server {

struct Listen {
  std::string address = "127.0.0.1";  ///< IPv4 or IPv6 address of this machine
  int port = 8080;                    ///< 0: any free port
};

class WebServer {
 public:
  /// Starts the server. Faults: bad_input if the address is not one of this machine, or the port is taken or
  /// not permitted.
  static Outcome<std::unique_ptr<WebServer>> start(App& app, const Listen& listen);
  virtual ~WebServer() = default;
  [[nodiscard]] virtual int port() const = 0;
};

}  // namespace outrider::server
