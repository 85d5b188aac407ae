// The readers of single formats; open_log() chooses among them.
#pragma once

#include <memory>
#include <string>

#include "outrider/log/log_reader.hpp"

namespace outrider {

using LogOpened = Outcome<std::unique_ptr<LogReader>>;

}  // namespace outrider
