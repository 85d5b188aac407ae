// The attachments of an MCAP file that any source holds.
#pragma once

#include <vector>

#include "bytes/byte_source.hpp"
#include "outrider/log/mcap/mcap_file.hpp"

namespace outrider {

Outcome<std::vector<LogAttachment>> read_attachments(const ByteSource& source);

}  // namespace outrider
