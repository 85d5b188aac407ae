#include "web_server.hpp"

#include <arpa/inet.h>
#include <civetweb.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <pthread.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>

/// civetweb gives its threads 100 KiB of stack, of which the thread-local storage of all libraries takes a
/// part: too little for its own messages, let alone for a search. It has no option for that, so its request
/// is answered here, in place of the C library: no thread of this program has less than the usual 8 MiB.
extern "C" int pthread_attr_setstacksize(pthread_attr_t* attributes, std::size_t bytes) noexcept {
  using Original = int (*)(pthread_attr_t*, std::size_t);
  static const auto original = reinterpret_cast<Original>(::dlsym(RTLD_NEXT, "pthread_attr_setstacksize"));
  return original(attributes, std::max(bytes, std::size_t{8} << 20U));
}

namespace outrider::server {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int most_sockets = 240;
constexpr int threads = most_sockets + 48;
constexpr std::chrono::seconds longest_body{30};
constexpr std::size_t largest_message_bytes = std::size_t{4} << 20U;
constexpr double messages_per_second = 300.0;
constexpr double messages_at_once = 600.0;

/// One WebSocket: its viewer, and the thread that writes to it.
struct Socket {
  std::shared_ptr<Viewer> viewer;
  std::thread writer;
  std::string partial;  // a message that comes in several frames
  RateLimit rate{messages_per_second, messages_at_once};
};

Request request_of(const mg_connection* connection) {
  const mg_request_info& info = *mg_get_request_info(connection);
  const auto text = [](const char* value) { return std::string(value == nullptr ? "" : value); };
  Request request{text(info.request_method), text(info.request_uri), text(info.query_string), {}, {}};
  for (int i = 0; i < info.num_headers; ++i) {
    std::string name = text(info.http_headers[i].name);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    request.headers.emplace(std::move(name), text(info.http_headers[i].value));
  }
  return request;
}

/// Reads the body; the status of the refusal of one that is too large or too slow, else 0.
int read_body(mg_connection* connection, std::string& body) {
  const auto deadline = Clock::now() + longest_body;
  if (mg_get_request_info(connection)->content_length > static_cast<long long>(largest_body_bytes))
    return 413;
  std::array<char, 65536> buffer{};
  for (int count = 1; count > 0;) {
    count = mg_read(connection, buffer.data(), buffer.size());
    if (count < 0 || Clock::now() > deadline) return 408;
    if (body.size() + static_cast<std::size_t>(count) > largest_body_bytes) return 413;
    body.append(buffer.data(), static_cast<std::size_t>(count));
  }
  const long long promised = mg_get_request_info(connection)->content_length;
  return promised > static_cast<long long>(body.size()) ? 408 : 0;
}

void send(mg_connection* connection, const Response& response, bool with_body) {
  std::string head =
      fmt::format("HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: close\r\n",
                  response.status, reason_phrase(response.status), response.type, response.body.size());
  for (const auto& [name, value] : response.headers) head += fmt::format("{}: {}\r\n", name, value);
  head += "\r\n";
  if (mg_write(connection, head.data(), head.size()) > 0 && with_body && !response.body.empty()) {
    mg_write(connection, response.body.data(), response.body.size());
  }
}

/// Where the server listens, in the words of the system.
struct Address {
  sockaddr_storage storage{};
  socklen_t size = 0;
  [[nodiscard]] const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
};

std::optional<Address> address_of(const Listen& listen) {
  Address address;
  auto& four = reinterpret_cast<sockaddr_in&>(address.storage);
  auto& six = reinterpret_cast<sockaddr_in6&>(address.storage);
  const auto port = htons(static_cast<std::uint16_t>(listen.port));
  if (::inet_pton(AF_INET, listen.address.c_str(), &four.sin_addr) == 1) {
    four.sin_family = AF_INET;
    four.sin_port = port;
    address.size = sizeof four;
  } else if (::inet_pton(AF_INET6, listen.address.c_str(), &six.sin6_addr) == 1) {
    six.sin6_family = AF_INET6;
    six.sin6_port = port;
    address.size = sizeof six;
  } else {
    return std::nullopt;
  }
  return address;
}

/// Whether the place can be listened at: the system says in one word why not, which civetweb keeps to itself.
Status check_place(const Listen& listen) {
  const auto address = address_of(listen);
  if (!address) {
    return bad_input(
        fmt::format("'{}' is no address; give one of this machine, such as 0.0.0.0 for all", listen.address),
        "--listen");
  }
  const int socket = ::socket(address->storage.ss_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  const int bound = ::bind(socket, address->get(), address->size);
  const int why = bound == 0 && ::listen(socket, 1) == 0 ? 0 : errno;
  ::close(socket);
  if (why == 0) return {};
  if (why == EADDRINUSE) {
    return bad_input(
        fmt::format("the port {} is taken; give another, or 0 for one that is free", listen.port), "--port");
  }
  return bad_input(fmt::format("{}:{} cannot be listened at ({})", listen.address, listen.port,
                               std::generic_category().message(why)),
                   why == EACCES ? "--port" : "--listen");
}

/// Connects to a server and says nothing.
void knock(const Listen& listen) {
  const auto address = address_of(listen);
  const int socket = ::socket(address->storage.ss_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  ::connect(socket, address->get(), address->size);
  ::close(socket);
}

/// Ends the threads of civetweb. Its listener looks up every two seconds, or when somebody connects.
void stop(mg_context* context, const Listen& listen) {
  std::atomic<bool> stopped = false;
  std::thread visitor([&] {
    while (!stopped) {
      knock(listen);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  mg_stop(context);
  stopped = true;
  visitor.join();
}

class Civetweb : public WebServer {
 public:
  explicit Civetweb(App& app) : app_(app) {}
  ~Civetweb() override {
    app_.close();
    if (context_ != nullptr) stop(context_, {address_, port_});
  }
  [[nodiscard]] int port() const override { return port_; }

  Status listen(const Listen& listen) {
    address_ = listen.address;
    const bool six = listen.address.find(':') != std::string::npos;
    const std::string place =
        fmt::format("{}:{}", six ? "[" + listen.address + "]" : listen.address, listen.port);
    const std::string thread_count = std::to_string(threads);
    const std::array<const char*, 29> options = {"listening_ports",
                                                 place.c_str(),
                                                 "num_threads",
                                                 thread_count.c_str(),
                                                 "connection_queue",
                                                 "128",
                                                 "listen_backlog",
                                                 "256",
                                                 "request_timeout_ms",
                                                 "10000",
                                                 "websocket_timeout_ms",
                                                 "20000",
                                                 "enable_websocket_ping_pong",
                                                 "yes",
                                                 "max_request_size",
                                                 "16384",
                                                 "enable_keep_alive",
                                                 "no",
                                                 "tcp_nodelay",
                                                 "1",
                                                 "decode_url",
                                                 "no",
                                                 "enable_auth_domain_check",
                                                 "no",
                                                 "access_control_allow_origin",
                                                 "",
                                                 "access_control_allow_methods",
                                                 "",
                                                 nullptr};
    mg_callbacks callbacks{};
    callbacks.log_message = [](const mg_connection*, const char*) { return 1; };
    callbacks.http_error = [](mg_connection* connection, int status, const char*) {
      send(connection, error_response(status, "bad_input", "this is no HTTP request that can be answered"),
           true);
      return 0;
    };
    context_ = mg_start(&callbacks, this, const_cast<const char**>(options.data()));
    if (context_ == nullptr) return bad_input("the server could not start its threads; the system is full");
    mg_set_request_handler(context_, "**", on_request, this);
    mg_set_websocket_handler(context_, "/api/v1/live", on_connect, on_ready, on_data, on_close, this);
    mg_server_port taken{};
    if (mg_get_server_ports(context_, 1, &taken) == 1) port_ = taken.port;
    return {};
  }

 private:
  static int on_request(mg_connection* connection, void* self) {
    return static_cast<Civetweb*>(self)->answer(connection);
  }

  int answer(mg_connection* connection) {
    Request request = request_of(connection);
    const int refused = read_body(connection, request.body);
    const Response response = refused == 0 ? app_.answer(request)
                              : refused == 413
                                  ? error_response(413, "too_large", "a request has at most 32 MiB")
                                  : error_response(408, "bad_input", "the request did not come to its end");
    send(connection, response, request.method != "HEAD");
    if (refused != 0) mg_close_connection(connection);  // else civetweb waits for the rest of the body
    return response.status;
  }

  static int on_connect(const mg_connection* connection, void* self) {
    auto* server = static_cast<Civetweb*>(self);
    std::optional<Response> refused = server->app_.refuse_socket(request_of(connection));
    if (!refused && server->sockets_ >= most_sockets) {
      refused = error_response(503, "too_many", fmt::format("{} viewers watch already", most_sockets));
    }
    if (!refused) return 0;
    send(const_cast<mg_connection*>(connection), *refused, true);
    return 1;
  }

  static void on_ready(mg_connection* connection, void* self) {
    ++static_cast<Civetweb*>(self)->sockets_;
    auto* socket = new Socket;  // on_close() takes it back
    socket->viewer = static_cast<Civetweb*>(self)->app_.live().open();
    socket->writer = std::thread([viewer = socket->viewer, connection] {
      viewer->serve([connection](const std::string& text) {
        return mg_websocket_write(connection, MG_WEBSOCKET_OPCODE_TEXT, text.data(), text.size()) > 0;
      });
      // Whether the viewer or the server ends it, the other side is told.
      mg_websocket_write(connection, MG_WEBSOCKET_OPCODE_CONNECTION_CLOSE, "\x03\xe9", 2);
    });
    mg_set_user_connection_data(connection, socket);
  }

  /// 1 to go on, 0 to end the connection.
  static int on_data(mg_connection* connection, int bits, char* data, std::size_t size, void*) {
    auto* socket = static_cast<Socket*>(mg_get_user_connection_data(connection));
    const int opcode = bits & 0x0f;
    const bool last = (bits & 0x80) != 0;
    if (opcode == MG_WEBSOCKET_OPCODE_PING || opcode == MG_WEBSOCKET_OPCODE_PONG) return 1;
    const bool first = opcode == MG_WEBSOCKET_OPCODE_TEXT;
    if (socket == nullptr || (!first && opcode != MG_WEBSOCKET_OPCODE_CONTINUATION)) return 0;
    if (socket->partial.size() + size > largest_message_bytes) return 0;
    socket->partial.append(data, size);
    if (!last) return 1;
    if (!socket->rate.take(Clock::now())) return 0;
    const std::string text = std::exchange(socket->partial, {});
    return socket->viewer->receive(text) ? 1 : 0;
  }

  static void on_close(const mg_connection* connection, void* self) {
    auto* socket = static_cast<Socket*>(mg_get_user_connection_data(connection));
    --static_cast<Civetweb*>(self)->sockets_;
    if (socket == nullptr) return;
    mg_set_user_connection_data(connection, nullptr);
    socket->viewer->close();
    socket->writer.join();
    delete socket;
  }

  App& app_;
  mg_context* context_ = nullptr;
  std::string address_;
  int port_ = 0;
  std::atomic<int> sockets_{0};
};

}  // namespace

Outcome<std::unique_ptr<WebServer>> WebServer::start(App& app, const Listen& listen) {
  if (auto ok = check_place(listen); !ok) return pass_on(ok);
  mg_init_library(MG_FEATURES_DEFAULT);
  auto server = std::make_unique<Civetweb>(app);
  if (auto ok = server->listen(listen); !ok) return pass_on(ok);
  return std::unique_ptr<WebServer>(std::move(server));
}

}  // namespace outrider::server
