#include "http/web_socket.hpp"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <future>

namespace outrider::server {
namespace {

namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;

constexpr std::size_t largest_message_bytes = std::size_t{4} << 20U;
constexpr double messages_per_second = 300.0;
constexpr double messages_at_once = 600.0;

}  // namespace

WebSocket::WebSocket(beast::tcp_stream stream, WebHost& host, std::shared_ptr<Viewer> viewer)
    : host_(host),
      stream_(std::move(stream)),
      viewer_(std::move(viewer)),
      rate_(messages_per_second, messages_at_once) {
  host_.sockets.insert(this);
  ++host_.open_sockets;
}

WebSocket::~WebSocket() {
  host_.sockets.erase(this);
  --host_.open_sockets;
}

void WebSocket::drop() {
  viewer_->close();
  ErrorCode ignored;
  beast::get_lowest_layer(stream_).socket().close(ignored);
}

void WebSocket::start(const beast::http::request<beast::http::buffer_body>& upgrade,
                      const std::string& subprotocol) {
  stream_.set_option(websocket::stream_base::timeout{patience, patience, true});
  stream_.read_message_max(largest_message_bytes);
  stream_.auto_fragment(false);
  if (!subprotocol.empty()) {
    stream_.set_option(websocket::stream_base::decorator([subprotocol](websocket::response_type& response) {
      response.set(beast::http::field::sec_websocket_protocol, subprotocol);
    }));
  }
  stream_.async_accept(upgrade, [self = shared_from_this()](const ErrorCode& error) {
    if (!error) self->begin();
  });
}

void WebSocket::begin() {
  // Keeps io.run() going while the thread lives, because finish() must run.
  writer_ = std::thread([self = shared_from_this(), work = asio::make_work_guard(host_.io)]() mutable {
    self->viewer_->serve([&](FrameKind kind, const std::string& data) { return self->write(kind, data); });
    asio::io_context& io = self->host_.io;
    asio::post(io, [self = std::move(self)] { self->finish(); });
  });
  read();
}

void WebSocket::read() {
  stream_.async_read(buffer_, [self = shared_from_this()](const ErrorCode& error, std::size_t) {
    if (error || !self->stream_.got_text() || !self->rate_.take(RateLimit::Clock::now())) {
      return self->viewer_->close();
    }
    self->receive();
  });
}

/// Passes the message to the viewer on another thread, since processing may take a while; then reads on.
void WebSocket::receive() {
  host_.worked = true;
  asio::post(host_.workers,
             [self = shared_from_this(), text = beast::buffers_to_string(buffer_.data())]() mutable {
               const bool good = self->viewer_->receive(text);
               text = {};
               if (!good) self->viewer_->close();
               asio::io_context& io = self->host_.io;
               asio::post(io, [self = std::move(self), good] {
                 self->buffer_ = {};
                 if (good) self->read();
               });
             });
}

/// Waits until the message is sent; returns false if the client is gone. Call it on the writing thread.
bool WebSocket::write(FrameKind kind, const std::string& data) {
  std::promise<bool> sent;
  asio::post(host_.io, [&] {
    stream_.binary(kind == FrameKind::binary);
    stream_.async_write(asio::buffer(data),
                        [&](const ErrorCode& error, std::size_t) { sent.set_value(!error); });
  });
  return sent.get_future().get();
}

/// Ends the writing and closes the connection, whether the viewer, the client or the server ended it.
void WebSocket::finish() {
  writer_.join();
  if (!stream_.is_open()) return;
  stream_.async_close(websocket::close_code::going_away, [self = shared_from_this()](const ErrorCode&) {
    beast::get_lowest_layer(self->stream_).close();
  });
}

}  // namespace outrider::server
