#pragma once
// How much memory there is for this process: asked before what a few words of a scene can make
// huge, as the kernel ends a process that takes more without a word.

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace pbrt {

// Bytes: the least of what the machine has, the process's control groups (containers, batch
// systems) and its own limits (ulimit -v, -d) allow. Memory that others use is not taken off.
std::size_t memoryLimit();

// Bytes: no file, nor the picture in it, may take more.
inline std::size_t halfOfMemory() {
  return memoryLimit() / 2;
}

// What the control groups of this process allow, in bytes; the largest number if they allow all.
// `root`: where /proc and /sys/fs/cgroup are.
std::size_t controlGroupMemory(const std::filesystem::path& root = "/");

// Throws Error ("... needs 412.0 GiB of memory; there is room for 24.0 GiB") if so many bytes are
// more than there is room for. Doubles do not overflow.
void checkMemory(double bytes, std::string_view what);

}  // namespace pbrt
