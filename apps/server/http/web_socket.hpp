// One WebSocket: its viewer, and the thread that writes messages to the client.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/buffer_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <memory>
#include <string>
#include <thread>

#include "http/web_host.hpp"

namespace outrider::server {

/// Lives as long as an operation is pending. A message has at most 4 MiB; a larger one is rejected before it
/// is read. A ping without an answer reveals a client that does not read.
class WebSocket : public std::enable_shared_from_this<WebSocket> {
 public:
  WebSocket(boost::beast::tcp_stream stream, WebHost& host, std::shared_ptr<Viewer> viewer);
  WebSocket(const WebSocket&) = delete;
  WebSocket& operator=(const WebSocket&) = delete;
  ~WebSocket();

  /// Accepts the upgrade; names the subprotocol unless it is empty.
  void start(const boost::beast::http::request<boost::beast::http::buffer_body>& upgrade,
             const std::string& subprotocol);
  /// Closes the connection at once.
  void drop();

 private:
  void begin();
  void read();
  void receive();
  bool write(FrameKind kind, const std::string& data);
  void finish();

  WebHost& host_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  boost::beast::flat_buffer buffer_;
  std::shared_ptr<Viewer> viewer_;
  std::thread writer_;
  RateLimit rate_;
};

}  // namespace outrider::server
