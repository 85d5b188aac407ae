#include "output/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "output/output.hpp"
#include "outrider/core/text.hpp"

namespace outrider::cli {

using Clock = std::chrono::steady_clock;

Progress::Progress(int steps) : steps_(steps), program_("OUTRIDER_PROGRESS") {
  if (::isatty(STDERR_FILENO) == 1) watcher_ = std::thread([this] { watch(); });
}

Progress::~Progress() { end(); }

void Progress::show(const RunStep& step) {
  if (step.number == done_ + 1 && step.name == step_) return part(step.part);
  {
    const std::lock_guard lock(mutex_);
    steps_ = step.steps;
    done_ = step.number - 2;
  }
  next(step.name);
}

void Progress::next(const std::string& step) {
  const std::lock_guard lock(mutex_);
  step_ = step;
  ++done_;
  part_ = 0.0;
  report();
}

void Progress::part(double done) {
  const std::lock_guard lock(mutex_);
  const bool hundredth = static_cast<int>(100.0 * done) != static_cast<int>(100.0 * part_);
  part_ = done;
  if (hundredth) report();
}

void Progress::report() const {
  if (!program_.is_there()) return;
  const nlohmann::ordered_json line = {
      {"step", done_ + 1}, {"steps", steps_}, {"name", step_}, {"part", std::round(100.0 * part_) / 100.0}};
  program_.send(json_text(line));
}

void Progress::end() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  ended_.notify_one();
  if (watcher_.joinable()) watcher_.join();
}

void Progress::watch() {
  constexpr int bar_width = 20;
  const auto begin = Clock::now();
  auto wake = begin + std::chrono::seconds(1);
  bool shown = false;
  std::unique_lock lock(mutex_);
  while (!ended_.wait_until(lock, wake, [this] { return over_; })) {
    const auto full = static_cast<std::size_t>(bar_width * (std::max(0, done_) + part_) / steps_);
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - begin).count();
    fmt::print(stderr, "\r\x1b[K[{:.<{}}] {}, {} s", std::string(full, '#'), bar_width, printable(step_),
               seconds);
    std::fflush(stderr);
    shown = true;
    wake += std::chrono::milliseconds(250);
  }
  if (shown) fmt::print(stderr, "\r\x1b[K");
}

}  // namespace outrider::cli
