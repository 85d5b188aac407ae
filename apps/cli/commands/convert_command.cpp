#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "flags.hpp"
#include "output/output.hpp"
#include "output/terminal.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/io/log/log_export.hpp"
#include "outrider/io/log/log_file.hpp"
#include "outrider/io/log/log_trajectory.hpp"
#include "outrider/log/copy_log.hpp"

namespace outrider::cli {
namespace {

struct ConvertCommand {
  std::string in;
  std::string out;
  std::string topic;
  bool json = false;
};

OptionGroup describe(ConvertCommand& command) {
  return {"",
          "output",
          {{"json", "", 0, 0, "print one JSON object on standard output", &command.json},
           {"topic", "", 0, 0, "topic that is converted; needed for poses if the log has several",
            &command.topic}}};
}

/// The result of a conversion.
struct Converted {
  std::string what;  ///< "messages" or "poses"
  std::size_t count = 0;
  std::vector<std::string> warnings = {};
};

/// Returns the number of words of the first line that is no comment.
std::size_t words_of_first_line(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = take_line(text);
    const auto all = words(line.substr(0, line.find('#')));
    if (!all.empty()) return all.size();
  }
  return 0;
}

/// Reads a trajectory from a log, or from a text, whose lines say its format.
Outcome<Trajectory> load_trajectory(const ConvertCommand& command) {
  if (is_log_file(command.in)) return trajectory_from_log(command.in, command.topic);
  const auto text = read_file(command.in);
  if (!text) return pass_on(text);
  const std::size_t count = words_of_first_line(*text);
  if (count == 8) return trajectory_from_tum(*text, command.in);
  if (count == 12) return trajectory_from_kitti(*text, command.in);
  return bad_input("it is neither a log nor a trajectory, with 8 numbers in a line (TUM) or 12 (KITTI)",
                   command.in);
}

/// Opens the log that is converted, with the topic that was asked for, or all.
Outcome<std::unique_ptr<LogReader>> open_input(const ConvertCommand& command) {
  LogSelection selection;
  if (!command.topic.empty()) selection.topics = {command.topic};
  auto reader = open_log_file(command.in, selection);
  if (!reader || command.topic.empty()) return reader;
  const auto& channels = (*reader)->channels();
  if (std::ranges::find(channels, command.topic, &Channel::topic) != channels.end()) return reader;
  std::vector<std::string_view> topics(channels.size());
  std::ranges::transform(channels, topics.begin(), &Channel::topic);
  return bad_input(fmt::format("there is no topic '{}'; the topics are {}", excerpt(command.topic),
                               excerpt(fmt::format("{}", fmt::join(topics, ", ")), 200)),
                   command.in);
}

Outcome<Converted> copy_messages(const ConvertCommand& command, McapWriter& writer,
                                 const std::stop_token& stop) {
  auto reader = open_input(command);
  if (!reader) return pass_on(reader);
  auto copy = copy_log(**reader, writer, [&](double) { return !stop.stop_requested(); });
  if (!copy) return pass_on(copy);
  Converted converted{"messages", copy->messages};
  for (const std::string& topic : copy->kept_ros1) {
    converted.warnings.push_back(
        fmt::format("{} has no schema, so its messages stay in ROS 1 bytes", excerpt(topic)));
  }
  if (const auto cut = (*reader)->cut_short(); !cut.empty()) converted.warnings.push_back(cut);
  return converted;
}

Outcome<Converted> copy_poses(const ConvertCommand& command, McapWriter& writer) {
  const auto trajectory = load_trajectory(command);
  if (!trajectory) return pass_on(trajectory);
  const std::string topic = command.topic.empty() ? "/pose" : command.topic;
  if (auto ok = write_trajectory(*trajectory, writer, topic); !ok) return pass_on(ok);
  return Converted{"poses", trajectory->size()};
}

Outcome<Converted> convert_to_log(const ConvertCommand& command, const std::stop_token& stop) {
  Outcome<Converted> converted;
  auto done = write_log_file(command.out, [&](McapWriter& writer) -> Status {
    converted = is_log_file(command.in) ? copy_messages(command, writer, stop) : copy_poses(command, writer);
    if (!converted) return pass_on(converted);
    return {};
  });
  if (!done) return pass_on(done);
  return converted;
}

/// Writes the messages of a log as JSON lines or as numpy arrays.
Outcome<Converted> export_messages(const ConvertCommand& command, const std::stop_token& stop,
                                   decltype(write_numpy)& write) {
  if (!is_log_file(command.in)) return bad_input("it is not a log: MCAP, ROS 1 bag or ROS 2 db3", command.in);
  auto reader = open_input(command);
  if (!reader) return pass_on(reader);
  const auto done = write(**reader, command.out, [&](double) { return !stop.stop_requested(); });
  if (!done) return pass_on(done);
  Converted converted{"messages", done->messages};
  for (const std::string& channel : done->left_out)
    converted.warnings.push_back(fmt::format("{} is left out; the type is not known", excerpt(channel)));
  if (const auto cut = (*reader)->cut_short(); !cut.empty()) converted.warnings.push_back(cut);
  return converted;
}

Outcome<Converted> convert_to_text(const ConvertCommand& command, std::string (*text_of)(const Trajectory&)) {
  const auto trajectory = load_trajectory(command);
  if (!trajectory) return pass_on(trajectory);
  if (auto ok = write_file(command.out, text_of(*trajectory)); !ok) return pass_on(ok);
  return Converted{"poses", trajectory->size()};
}

Outcome<Converted> convert(const ConvertCommand& command, const std::stop_token& stop) {
  const std::string ending = std::filesystem::path(command.out).extension().string();
  if (ending == ".mcap") return convert_to_log(command, stop);
  if (ending == ".tum") return convert_to_text(command, tum_text);
  if (ending == ".kitti") return convert_to_text(command, kitti_text);
  if (ending == ".jsonl") return export_messages(command, stop, write_json_lines);
  if (ending == ".npz") return export_messages(command, stop, write_numpy);
  return bad_input(
      fmt::format("'{}' does not say what to write; end it in .mcap, .jsonl, .npz, .tum or .kitti",
                  excerpt(command.out)),
      "out");
}

int execute(ConvertCommand& command, const Command& flags, const std::stop_token& stop) {
  const bool json = flags.given("--json");
  if (auto ok = apply_flags(flags, {describe(command)}); !ok) return print_fault(ok.error(), json);
  const auto converted = convert(command, stop);
  if (!converted) return print_fault(converted.error(), json);
  warn(converted->warnings);
  if (json) {
    print({{"status", "done"},
           {converted->what, converted->count},
           {"files", {{"converted", command.out}}},
           {"warnings", converted->warnings}});
  } else {
    show("{} {} to {}\n", converted->count, converted->what, command.out);
  }
  return job_done;
}

}  // namespace

void add_convert(Command& tool, const std::stop_token& stop) {
  Command& convert = tool.add(
      "convert",
      "write a log as MCAP, JSON lines or numpy arrays, or its trajectory as TUM or KITTI, and back");
  auto command = std::make_shared<ConvertCommand>();
  convert
      .positional("in", &command->in,
                  "MCAP, ROS 1 bag, ROS 2 db3, folder of one or of a run; or a trajectory")
      .required()
      .type("FILE");
  convert
      .positional("out", &command->out,
                  "file to write; its ending says how: .mcap, .jsonl, .npz, .tum or .kitti")
      .required()
      .type("FILE");
  add_flags(convert, {describe(*command)});
  convert.does([command, stop](const Command& flags) { return execute(*command, flags, stop); });
  convert.footer("\nExample: outrider convert run.bag run.mcap");
}

}  // namespace outrider::cli
