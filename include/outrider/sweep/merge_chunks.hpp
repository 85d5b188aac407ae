// merge_chunks(): the chunks of a sweep to one table, FOLDER/table.csv.
#pragma once

#include <string>

#include "outrider/sweep/chunk_reader.hpp"

namespace outrider {

/// Writes the table of all runs, whose metrics are in the order in which the runs first have them, so it does
/// not depend on the size of chunks. Returns its SHA-256; empty if another process is writing it. Faults:
/// bad_input if a chunk is missing or damaged; cannot_write.
Outcome<std::string> merge_chunks(ChunkReader& chunks);

}  // namespace outrider
