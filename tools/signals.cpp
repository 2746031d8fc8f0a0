#include "signals.h"

#include <sys/time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>

namespace pbrt {

namespace {

// What handlers write to. Only atomics without locks are safe there (POSIX.1-2017, 2.4.3).
std::atomic<std::atomic<bool>*> stopFlag{nullptr};
std::atomic<bool> requestFlag{false}, interruptedFlag{false};
static_assert(std::atomic<bool>::is_always_lock_free);

// The reason before `stop`: who sees the one sees the other.
void handle(int signal) {
  if (signal == SIGUSR1)
    requestFlag = true;
  else if (signal != SIGALRM)
    interruptedFlag = true;
  if (std::atomic<bool>* const stop = stopFlag) *stop = true;
}

constexpr std::array kInterruptions{SIGINT, SIGTERM, SIGHUP};
std::array<struct sigaction, kInterruptions.size()> before;
bool caught = false;

void install(int signal, int flags) {
  struct sigaction action {};
  action.sa_handler = handle;
  action.sa_flags = SA_RESTART | flags;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

}  // namespace

Signals::Signals(std::atomic<bool>& stop) {
  interruptedFlag = false;
  stopFlag = &stop;
  install(SIGUSR1, 0);
  install(SIGALRM, 0);
}

Signals::~Signals() {
  setTimer(INFINITY);
  for (std::size_t i = 0; i < before.size() && caught; ++i)
    sigaction(kInterruptions[i], &before[i], nullptr);
  caught = false;
  stopFlag = nullptr;
}

void Signals::catchInterruptions() {
  for (std::size_t i = 0; i < before.size(); ++i) {
    sigaction(kInterruptions[i], nullptr, &before[i]);
    const bool ignored = before[i].sa_handler == SIG_IGN;
    if (!ignored) install(kInterruptions[i], kInterruptions[i] == SIGINT ? SA_RESETHAND : 0);
  }
  caught = true;
}

void Signals::setTimer(double seconds) {
  itimerval timer{};
  if (std::isfinite(seconds)) {
    constexpr double kLongest = 1e8, kShortest = 1e-6;  // 0 would be none
    const double time = std::clamp(seconds, kShortest, kLongest);
    timer.it_value.tv_sec = static_cast<time_t>(time);
    timer.it_value.tv_usec = static_cast<suseconds_t>(std::fmod(time, 1.0) * 1e6);
    if (timer.it_value.tv_sec == 0 && timer.it_value.tv_usec == 0) timer.it_value.tv_usec = 1;
  }
  setitimer(ITIMER_REAL, &timer, nullptr);
}

bool Signals::takeRequest() {
  return requestFlag.exchange(false);
}
bool Signals::interrupted() {
  return interruptedFlag;
}

}  // namespace pbrt
