#pragma once
// Small disks for tests of what happens when they are full or may not be written.

#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include "tests/command.h"

namespace pbrt::test {

// Whether this process may mount: it then does so where no other process sees it, and what it
// mounts goes with it. Users other than root are root of a space of their own for it.
inline bool mayMount() {
  static const bool may = [] {
    const uid_t user = geteuid();
    const gid_t group = getegid();
    if (unshare(user == 0 ? CLONE_NEWNS : CLONE_NEWNS | CLONE_NEWUSER) != 0) return false;
    if (user != 0) {
      std::ofstream("/proc/self/setgroups") << "deny";
      std::ofstream("/proc/self/uid_map") << "0 " << user << " 1";
      std::ofstream("/proc/self/gid_map") << "0 " << group << " 1";
    }
    return mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
  }();
  return may;
}

// A disk of so many KiB in a folder, which it makes.
class Disk {
 public:
  Disk(const Folder& in, const std::string& name, int kibibytes) : path_(in.path() / name) {
    std::filesystem::create_directory(path_);
    const std::string size = "size=" + std::to_string(kibibytes) + "k";
    mounted_ = mount("tmpfs", path_.c_str(), "tmpfs", 0, size.c_str()) == 0;
  }
  ~Disk() {
    if (mounted_) umount2(path_.c_str(), MNT_DETACH);
  }
  Disk(const Disk&) = delete;
  Disk& operator=(const Disk&) = delete;

  bool mounted() const { return mounted_; }
  void forbidWriting() const {
    ASSERT_EQ(mount("none", path_.c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr), 0);
  }
  void fill() const {
    std::ofstream file(path_ / "fill");
    const std::string piece(1024, 'x');
    while (file << piece << std::flush) continue;
  }

 private:
  std::filesystem::path path_;
  bool mounted_ = false;
};

}  // namespace pbrt::test
