#include "outrider/ros2/run_node.hpp"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "node_clock.hpp"
#include "outrider/job/clock.hpp"
#include "outrider/ros2/names.hpp"
#include "outrider/ros2/service.hpp"

namespace outrider {
namespace {

using namespace std::chrono_literals;

constexpr auto pause = 1ms;
constexpr double farewell_s = 1.0;

/// A message that came, and the index of its topic.
struct Arrival {
  std::size_t input = 0;
  std::string bytes;
};

/// The ends of the topics of a node.
struct Wiring {
  std::vector<RosReader> readers;
  std::vector<FaultyLink<Arrival>> links;
  std::vector<RosWriter> writers;
};

/// Adds the writers of outputs that have none yet.
Status wire_outputs(Wiring& wiring, RosNode& network, const Node& node, const TopicNames& names) {
  while (wiring.writers.size() < node.outputs().size()) {
    const NodeTopic& topic = node.outputs()[wiring.writers.size()];
    auto name = names.name_of(topic.name);
    if (!name) return pass_on(name);
    auto writer = network.writer(*name, *topic.type, topic.delivery);
    if (!writer) return pass_on(writer);
    wiring.writers.push_back(std::move(*writer));
  }
  return {};
}

Outcome<Wiring> wire(RosNode& network, const Node& node, const TopicNames& names,
                     const MessageFaults& faults) {
  Wiring wiring;
  const Rng rng = Rng(1).child(node.name());
  for (const NodeTopic& topic : node.inputs()) {
    auto name = names.name_of(topic.name);
    if (!name) return pass_on(name);
    auto reader = network.reader(*name, *topic.type, topic.delivery);
    if (!reader) return pass_on(reader);
    // A message that is sent once is not lost: DDS sends it again.
    const bool once = topic.delivery == Delivery::fixed;
    wiring.links.emplace_back(once ? MessageFaults{} : faults, rng.child(wiring.readers.size()));
    wiring.readers.push_back(std::move(*reader));
  }
  if (auto ok = wire_outputs(wiring, network, node, names); !ok) return pass_on(ok);
  return wiring;
}

void take_all(Node& node, Wiring& wiring, double time_s) {
  for (std::size_t i = 0; i < wiring.readers.size(); ++i) {
    while (auto bytes = wiring.readers[i].take_bytes()) wiring.links[i].push(time_s, {i, std::move(*bytes)});
    while (const auto arrival = wiring.links[i].take(time_s))
      node.receive(arrival->input, arrival->bytes, time_s);
  }
}

Status send_all(Node& node, Wiring& wiring, const HearNode& hear) {
  for (const NodeEvent& event : node.take_events()) hear(event);
  for (const NodeOutput& output : node.take_outputs()) {
    auto sent = wiring.writers[output.topic].send_bytes(output.bytes);
    // A reader that does not keep up is not waited for: the message is lost to it.
    if (!sent && sent.error().code != FaultCode::cannot_write) return sent;
  }
  return {};
}

Outcome<std::vector<RosService>> parameter_services(RosNode& network, const RosNamespace& as,
                                                    const std::vector<OptionGroup>& parameters) {
  std::vector<RosService> services;
  const auto node = resolve_topic(as.node, as);
  if (!node) return pass_on(node);
  for (NodeService& service : NodeParameters(parameters).services()) {
    auto opened = RosService::open(network, *node, std::move(service));
    if (!opened) return pass_on(opened);
    services.push_back(std::move(*opened));
  }
  return services;
}

}  // namespace

Status run_node(Node& node, const RunNodeOptions& options, const std::stop_token& stop,
                const HearNode& hear) {
  auto space = resolve_namespace(options.space);
  if (!space) return pass_on(space);
  const RosNamespace as{*space, node.name()};
  const auto names = TopicNames::of(as, options.renames);
  if (!names) return pass_on(names);
  auto network = RosNode::open(options.network);
  if (!network) return pass_on(network);
  auto wiring = wire(*network, node, *names, options.faults);
  if (!wiring) return pass_on(wiring);
  auto clock = RunClock::of(*network, options);
  if (!clock) return pass_on(clock);
  auto services = parameter_services(*network, as, options.parameters);
  if (!services) return pass_on(services);
  if (auto ok = network->announce(as); !ok) return ok;
  std::optional<double> due_s;
  std::optional<double> over_wall_s;
  while (!stop.stop_requested()) {
    if (node.is_over() && !over_wall_s) over_wall_s = wall_s();
    if (over_wall_s && wall_s() - *over_wall_s > farewell_s) break;
    for (RosService& service : *services) service.answer();
    if (const auto why = clock->silent()) hear({0.0, NodeLevel::warning, *why});
    const auto now_s = clock->now(node.period_s());
    if (now_s) {
      take_all(node, *wiring, *now_s);
      const bool back = due_s && *due_s > *now_s + 2.0 * node.period_s();
      if (!due_s || *now_s + 1e-9 >= *due_s || back) {
        node.tick(*now_s);
        due_s = *now_s + node.period_s();
      }
      if (wiring->writers.size() < node.outputs().size()) {
        if (auto ok = wire_outputs(*wiring, *network, node, *names); !ok) return ok;
        if (auto ok = network->announce(as); !ok) return ok;
      }
      if (auto ok = send_all(node, *wiring, hear); !ok) return ok;
    }
    std::this_thread::sleep_for(pause);
  }
  return {};
}

}  // namespace outrider
