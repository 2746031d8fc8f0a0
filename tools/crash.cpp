#include "crash.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <csignal>
#include <cstring>
#include <string_view>

#include "core/base/signal_stack.h"
#include "core/plugin/stamp.h"
#include "core/scene/faults.h"

namespace pbrt {

namespace {

constexpr std::array kSignals = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

std::string_view nameOf(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "SIGSEGV: it used memory that is not its own, or all of its stack";
    case SIGBUS:
      return "SIGBUS: it used memory that is not there, or a file that was cut off";
    case SIGFPE:
      return "SIGFPE: it divided an integer by zero";
    case SIGILL:
      return "SIGILL: it was built for another processor, or is damaged";
    default:
      return "SIGABRT: it gave up";
  }
}

// Written in the main thread, read in the handler: two, so that one is always whole.
std::array<std::array<char, 501>, 2> advices;
std::atomic<const char*> advice = nullptr;

// A message that is put together and written without any help: what crashed may hold any lock.
class Message {
 public:
  Message& operator<<(std::string_view text) {
    const std::size_t n = std::min(text.size(), text_.size() - size_);
    std::memcpy(text_.data() + size_, text.data(), n);
    size_ += n;
    return *this;
  }
  Message& operator<<(std::int64_t number) {
    const auto end = std::to_chars(text_.data() + size_, text_.data() + text_.size(), number);
    if (end.ec == std::errc()) size_ = static_cast<std::size_t>(end.ptr - text_.data());
    return *this;
  }
  void write() const {
    for (std::size_t sent = 0; sent < size_;) {
      const ssize_t n = ::write(STDERR_FILENO, text_.data() + sent, size_ - sent);
      if (n <= 0) return;
      sent += static_cast<std::size_t>(n);
    }
  }

 private:
  std::array<char, 4096> text_;
  std::size_t size_ = 0;
};

void sayWhere(Message& message) {
  const SamplePlace& at = currentSample;
  const Location making = Making::current();
  if (at.block > 0) {
    message << (at.block > 1 ? " at a pixel of the block from (" : " at pixel (") << at.pixel.x
            << ", " << at.pixel.y << ")";
    message << ", sample " << at.sample;
  } else if (making.source) {
    const std::string& text = making.source->text;
    const std::size_t begin = std::min(making.begin, text.size());
    message << " while it made what " << making.source->name << ":"
            << std::count(text.data(), text.data() + begin, '\n') + 1 << " asks for";
  }
}

void tell(int signal) {
  static std::atomic_flag told;
  if (told.test_and_set()) {  // another thread crashed as well, and is telling
    for (int i = 0; i < 100; ++i) usleep(10'000);
    return;
  }
  const PluginCode* const plugin = pluginOnStack();
  Message message;
  message << "error: " << (plugin ? plugin->name : std::string_view("pbrt")) << " crashed";
  sayWhere(message);
  if (plugin) message << " (" << plugin->file << ")";
  message << "\n  " << nameOf(signal) << "\n";
  if (const char* text = advice) message << "  " << text << "\n";
  message.write();
}

// Ends as the system would have ended it, with a core file if it makes any.
void handle(int signal) {
  tell(signal);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void tellOfCrashes() {
  if (buildOptions() & (kAddressSanitizer | kThreadSanitizer | kMemorySanitizer)) return;
  provideSignalStack();
  static_cast<void>(pluginOnStack());  // loads what walks up the stack
  for (const int signal : kSignals) {
    struct sigaction action {};
    action.sa_handler = &handle;
    action.sa_flags = SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
}

void adviseAfterCrash(const std::string& text) {
  if (text.empty()) {
    advice = nullptr;
    return;
  }
  auto& spare = advice == advices[0].data() ? advices[1] : advices[0];
  spare[text.copy(spare.data(), spare.size() - 1)] = '\0';
  advice = spare.data();
}

}  // namespace pbrt
