// A program that watches the tool: it sets an environment variable to the number of an open descriptor, and
// reads lines of JSON from there. It must go on reading: the tool waits until a line is written.
#pragma once

#include <string>

namespace outrider::cli {

class Watcher {
 public:
  /// Nobody watches where the variable is not set to a descriptor above 2.
  explicit Watcher(const char* variable);

  [[nodiscard]] bool is_there() const { return descriptor_ >= 0; }
  /// Writes a line, where somebody watches. Whoever has gone is told nothing.
  void send(std::string line) const;

 private:
  int descriptor_ = -1;
};

}  // namespace outrider::cli
