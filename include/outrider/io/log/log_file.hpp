// Log files of robots: MCAP, ROS 1 bags, ROS 2 db3. Opens them as all files are opened, within the
// confinement.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "outrider/log/log_reader.hpp"
#include "outrider/log/mcap/mcap_writer.hpp"

namespace outrider {

/// Returns true if the path is a log by its content, or a folder: of rosbag2, or of a run with run.mcap in
/// it. False, if it cannot be read.
bool is_log_file(const std::string& path);

/// Opens a log. A folder of a run is its run.mcap. A confined process opens MCAP and ROS 1 bags only. Fault:
/// bad_input.
Outcome<std::unique_ptr<LogReader>> open_log_file(const std::string& path,
                                                  const LogSelection& selection = {});

/// Creates or replaces a file: `write` gets the name PATH.part, and only when it is done has the file its
/// name. If `write` or the system fails, the part is removed and the file at the path stays. Fault: that of
/// `write`; cannot_write.
Status write_under_part_name(const std::string& path,
                             const std::function<Status(const std::string& part)>& write);

/// Creates or replaces an MCAP file, in this way, with what `fill` writes. Fault:
/// that of `fill`; cannot_write.
Status write_log_file(const std::string& path, const std::function<Status(McapWriter&)>& fill);

}  // namespace outrider
