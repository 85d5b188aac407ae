// The server on sockets: HTTP and WebSockets through Boost.Beast, which appears in web_*.cpp alone.
//
// Bounded in all: 1000 connections, of which the one that has waited longest for its client gives way to the
// next; 240 WebSockets; 64 MiB of bodies; 128 MiB of answers that wait to be read. A client that is slow in
// asking, in sending or in reading loses its connection after ten seconds. Files are sent from the disk.
#pragma once

#include <memory>
#include <string>

#include "app.hpp"
#include "outrider/core/outcome.hpp"

namespace outrider::server {

struct Listen {
  std::string address = "127.0.0.1";  ///< IPv4 or IPv6 of this machine
  int port = 8080;                    ///< 0: one that is free
};

class WebServer {
 public:
  /// Faults: bad_input when the address is none of this machine, or the port is taken or not ours to take.
  static Outcome<std::unique_ptr<WebServer>> start(App& app, const Listen& listen);
  virtual ~WebServer() = default;
  [[nodiscard]] virtual int port() const = 0;
};

}  // namespace outrider::server
