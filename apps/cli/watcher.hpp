// A program that watches the tool. It sets an environment variable to the number of an open descriptor, and
// reads lines of JSON from it. It must keep reading, because the tool blocks until each line is written.
#pragma once

#include <string>

namespace outrider::cli {

/// Returns the descriptor that a variable of the environment names, for a program that watches; -1 if it does
/// not name one above 2. From then on, writing to a pipe that nobody reads is a fault and no signal.
int watched_descriptor(const char* variable);

class Watcher {
 public:
  /// Reads the variable. No program watches if it is not set to a descriptor above 2.
  explicit Watcher(const char* variable) : descriptor_(watched_descriptor(variable)) {}

  [[nodiscard]] bool is_there() const { return descriptor_ >= 0; }
  /// Writes a line if a program watches. Ignores a program that has exited.
  void send(std::string line) const;

 private:
  int descriptor_;
};

}  // namespace outrider::cli
