#pragma once
// Work that goes on beside the frames: files are packed and written while the next are made.

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace pbrt {

// Does one piece of work after the other on a thread of its own.
class Writer {
 public:
  Writer();
  // Does what still waits.
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  // Waits while two others wait. Throws what an earlier one threw; then nothing more is done.
  void put(std::function<void()> work);
  // Waits until all is done. Throws as put() does.
  void finish();

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  bool busy_ = false, ended_ = false;
  std::exception_ptr failed_;
  std::thread thread_;
};

}  // namespace pbrt
