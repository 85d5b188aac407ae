// One HTTP connection: one request and its answer.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/buffer_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <memory>
#include <string>
#include <vector>

#include "http/web_host.hpp"

namespace outrider::server {

/// Lives as long as an operation is pending. Disconnects a client that sends or reads nothing for longer than
/// `patience`. A client that leaves while its answer is made raises the stop token of the request.
class WebConnection : public std::enable_shared_from_this<WebConnection> {
 public:
  WebConnection(asio::ip::tcp::socket socket, WebHost& host);
  WebConnection(const WebConnection&) = delete;
  WebConnection& operator=(const WebConnection&) = delete;
  ~WebConnection();

  void start();
  /// Closes the connection at once and cancels the request in progress.
  void drop();

 private:
  void read_head();
  void on_head_part(ErrorCode error);
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
  std::string part_;           // bytes being written
  std::uintmax_t sent_ = 0;    // bytes of the body
  std::uintmax_t length_ = 0;  // bytes of the body
  std::size_t drained_ = 0;
  std::chrono::steady_clock::time_point deadline_{};  // for the request body, then for the answer
};

}  // namespace outrider::server
