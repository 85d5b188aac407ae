// Untrusted files are read in a separate process, which can open nothing outside their folder and has limits
// of memory and processor time. Scenarios name worlds, worlds include models, models name meshes: the server
// itself parses none of them, nor what it finds in its own folder of runs.
//
// A question and its answer are JSON. Paths in questions are relative to the folder:
//    {"kinds": [path, ...]}               -> {"kinds": [the result of file_kind(), ...]}
//    {"states": [id, ...]}                -> {"states": [state.json of that run, or null, ...]}
//    {"head": text, "name": name}         -> the result of scenario_head()
//    {"map": path}                        -> a packed map (maps.hpp)
//    {"scenario": path}                   -> the result of shown_scenario(), its map packed
//    {"scene": path}                      -> the result of scenario_scene()
//    {"yard": request, "save_as": path}   -> {"files": [{"path", "base64"}, ...]} of yard_files()
#pragma once

#include <chrono>
#include <functional>
#include <stop_token>
#include <string>

#include "fields.hpp"
#include "files/folder.hpp"
#include "outrider/job/job.hpp"

namespace outrider::server {

/// Answers a question. Call it in the process that may read the folder, which is its working folder. Faults:
/// bad_input on invalid input.
Outcome<Json> answer_reading(const Json& question, const Folder& folder, const std::vector<Job>& jobs);

/// Answers a question on behalf of the server by asking another process. Raising `stop` ends the reading.
using ReadFiles =
    std::function<Outcome<Json>(const Folder& folder, const Json& question, const std::stop_token& stop)>;

struct ReaderSettings {
  std::string tool;                                  ///< the program: `TOOL serve-reader`
  std::chrono::seconds limit{20};                    ///< of processor time, for one question
  std::size_t memory_bytes = std::size_t{1} << 30U;  ///< for one question
  int at_once = 2;                                   ///< questions at once; others wait
  int waiting = 16;                                  ///< questions that wait; more are refused
};

/// Asks `TOOL serve-reader`, confined to the folder. Faults: those of answer_reading(); budget_exhausted if
/// reading takes too much processor time or memory; cancelled if it was stopped, or too many others wait.
ReadFiles reading_in_a_child(const ReaderSettings& settings);

/// Runs `TOOL serve-reader`: reads a question from standard input and prints its answer. The current folder
/// is the served folder. Returns the exit status.
int serve_reader(const std::vector<Job>& jobs);

}  // namespace outrider::server
