#pragma once
// A pbrt command that runs beside the test, which sends it signals.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <sstream>
#include <thread>

#include "tests/command.h"

namespace pbrt::test {

// `pbrt ARGUMENTS` in a folder; the arguments are words with blanks in between. What it prints goes
// to the files "out" and "err" there.
class Running {
 public:
  Running(const Folder& folder, const std::string& arguments) : folder_(folder.path()) {
    std::vector<std::string> words{Folder::program()};
    std::istringstream in(arguments);
    for (std::string word; in >> word;) words.push_back(word);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const std::string out = folder_ / "out", err = folder_ / "err", path = folder_;
    id_ = fork();
    if (id_ != 0) return;
    alarm(120);  // nothing outlives the test for long
    const auto redirect = [](const std::string& file, int to) {
      dup2(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), to);
    };
    redirect(out, STDOUT_FILENO);
    redirect(err, STDERR_FILENO);
    if (chdir(path.c_str()) == 0) execv(argv[0], argv.data());
    _exit(127);
  }
  ~Running() {
    if (!ended_) send(SIGKILL).end();
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  Running& send(int signal) {
    kill(id_, signal);
    return *this;
  }
  // Waits until its handler of a signal stands; that of SIGTERM does once rendering begins.
  Running& untilItHandles(int signal) {
    return until([&] { return handles(signal); });
  }
  bool handles(int signal) const {
    const std::string caught = status("SigCgt:");  // a bit for each signal, from the lowest
    return !caught.empty() && (std::stoul(caught, nullptr, 16) >> (signal - 1) & 1) != 0;
  }
  // Waits until SIGSTOP has worked.
  Running& untilItStands() {
    return until([&] { return status("State:").find('T') != std::string::npos; });
  }
  // Waits until something holds, or it has ended.
  template <class Condition>
  Running& until(Condition condition) {
    using namespace std::chrono_literals;
    while (!condition() && !over()) std::this_thread::sleep_for(1ms);
    return *this;
  }
  Outcome end() {
    int status = 0;
    if (!ended_) waitpid(id_, &status, 0);
    ended_ = true;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            contents(folder_ / "out"), contents(folder_ / "err")};
  }

 private:
  bool over() const {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
           info.si_pid == id_;
  }
  // A line of what the system says of it. Empty: there is none.
  std::string status(const std::string& name) const {
    std::ifstream in("/proc/" + std::to_string(id_) + "/status");
    for (std::string line; std::getline(in, line);)
      if (line.starts_with(name)) return line.substr(name.size());
    return "";
  }

  std::filesystem::path folder_;
  pid_t id_ = 0;
  bool ended_ = false;
};

}  // namespace pbrt::test
