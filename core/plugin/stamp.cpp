#include "core/plugin/stamp.h"

#include <fmt/format.h>
#include <link.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>

// NOLINTBEGIN(bugprone-reserved-identifier)

// The head of this library's own file; the linker names it.
extern "C" __attribute__((visibility("hidden"))) const ElfW(Ehdr) __ehdr_start;

// Null if the run-time library of the sanitizer is not in the process.
extern "C" __attribute__((weak)) void __asan_init();
extern "C" __attribute__((weak)) void __tsan_init();
extern "C" __attribute__((weak)) void __msan_init();

// NOLINTEND(bugprone-reserved-identifier)

namespace pbrt {

namespace fs = std::filesystem;

namespace {

// By the bits of BuildOption.
constexpr std::array<std::string_view, 6> kOptionNames = {
    "libc++ (-stdlib=libc++)",
    "the std::string of before C++11 (-D_GLIBCXX_USE_CXX11_ABI=0)",
    "the containers of -D_GLIBCXX_DEBUG",
    "AddressSanitizer (-fsanitize=address)",
    "ThreadSanitizer (-fsanitize=thread)",
    "MemorySanitizer (-fsanitize=memory)"};
constexpr std::string_view kCutShort = "the file is cut short; build it again";
// Of what a plug-in may write to. That of ours is a few kB.
constexpr std::uint64_t kMostData = std::uint64_t{256} << 20;
constexpr std::uint32_t kSanitizers = kAddressSanitizer | kThreadSanitizer | kMemorySanitizer;

// What a plug-in may be built with here. Sanitizers need their run-time library, which LD_PRELOAD
// also brings.
std::uint32_t availableOptions() {
  std::uint32_t options = buildOptions();
  if (__asan_init) options |= kAddressSanitizer;
  if (__tsan_init) options |= kThreadSanitizer;
  if (__msan_init) options |= kMemorySanitizer;
  return options;
}

std::string optionRefusal(std::uint32_t theirs) {
  const std::uint32_t ours = availableOptions();
  const std::uint32_t superfluous = theirs & ~ours;
  // What a sanitizer does not see does not harm it.
  const std::uint32_t missing = ours & ~theirs & ~kSanitizers;
  if ((superfluous | missing) == 0) return "";
  const auto bit = static_cast<std::size_t>(std::countr_zero(superfluous | missing));
  if (bit >= kOptionNames.size()) return "its stamp is damaged; build it again";
  if (superfluous >> bit & 1U)
    return fmt::format("it was built with {}, this pbrt was not; build it again without",
                       kOptionNames[bit]);
  return fmt::format("it was built without {}, this pbrt with it; build it again with it",
                     kOptionNames[bit]);
}

}  // namespace

std::string refusal(const PluginStamp& stamp) {
  constexpr PluginStamp ours;
  if (stamp.magic != ours.magic)
    return fmt::format(
        "it has no stamp: it is no pbrt plug-in, or one for a plug-in ABI below 3, where this pbrt "
        "has {}; build it again",
        kAbiVersion);
  if (stamp.abi != ours.abi)
    return fmt::format("it was built for plug-in ABI {}, this pbrt has {}; build it again",
                       stamp.abi, ours.abi);
  if (std::string reason = optionRefusal(stamp.options); !reason.empty()) return reason;
  if (stamp.glm != ours.glm)
    return "it was built with other options of GLM than this pbrt, such as "
           "GLM_FORCE_DEFAULT_ALIGNED_GENTYPES; build it again with those of the CMake target "
           "pbrt::core";
  if (stamp.layout != ours.layout)
    return "its data are laid out otherwise than those of this pbrt, by other headers or by an "
           "option such as -fpack-struct; build it again with the headers of this pbrt";
  return "";
}

std::string refusal(const fs::path& file) {
  std::error_code none;
  if (!fs::exists(file, none)) return "there is no such file";
  // To open a pipe might take for ever.
  if (!fs::is_regular_file(file, none)) return "it is a folder, a device or a pipe";
  std::ifstream in(file, std::ios::binary);
  if (!in) return "it cannot be read: " + std::generic_category().message(errno);
  const std::uint64_t size = fs::file_size(file, none);
  const auto read = [&](std::uint64_t at, std::uint64_t n, void* to) {
    return at <= size && n <= size - at && in.seekg(static_cast<std::streamoff>(at)) &&
           in.read(static_cast<char*>(to), static_cast<std::streamsize>(n));
  };

  ElfW(Ehdr) head;
  if (!read(0, sizeof head, &head) || std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0)
    return "it is no shared object";
  if (head.e_ident[EI_CLASS] != __ehdr_start.e_ident[EI_CLASS] ||
      head.e_ident[EI_DATA] != __ehdr_start.e_ident[EI_DATA] ||
      head.e_machine != __ehdr_start.e_machine)
    return "it was built for another kind of machine; build it again on this one";

  PluginStamp stamp;
  const std::string_view magic(stamp.magic.data(), stamp.magic.size());
  bool found = false;
  std::string data;
  for (std::uint64_t i = 0; i < head.e_phnum; ++i) {
    ElfW(Phdr) part;
    const bool whole = read(head.e_phoff + i * head.e_phentsize, sizeof part, &part);
    // The dynamic linker maps without a look at the size, and would die beyond the end by a signal.
    if (!whole || part.p_offset > size || part.p_filesz > size - part.p_offset)
      return std::string(kCutShort);
    // The rest of p_memsz is set to zero, wherever that is.
    if (part.p_type == PT_LOAD && part.p_filesz > part.p_memsz)
      return "its headers are damaged; build it again";
    // A PluginInfo has pointers that the dynamic linker fills in: it lies among what is written to.
    if (found || part.p_type != PT_LOAD || !(part.p_flags & PF_W)) continue;
    if (part.p_filesz > kMostData)
      return fmt::format("it has {} MiB of data that may be written to, a plug-in at most {}",
                         part.p_filesz >> 20, kMostData >> 20);
    data.resize(part.p_filesz);
    if (!read(part.p_offset, part.p_filesz, data.data())) return std::string(kCutShort);
    const std::size_t at = data.find(magic);
    found = at != data.npos && sizeof stamp <= data.size() - at;
    if (found) std::memcpy(&stamp, data.data() + at, sizeof stamp);
  }
  if (!found) stamp.magic = {};
  return refusal(stamp);
}

}  // namespace pbrt
