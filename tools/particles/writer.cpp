#include "writer.h"

namespace pbrt {

Writer::Writer() : thread_([this] { run(); }) {}

Writer::~Writer() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Writer::put(std::function<void()> work) {
  constexpr std::size_t kMostWaiting = 2;
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return failed_ || waiting_.size() < kMostWaiting; });
  if (failed_) std::rethrow_exception(failed_);
  waiting_.push_back(std::move(work));
  changed_.notify_all();
}

void Writer::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return failed_ || (waiting_.empty() && !busy_); });
  if (failed_) std::rethrow_exception(failed_);
}

void Writer::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return ended_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const std::function<void()> work = std::move(waiting_.front());
    waiting_.pop_front();
    busy_ = true;
    lock.unlock();
    std::exception_ptr failed;
    try {
      work();
    } catch (...) {
      failed = std::current_exception();
    }
    lock.lock();
    busy_ = false;
    if (failed && !failed_) {
      failed_ = failed;
      waiting_.clear();
    }
    changed_.notify_all();
  }
}

}  // namespace pbrt
