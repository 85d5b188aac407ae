// A program that watches the tool. It sets an environment variable to the number of an open descriptor, and
// reads lines of JSON from it. It must keep reading, because the tool blocks until each line is written.
#pragma once

#include <string>

namespace outrider::cli {

class Watcher {
 public:
  /// Reads the variable. No program watches if it is not set to a descriptor above 2.
  explicit Watcher(const char* variable);

  [[nodiscard]] bool is_there() const { return descriptor_ >= 0; }
  /// Writes a line if a program watches. Ignores a program that has exited.
  void send(std::string line) const;

 private:
  int descriptor_ = -1;
};

}  // namespace outrider::cli
