// One WebSocket: its viewer, and the thread that writes what the viewer is told.
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

#include "web_host.hpp"

namespace outrider::server {

/// Lives as long as something is under way on it. A message has at most 4 MiB, which is known before it is
/// read. A client that does not read is found out by a ping that it does not answer.
class WebSocket : public std::enable_shared_from_this<WebSocket> {
 public:
  WebSocket(boost::beast::tcp_stream stream, WebHost& host);
  WebSocket(const WebSocket&) = delete;
  WebSocket& operator=(const WebSocket&) = delete;
  ~WebSocket();

  void start(const boost::beast::http::request<boost::beast::http::buffer_body>& upgrade);
  /// Ends it at once.
  void drop();

 private:
  void begin();
  void read();
  void receive();
  bool write(const std::string& text);
  void finish();

  WebHost& host_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  boost::beast::flat_buffer buffer_;
  std::shared_ptr<Viewer> viewer_;
  std::thread writer_;
  RateLimit rate_;
};

}  // namespace outrider::server
