// Log files of robots: MCAP, ROS 1 bags, ROS 2 db3. Opens them as all files are opened, within the
// confinement.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "outrider/log/log_reader.hpp"
#include "outrider/log/mcap_writer.hpp"

namespace outrider {

/// Returns true if the path is a log by its content, or a folder: of rosbag2, or of a run with run.mcap in
/// it. False, if it cannot be read.
bool is_log_file(const std::string& path);

/// Opens a log. A folder of a run is its run.mcap. A confined process opens MCAP and ROS 1 bags only. Fault:
/// bad_input.
Outcome<std::unique_ptr<LogReader>> open_log_file(const std::string& path,
                                                  const LogSelection& selection = {});

/// Creates or replaces an MCAP file with what `fill` writes. Until it is complete it has the name PATH.part;
/// if `fill` or the system fails, that is removed and the file at the path stays. Fault: that of `fill`;
/// cannot_write.
Status write_log_file(const std::string& path, const std::function<Status(McapWriter&)>& fill);

}  // namespace outrider
