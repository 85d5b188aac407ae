// HTTP requests, several to one server: each is answered, never by a bug, and never with what lies outside of
// the folder. An input is requests as they are sent, with lines "====" between them; @RUN@ in a path stands
// for the mission that was started last.
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "fuzz_entry.hpp"
#include "served_yard.hpp"

namespace {

using outrider::server::Request;
using outrider::server::Response;

/// Takes the text before the separator; the rest stays.
std::string_view take(std::string_view& text, std::string_view separator) {
  const std::size_t at = text.find(separator);
  const std::string_view part = text.substr(0, at);
  text.remove_prefix(at == std::string_view::npos ? text.size() : at + separator.size());
  return part;
}

Request request_of(std::string_view text) {
  Request request;
  std::string_view line = take(text, "\n");
  request.method = take(line, " ");
  request.path = take(line, "?");
  request.query = line;
  while (!text.empty() && !(line = take(text, "\n")).empty()) {
    std::string name(take(line, ": "));
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    request.headers[name] = line;
  }
  request.body = text;
  return request;
}

void check(const Response& response) {
  if (response.status < 200 || response.status > 599 || response.status == 500) std::abort();
  const std::string sent = response.file ? response.file->part(0, response.file->bytes()) : response.body;
  if (sent.find(outrider::fuzzing::secret) != std::string::npos) std::abort();
  if (response.type != "application/json" || response.status < 400) return;
  const auto error = nlohmann::json::parse(response.body, nullptr, false);
  if (!error.is_object() || !error.contains("error") || error["error"].empty()) std::abort();
}

}  // namespace

extern "C" int FUZZ_ENTRY(http)(const std::uint8_t* data, std::size_t size) {
  static outrider::fuzzing::ServedYard yard;
  std::string_view input(reinterpret_cast<const char*>(data), size);
  if (input.find(outrider::fuzzing::secret) != std::string_view::npos) return 0;  // it would be echoed
  outrider::server::App app = yard.app();
  bool writes = false;
  std::string run;
  for (int i = 0; i < 8 && !input.empty(); ++i) {
    Request request = request_of(take(input, "\n====\n"));
    if (const std::size_t at = request.path.find("@RUN@"); at != std::string::npos) {
      request.path.replace(at, 5, run);
    }
    writes = writes || request.method == "PUT";
    const Response response = app.answer(request);
    check(response);
    if (response.status == 202) run = nlohmann::json::parse(response.body)["id"];
  }
  if (writes) yard.reset();
  return 0;
}
