// ReadRecord: which files the process reads, so that their content can be recorded beside a result.
//
//   ReadRecord record;
//   task.load();
//   record.paths()  // the scenario's world, its models, their meshes, ...
//
// Thread rule: one record at a time in a process; files may be read by any thread meanwhile.
#pragma once

#include <set>
#include <string>

namespace outrider {

/// Notes every file that is opened through read_file() and the readers of logs during its lifetime.
class ReadRecord {
 public:
  ReadRecord();
  ~ReadRecord();
  ReadRecord(const ReadRecord&) = delete;
  ReadRecord& operator=(const ReadRecord&) = delete;

  /// Returns the paths so far, as they were opened.
  [[nodiscard]] std::set<std::string> paths() const;
};

}  // namespace outrider
