#include "apart.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <new>

#include "core/base/error.h"

namespace pbrt {
namespace {

// The last byte of what the copy sends: without it, it did not come to its end.
constexpr char kReturned = 'r', kThrew = 't';

// Above what the process has already, as the shadow of a sanitizer is larger than any limit. Of
// memory that can be written to: address space alone is cheap, and threads reserve much of it.
void limitMemory() {
  rlim_t size = 0, resident = 0, shared = 0, text = 0, library = 0, data = 0;  // in pages
  std::ifstream("/proc/self/statm") >> size >> resident >> shared >> text >> library >> data;
  const rlim_t most = data * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + (rlim_t{4} << 30U);
  const rlimit memory{most, most}, core{0, 0};
  setrlimit(RLIMIT_DATA, &memory);
  setrlimit(RLIMIT_CORE, &core);
}

std::string outcome(const std::function<std::string()>& work) {
  try {
    return work() + kReturned;
  } catch (const std::bad_alloc&) {
    return std::string("asked for more than 4 GiB of memory") + kThrew;
  } catch (const std::exception& error) {
    return std::string("threw an exception: ") + error.what() + kThrew;
  } catch (...) {
    return std::string("threw what is no std::exception") + kThrew;
  }
}

[[noreturn]] void runCopy(const std::function<std::string()>& work, int to) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  limitMemory();
  dup2(STDERR_FILENO, STDOUT_FILENO);
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // so that whole lines outlive a crash
  const std::string text = outcome(work);
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = write(to, text.data() + sent, text.size() - sent);
    if (n <= 0) break;
    sent += static_cast<std::size_t>(n);
  }
  std::fflush(nullptr);
  _exit(0);
}

// Reads up to the end or to the deadline; false if that came first.
bool readAll(int from, double seconds, std::string& text) {
  using Clock = std::chrono::steady_clock;
  // No longer than the clock can count.
  const auto deadline = Clock::now() + std::chrono::duration<double>(std::min(seconds, 1e9));
  for (std::array<char, 4096> buffer{};;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
    if (left.count() <= 0) return false;
    pollfd ready{from, POLLIN, 0};
    if (poll(&ready, 1, static_cast<int>(std::min<long>(left.count(), 1'000'000))) <= 0) continue;
    const ssize_t n = read(from, buffer.data(), buffer.size());
    if (n <= 0) return true;
    text.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

}  // namespace

Ending runApart(const std::function<std::string()>& work, double seconds) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw Error("cannot make a pipe", Failure::io);
  std::fflush(nullptr);
  const pid_t copy = fork();
  if (copy < 0) throw Error("cannot make another process", Failure::io);
  if (copy == 0) runCopy(work, ends[1]);
  close(ends[1]);

  Ending ending;
  const bool inTime = readAll(ends[0], seconds, ending.text);
  close(ends[0]);
  if (!inTime) kill(copy, SIGKILL);
  int status = 0;
  waitpid(copy, &status, 0);

  const char last = ending.text.empty() ? '\0' : ending.text.back();
  ending.late = !inTime;
  if (!inTime)
    ending.mishap = fmt::format("did not end within {} s", seconds);
  else if (WIFSIGNALED(status))
    ending.mishap = fmt::format("crashed: {}", strsignal(WTERMSIG(status)));
  else if (last != kReturned && last != kThrew)
    ending.mishap = fmt::format("ended the process, with exit code {}", WEXITSTATUS(status));
  if (!ending.text.empty()) ending.text.pop_back();
  if (ending.mishap.empty() && last == kThrew) ending.mishap = ending.text;
  return ending;
}

}  // namespace pbrt
