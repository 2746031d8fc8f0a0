// How many threads of the command work, from its start to its end, and that this changes no bit.

#include <fmt/format.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <thread>
#include <vector>

#include "core/base/image.h"
#include "tests/command.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;

// A tree that takes a while to build, and lights, glass and a filter to render.
std::string hills(int size) {
  std::string heights;
  for (int i = 0; i < size * size; ++i) heights += fmt::format("{} ", 0.1 * (i * 7919 % 101) / 101);
  return fmt::format(R"(LookAt 0.5 -1.5 2  0.5 0.5 0  0 0 1
Camera "perspective" "float fov" 40
Film "image" "integer xresolution" 200 "integer yresolution" 150 "string filename" "hills.exr"
PixelFilter "gaussian"
Sampler "random" "integer pixelsamples" 4
SurfaceIntegrator "path"
WorldBegin
LightSource "point" "point from" [0 -1 3] "rgb I" [9 9 9]
Material "plastic"
Shape "heightfield" "integer nu" {0} "integer nv" {0} "float Pz" [{1}]
Material "glass"
Translate 0.5 0.5 0.4
Shape "sphere" "float radius" 0.2
WorldEnd
)",
                     size, heights);
}

// Runs a program and looks at the times of its threads until it ends: of each, the nanoseconds that
// it ran.
std::map<std::string, double> threadTimes(const Folder& folder,
                                          const std::vector<std::string>& words) {
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(folder.path().c_str()) != 0) _exit(126);
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  std::map<std::string, double> times;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    std::error_code gone;
    for (const auto& task : fs::directory_iterator(fmt::format("/proc/{}/task", child), gone)) {
      double nanoseconds = 0;
      if (std::ifstream(task.path() / "schedstat") >> nanoseconds)
        times[task.path().filename()] = nanoseconds;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_EQ(status, 0);
  return times;
}

class Threads : public testing::Test {
 protected:
  // How many threads ran for long; the one that tells of the progress sleeps.
  int working(const std::vector<std::string>& words) const {
    const auto times = threadTimes(folder, words);
    double all = 0;
    for (const auto& [task, time] : times) all += time;
    return static_cast<int>(
        std::ranges::count_if(times, [&](const auto& t) { return t.second > 0.02 * all; }));
  }
  // The first core that this process may use.
  static int core() {
    cpu_set_t mask;
    EXPECT_EQ(sched_getaffinity(0, sizeof mask, &mask), 0);
    int core = 0;
    while (!CPU_ISSET(core, &mask)) ++core;
    return core;
  }
  Image render(const std::string& before, const std::string& arguments) const {
    const Outcome outcome = folder.command(fmt::format(
        "{} {} --quiet --outfile a.exr {} scene.pbrt", before, Folder::program(), arguments));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return readExr(folder.path() / "a.exr");
  }

  Folder folder;
};

// From reading to writing. That all get their share is up to the system; that as many render as are
// asked for is a test of core/scene.
TEST_F(Threads, NoMoreWorkThanAreAskedFor) {
  folder.write("scene.pbrt", hills(150));
  for (const int n : {1, 3, 7}) {
    const int found = working({Folder::program(), "--quiet", "--spp", "32", "--nthreads",
                               std::to_string(n), "scene.pbrt"});
    EXPECT_LE(found, n);
    EXPECT_GE(found, std::min(n, 2));
  }
}

TEST_F(Threads, OnOneCoreOneWorks) {
  folder.write("scene.pbrt", hills(150));
  std::vector<std::string> bound{
      "taskset", "-c",        std::to_string(core()), Folder::program(), "--quiet", "--spp",
      "32",      "scene.pbrt"};
  EXPECT_EQ(working(bound), 1);
  bound.insert(bound.end(), {"--nthreads", "3"});
  EXPECT_GE(working(bound), 2) << "what is asked for counts";
}

TEST_F(Threads, ChangeNoBit) {
  folder.write("scene.pbrt", hills(40));
  const Image one = render("", "--nthreads 1");
  for (const int n : {2, 3, 7, 64})
    EXPECT_EQ(one.channels, render("", fmt::format("--nthreads {}", n)).channels) << n;
  EXPECT_EQ(one.channels, render(fmt::format("taskset -c {}", core()), "").channels);
}

}  // namespace
}  // namespace pbrt::test
