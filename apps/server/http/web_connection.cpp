#include "http/web_connection.hpp"

#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "http/web_socket.hpp"

namespace outrider::server {
namespace {

namespace beast = boost::beast;
namespace http = boost::beast::http;
using Clock = std::chrono::steady_clock;

constexpr std::uint32_t longest_head_bytes = 16384;
constexpr std::size_t chunk_bytes_of_head = 4096;
constexpr std::size_t chunk_bytes = 65536;
constexpr std::size_t small_answer_bytes = 65536;  // answers up to this size need no budget
constexpr std::chrono::seconds longest_body{30};
constexpr std::chrono::seconds longest_answer{60};  // for a small answer
constexpr std::uintmax_t slowest_bytes_per_s = 262144;
constexpr std::size_t most_drained_bytes = std::size_t{1} << 20U;

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return text;
}

/// Returns the request; nothing if a header on which access depends is there twice.
std::optional<Request> request_of(const http::request<http::buffer_body>& head) {
  static const std::set<std::string> single = {"host", "origin", "authorization", "sec-fetch-site"};
  Request request;
  const std::string target(head.target());
  const std::size_t question = std::min(target.find('?'), target.size());
  request.method = std::string(head.method_string());
  request.path = target.substr(0, question);
  if (question < target.size()) request.query = target.substr(question + 1);
  for (const auto& field : head) {
    const std::string name = lower_case(std::string(field.name_string()));
    const bool added = request.headers.emplace(name, std::string(field.value())).second;
    if (!added && single.contains(name)) return std::nullopt;
  }
  return request;
}

/// Returns the bytes that tell clients apart: an IPv6 network is one client.
std::string client_of(const asio::ip::address& address) {
  if (address.is_v4()) return address.to_string();
  const auto bytes = address.to_v6().to_bytes();
  return {bytes.begin(), bytes.begin() + (address.to_v6().is_v4_mapped() ? 16 : 8)};
}

std::string head_of(const Response& response, std::uintmax_t length) {
  std::string head =
      fmt::format("HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: close\r\n",
                  response.status, reason_phrase(response.status), response.type, length);
  for (const auto& [name, value] : response.headers) head += fmt::format("{}: {}\r\n", name, value);
  return head += "\r\n";
}

Response too_busy() {
  return error_response(503, "too_many", "too much is being asked at the same time; ask again");
}

}  // namespace

WebConnection::WebConnection(asio::ip::tcp::socket socket, WebHost& host)
    : host_(host), stream_(std::move(socket)), buffer_(2 * longest_head_bytes) {
  host_.connections.insert(this);
  place_ = host_.waiting.insert(host_.waiting.end(), this);
}

WebConnection::~WebConnection() {
  stop_waiting();
  host_.connections.erase(this);
}

/// Moves the connection to the end of the waiting list, because its client was just active.
void WebConnection::wait_for_client() {
  if (is_waiting_) return host_.waiting.splice(host_.waiting.end(), host_.waiting, place_);
  place_ = host_.waiting.insert(host_.waiting.end(), this);
  is_waiting_ = true;
}

void WebConnection::stop_waiting() {
  if (std::exchange(is_waiting_, false)) host_.waiting.erase(place_);
}

void WebConnection::drop() {
  stop_waiting();
  left_.request_stop();
  ErrorCode ignored;
  stream_.socket().close(ignored);
}

void WebConnection::start() {
  ErrorCode ignored;
  stream_.socket().set_option(asio::ip::tcp::no_delay(true), ignored);
  parser_.header_limit(longest_head_bytes);
  parser_.body_limit(largest_body_bytes);
  stream_.expires_after(patience);
  read_head();
}

void WebConnection::read_head() {
  stream_.async_read_some(buffer_.prepare(chunk_bytes_of_head),
                          [self = shared_from_this()](const ErrorCode& error, std::size_t count) {
                            self->buffer_.commit(count);
                            self->on_head_part(error);
                          });
}

/// Reads on until all headers are there. Headers that go on in a second line, which RFC 9112 has servers
/// refuse, are visible only here: the parser joins the lines.
void WebConnection::on_head_part(ErrorCode error) {
  const std::string_view bytes(static_cast<const char*>(buffer_.data().data()), buffer_.size());
  const std::string_view head = bytes.substr(0, bytes.find("\r\n\r\n"));
  const bool whole = head.size() < bytes.size();
  const bool folded = head.find("\r\n ") != head.npos || head.find("\r\n\t") != head.npos;
  if (!error && !whole && bytes.size() < longest_head_bytes) return read_head();
  if (error == asio::error::eof) {
    error = bytes.empty() ? http::error::end_of_stream : http::error::partial_message;
  } else if (!error && !whole) {
    error = http::error::header_limit;
  } else if (!error && folded) {
    error = http::error::bad_field;
  }
  if (!error) buffer_.consume(parser_.put(buffer_.data(), error));
  on_head(error);
}

Response WebConnection::refusal_of(const ErrorCode& error) const {
  if (error == http::error::body_limit)
    return error_response(413, "too_large", "a request has at most 32 MiB");
  if (error == http::error::header_limit || error == http::error::buffer_overflow)
    return error_response(431, "too_large", "the headers of a request have at most 16 KiB");
  if (error == beast::error::timeout || error == http::error::partial_message)
    return error_response(408, "bad_input", "the request did not come to its end");
  return error_response(400, "bad_input", "this is no HTTP request that can be answered");
}

void WebConnection::on_head(const ErrorCode& error) {
  wait_for_client();
  host_.worked = true;
  deadline_ = Clock::now() + longest_body;
  if (error == http::error::end_of_stream || error == asio::error::operation_aborted) return;
  if (error == beast::error::timeout) return;  // no request came
  if (error) return respond(refusal_of(error));
  auto request = request_of(parser_.get());
  if (!request) return respond(refusal_of(http::error::bad_field));
  request_ = std::move(*request);
  ErrorCode ignored;
  request_.client = client_of(stream_.socket().remote_endpoint(ignored).address());
  if (beast::websocket::is_upgrade(parser_.get())) {
    if (auto refused = host_.app.refuse_socket(request_)) return respond(std::move(*refused));
    if (host_.open_sockets >= most_sockets) {
      return respond(error_response(503, "too_many", fmt::format("{} viewers watch already", most_sockets)));
    }
    stream_.expires_never();
    std::make_shared<WebSocket>(std::move(stream_), host_, host_.app.open_viewer(request_))
        ->start(parser_.release(), host_.app.subprotocol(request_));
    return;
  }
  if (auto refused = host_.app.refuse(request_)) return respond(std::move(*refused));
  if (request_.header("expect").empty()) return read_body();
  part_ = "HTTP/1.1 100 Continue\r\n\r\n";
  asio::async_write(stream_, asio::buffer(part_),
                    [self = shared_from_this()](const ErrorCode& bad, std::size_t) {
                      if (!bad) self->read_body();
                    });
}

void WebConnection::read_body() {
  if (parser_.is_done()) return answer_request();
  if (chunk_.empty()) chunk_.resize(chunk_bytes);
  parser_.get().body().data = chunk_.data();
  parser_.get().body().size = chunk_.size();
  stream_.expires_after(patience);
  http::async_read_some(
      stream_, buffer_, parser_,
      [self = shared_from_this()](const ErrorCode& error, std::size_t) { self->on_body(error); });
}

void WebConnection::on_body(const ErrorCode& error) {
  if (error && error != http::error::need_buffer) {
    if (error == asio::error::operation_aborted) return;
    return respond(refusal_of(error));
  }
  if (Clock::now() > deadline_) return respond(refusal_of(beast::error::timeout));
  const std::size_t count = chunk_.size() - parser_.get().body().size;
  wait_for_client();
  if (!host_.bodies.grow(body_memory_, count)) return respond(too_busy());
  request_.body.append(chunk_.data(), count);
  read_body();
}

void WebConnection::answer_request() {
  if (host_.requests >= most_requests) return respond(too_busy());
  ++host_.requests;
  stop_waiting();
  chunk_ = {};
  stream_.expires_never();
  answering_ = true;
  request_.stop = left_.get_token();
  watch_client();
  asio::post(host_.workers, [self = shared_from_this()]() mutable {
    asio::io_context& io = self->host_.io;
    auto response = std::make_shared<Response>(self->host_.app.answer(self->request_));
    asio::post(io, [self = std::move(self), response] { self->answered(std::move(*response)); });
  });
}

/// Waits until the socket is readable, which can only mean that the client has left.
void WebConnection::watch_client() {
  stream_.socket().async_wait(
      asio::ip::tcp::socket::wait_read, [self = shared_from_this()](const ErrorCode& error) {
        if (error || !self->answering_) return;
        char byte = 0;
        const ssize_t count =
            ::recv(self->stream_.socket().native_handle(), &byte, 1, MSG_PEEK | MSG_DONTWAIT);
        if (count <= 0) self->left_.request_stop();
      });
}

void WebConnection::answered(Response response) {
  answering_ = false;
  --host_.requests;
  request_.body = {};
  body_memory_ = {};
  ErrorCode ignored;
  stream_.socket().cancel(ignored);
  respond(std::move(response));
}

void WebConnection::respond(Response response) {
  if (response.body.size() > small_answer_bytes) {
    auto lease = host_.app.shared().answers.take(response.body.size());
    if (lease) answer_memory_ = std::move(*lease);
    if (!lease) response = error_response(503, "too_many", "too many answers wait to be read; ask again");
  }
  response_ = std::move(response);
  const std::uintmax_t whole = response_.file ? response_.file->bytes() : response_.body.size();
  const std::uintmax_t bytes = response_.range ? response_.range->count : whole;
  length_ = request_.method == "HEAD" ? 0 : bytes;
  deadline_ = Clock::now() + longest_answer + std::chrono::seconds(length_ / slowest_bytes_per_s);
  part_ = head_of(response_, bytes);
  if (!response_.file && length_ <= small_answer_bytes) {
    part_.append(response_.body, 0, length_);
    sent_ = length_;
  }
  write_part();
}

/// Writes `part_`, then the next part of the body, until all is sent.
void WebConnection::write_part() {
  wait_for_client();
  stream_.expires_after(patience);
  asio::async_write(
      stream_, asio::buffer(part_), [self = shared_from_this()](const ErrorCode& error, std::size_t) {
        if (error || Clock::now() > self->deadline_) return;
        if (self->sent_ == self->length_) return self->send_close();
        const std::size_t most = std::min<std::uintmax_t>(chunk_bytes, self->length_ - self->sent_);
        const std::uintmax_t begin = self->response_.range ? self->response_.range->first : 0;
        self->part_ = self->response_.file ? self->response_.file->part(begin + self->sent_, most)
                                           : self->response_.body.substr(self->sent_, most);
        if (self->part_.empty()) return;  // file was truncated; the client can tell
        self->sent_ += self->part_.size();
        self->write_part();
      });
}

/// Ends the answer and keeps reading: a client that is still sending would lose the answer if the connection
/// were closed now.
void WebConnection::send_close() {
  response_ = {};
  answer_memory_ = {};
  ErrorCode ignored;
  stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
  stream_.expires_after(std::chrono::seconds(2));
  if (chunk_.empty()) chunk_.resize(chunk_bytes);
  drain();
}

void WebConnection::drain() {
  stream_.async_read_some(asio::buffer(chunk_),
                          [self = shared_from_this()](const ErrorCode& error, std::size_t count) {
                            self->drained_ += count;
                            if (!error && self->drained_ < most_drained_bytes) self->drain();
                          });
}

}  // namespace outrider::server
