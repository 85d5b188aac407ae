#include "stop_on_signal.hpp"

#include <chrono>
#include <csignal>
#include <ctime>
#include <utility>

namespace outrider::cli {
namespace {

/// Returns the signals that stop a run, and SIGUSR2, with which the destructor wakes the waiting thread.
sigset_t awaited() {
  sigset_t set;
  ::sigemptyset(&set);
  for (const int number : {SIGINT, SIGTERM, SIGXCPU, SIGUSR2}) ::sigaddset(&set, number);
  return set;
}

}  // namespace

StopOnSignal::StopOnSignal() {
  const sigset_t set = awaited();
  ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
  waiter_ = std::thread([this] { wait(); });
}

StopOnSignal::~StopOnSignal() {
  ::pthread_kill(waiter_.native_handle(), SIGUSR2);
  waiter_.join();
}

void StopOnSignal::wait() {
  const sigset_t set = awaited();
  for (int number = 0; ::sigwait(&set, &number) == 0 && number != SIGUSR2;) {
    if (source_.request_stop()) continue;
    std::signal(number, SIG_DFL);
    ::pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
    ::raise(number);
  }
}

HardStop::HardStop(std::stop_token stop, std::function<void()> leave)
    : watcher_([this, stop = std::move(stop), leave = std::move(leave)] { watch(stop, leave); }) {}

HardStop::~HardStop() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  watcher_.join();
}

void HardStop::watch(const std::stop_token& stop, const std::function<void()>& leave) {
  using std::chrono::steady_clock;
  constexpr std::clock_t most_work = CLOCKS_PER_SEC / 10 * 7;  // by all threads; other programs do not count
  constexpr auto least_time = std::chrono::milliseconds(400), period = std::chrono::milliseconds(20);
  const auto is_over = [this] { return over_; };
  std::unique_lock lock(mutex_);
  if (changed_.wait(lock, stop, is_over)) return;
  const auto began = steady_clock::now();
  const std::clock_t worked = std::clock();
  while (!changed_.wait_for(lock, period, is_over)) {
    if (std::clock() - worked >= most_work && steady_clock::now() - began >= least_time) leave();
  }
}

}  // namespace outrider::cli
