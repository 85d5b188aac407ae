// The server on sockets: HTTP and WebSockets through civetweb, which appears in this file's source alone.
//
// A connection has a thread, of which there are so many; one that is slow in asking, in sending or in reading
// loses its connection after ten seconds. 240 WebSockets leave room for requests.
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
