// The readers of single formats; open_log() chooses among them.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "outrider/log/log_reader.hpp"

namespace outrider {

using LogOpened = Outcome<std::unique_ptr<LogReader>>;

/// Returns true if a file that starts with these bytes (8 are enough) is MCAP.
bool is_mcap(std::string_view start);
LogOpened open_mcap(const std::string& path, const LogSelection& selection);

}  // namespace outrider
