#include "outrider/ros2/service.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace outrider {
namespace {

constexpr std::size_t encoding_bytes = 4, id_bytes = 16;
constexpr int at_once = 10;  // requests, so that the node acts in between

}  // namespace

std::optional<std::string> response_to(const std::string& request, const NodeService& service) {
  if (request.size() < encoding_bytes + id_bytes) return std::nullopt;
  const bool big_endian = request[1] == 0;
  std::string id = request.substr(encoding_bytes, id_bytes);
  if (big_endian) {  // responses are little endian
    std::reverse(id.begin(), id.begin() + 8);
    std::reverse(id.begin() + 8, id.end());
  }
  auto response =
      service.answer(request.substr(0, encoding_bytes) + request.substr(encoding_bytes + id_bytes));
  if (!response) return std::nullopt;
  return response->insert(encoding_bytes, id);
}

Outcome<RosService> RosService::open(RosNode& network, const std::string& node, NodeService service) {
  const std::string name = fmt::format("{}/{}", node, service.name);
  auto requests = network.request_reader(name, *service.request);
  if (!requests) return pass_on(requests);
  auto responses = network.reply_writer(name, *service.response);
  if (!responses) return pass_on(responses);
  return RosService(std::move(*requests), std::move(*responses), std::move(service));
}

void RosService::answer() {
  for (int i = 0; i < at_once; ++i) {
    const auto request = requests_.take_bytes();
    if (!request) return;
    if (const auto response = response_to(*request, service_))
      static_cast<void>(responses_.send_bytes(*response));
  }
}

}  // namespace outrider
