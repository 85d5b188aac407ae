// Messages of a WebSocket: what is not refused is answered in JSON, and the viewer comes to an end. An input
// is messages, one a line. The server knows the map 91d45309249ba44a and a run that waits, @RUN@.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "fuzz_entry.hpp"
#include "served_yard.hpp"

namespace {

using outrider::server::App;
using outrider::server::Request;

constexpr const char* last_message = R"({"type": "ping", "id": 999999999999})";
constexpr const char* last_reply = R"({"type":"pong","id":999999999999})";

std::string post(App& app, const std::string& path, const std::string& body) {
  Request request{"POST", path, "", {{"host", "127.0.0.1:8080"}, {"content-type", "application/json"}}, body};
  const auto response = app.answer(request);
  if (response.status > 299) std::abort();
  return nlohmann::json::parse(response.body)["id"];
}

/// Gives the viewer the messages as far as it takes them. False when it ends the connection.
bool receive_all(outrider::server::Viewer& viewer, std::string_view input, const std::string& run) {
  while (!input.empty()) {
    const std::size_t end = std::min(input.find('\n'), input.size());
    std::string message(input.substr(0, end));
    if (const std::size_t at = message.find("@RUN@"); at != std::string::npos) message.replace(at, 5, run);
    if (!viewer.receive(message)) return false;
    input.remove_prefix(std::min(end + 1, input.size()));
  }
  return viewer.receive(last_message);
}

}  // namespace

extern "C" int FUZZ_ENTRY(messages)(const std::uint8_t* data, std::size_t size) {
  static const outrider::fuzzing::ServedYard yard;
  App app = yard.app();
  post(app, "/api/v1/maps",
       R"({"grid": {"resolution_m": 1, "width": 4, "height": 3, "runs": [0, 5, 1, 2, 0, 5]}})");
  const std::string run = post(app, "/api/v1/runs", R"({"scenario": "yard.yaml"})");
  const auto viewer = app.live().open();
  if (!receive_all(*viewer, {reinterpret_cast<const char*>(data), size}, run)) return 0;
  bool ended = false;
  viewer->serve([&](outrider::server::FrameKind kind, const std::string& message) {
    if (kind != outrider::server::FrameKind::text) return true;  // bytes of a log
    const auto json = nlohmann::json::parse(message, nullptr, false);
    if (!json.is_object() || !json.contains("type")) std::abort();
    if (message.find("this is a bug") != std::string::npos) std::abort();
    ended = ended || message == last_reply;
    if (ended && json["type"] == "pong") viewer->close();  // a plan that was asked for is still made
    return true;
  });
  if (!ended) std::abort();
  return 0;
}
