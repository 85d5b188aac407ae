// Files of strangers are read in a process of their own, which can open nothing outside their folder and
// takes no more memory and time than it is allowed. Scenarios name worlds, worlds include models, models name
// meshes: none of that is parsed by the server itself.
//
// A question and its answer are JSON. In questions, paths are relative to the folder:
//   {"map": path}                        -> a packed map (maps.hpp)
//   {"scenario": path}                   -> what shown_scenario() gives, its map packed
//   {"yard": request, "save_as": path}   -> {"files": [{"path", "base64"}, ...]} of yard_files()
#pragma once

#include <chrono>
#include <functional>
#include <stop_token>
#include <string>

#include "fields.hpp"
#include "folder.hpp"

namespace outrider::server {

/// Answers a question, in the process that may read the folder. Faults: bad_input on what is wrong.
Outcome<Json> answer_reading(const Json& question, const Folder& folder);

/// The same from the side of the server: somebody else reads. Raising `stop` ends the reading.
using ReadFiles =
    std::function<Outcome<Json>(const Folder& folder, const Json& question, const std::stop_token& stop)>;

struct ReaderSettings {
  std::string tool;                                  ///< the program: `TOOL serve-reader`
  std::chrono::seconds limit{20};                    ///< for one question
  std::size_t memory_bytes = std::size_t{1} << 30U;  ///< for one question
  int at_once = 2;                                   ///< questions; others wait
  std::chrono::seconds longest_wait{10};             ///< of these; then they are refused
};

/// Asks `TOOL serve-reader`, confined to the folder. Faults: those of answer_reading(); budget_exhausted when
/// reading takes too long, too much memory, or too many others are reading; cancelled.
ReadFiles reading_in_a_child(const ReaderSettings& settings);

/// What `TOOL serve-reader` does: a question on standard input, its answer on standard output. The working
/// folder is the folder. Returns the exit status.
int serve_reader();

}  // namespace outrider::server
