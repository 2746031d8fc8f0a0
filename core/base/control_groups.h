#pragma once
// Where Linux says how much of the machine a container or a batch system leaves to this process.

#include <filesystem>
#include <string_view>
#include <vector>

namespace pbrt {

// The folders of the control groups that hold this process for a controller such as "cpu" or
// "memory", of version 1 or 2 (cgroups(7)): its own group and those about it, whose limits hold,
// too. A folder need not be there. `root`: where /proc and /sys/fs/cgroup are.
std::vector<std::filesystem::path> controlGroups(std::string_view controller,
                                                 const std::filesystem::path& root = "/");

}  // namespace pbrt
