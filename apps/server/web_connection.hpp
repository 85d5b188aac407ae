// One HTTP connection: a request, its answer, the end.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/buffer_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <memory>
#include <string>
#include <vector>

#include "web_host.hpp"

namespace outrider::server {

/// Lives as long as something is under way on it. A client that is slow in asking or in reading for longer
/// than `patience` is let go. While the answer is made, one that leaves raises the request's stop token.
class WebConnection : public std::enable_shared_from_this<WebConnection> {
 public:
  WebConnection(asio::ip::tcp::socket socket, WebHost& host);
  WebConnection(const WebConnection&) = delete;
  WebConnection& operator=(const WebConnection&) = delete;
  ~WebConnection();

  void start();
  /// Ends it at once; what is being answered is cancelled.
  void drop();

 private:
  void read_head();
  void on_head(const ErrorCode& error);
  void read_body();
  void on_body(const ErrorCode& error);
  void answer_request();
  void watch_client();
  void answered(Response response);
  void respond(Response response);
  void write_part();
  void send_close();
  void drain();
  void wait_for_client();
  void stop_waiting();
  [[nodiscard]] Response refusal_of(const ErrorCode& error) const;

  WebHost& host_;
  boost::beast::tcp_stream stream_;
  boost::beast::flat_buffer buffer_;
  boost::beast::http::request_parser<boost::beast::http::buffer_body> parser_;
  std::list<WebConnection*>::iterator place_;  // in host_.waiting
  bool is_waiting_ = true;
  bool answering_ = false;
  Request request_;
  std::stop_source left_;
  std::vector<char> chunk_;
  ByteBudget::Lease body_memory_;
  Response response_;
  ByteBudget::Lease answer_memory_;
  std::string part_;           // what is being written
  std::uintmax_t sent_ = 0;    // of the body
  std::uintmax_t length_ = 0;  // of the body
  std::size_t drained_ = 0;
  std::chrono::steady_clock::time_point deadline_{};  // of the body, then of the answer
};

}  // namespace outrider::server
