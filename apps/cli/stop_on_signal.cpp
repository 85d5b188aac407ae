#include "stop_on_signal.hpp"

#include <csignal>

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

}  // namespace outrider::cli
