#include "core/base/signal_stack.h"

#include <csignal>
#include <memory>

namespace pbrt {

namespace {

class SignalStack {
 public:
  SignalStack() {
    stack_t now{};
    if (sigaltstack(nullptr, &now) != 0 || !(now.ss_flags & SS_DISABLE)) return;  // it has one
    memory_ = std::make_unique_for_overwrite<char[]>(kSize);
    const stack_t mine{memory_.get(), 0, kSize};
    sigaltstack(&mine, nullptr);
  }
  ~SignalStack() {
    const stack_t none{nullptr, SS_DISABLE, 0};
    if (memory_) sigaltstack(&none, nullptr);
  }
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;

 private:
  static constexpr std::size_t kSize = 1 << 16;  // walking up a stack takes some

  std::unique_ptr<char[]> memory_;
};

}  // namespace

void provideSignalStack() {
  thread_local const SignalStack stack;
  static_cast<void>(stack);
}

}  // namespace pbrt
