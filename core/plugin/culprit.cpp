#include "core/plugin/culprit.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>
#include <unwind.h>

#include <atomic>
#include <cstring>
#include <mutex>
#include <new>
#include <utility>

#include "core/plugin/plugin.h"

namespace pbrt {

namespace {

std::atomic<const PluginCode*> newest = nullptr;

struct Throw {
  const void* object = nullptr;
  const PluginCode* thrower = nullptr;
};

// The library is there when the program starts: handlers of signals find these without a call.
thread_local Throw lastThrow __attribute__((tls_model("initial-exec")));
thread_local Location making __attribute__((tls_model("initial-exec")));

// Widens `code`, which holds one address of a loaded object, to all of that object.
int widen(dl_phdr_info* object, std::size_t /*size*/, void* to) {
  auto& code = *static_cast<PluginCode*>(to);
  std::uintptr_t begin = UINTPTR_MAX, end = 0;
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const auto& part = object->dlpi_phdr[i];
    if (part.p_type != PT_LOAD) continue;
    begin = std::min<std::uintptr_t>(begin, object->dlpi_addr + part.p_vaddr);
    end = std::max<std::uintptr_t>(end, object->dlpi_addr + part.p_vaddr + part.p_memsz);
  }
  if (code.begin < begin || code.begin >= end) return 0;
  code.begin = begin, code.end = end;
  return 1;
}

_Unwind_Reason_Code look(_Unwind_Context* frame, void* found) {
  // A call returns to the instruction after it, which may be another function's.
  auto& plugin = *static_cast<const PluginCode**>(found);
  plugin = pluginAt(reinterpret_cast<const void*>(_Unwind_GetIP(frame) - 1));  // NOLINT
  return plugin ? _URC_END_OF_STACK : _URC_NO_REASON;
}

}  // namespace

void registerPlugin(const PluginInfo& info, const std::filesystem::path& file) {
  static std::mutex mutex;
  const std::scoped_lock lock(mutex);
  if (pluginAt(&info)) return;
  auto* code = new PluginCode{reinterpret_cast<std::uintptr_t>(&info), 0,
                              fmt::format("{}/{}", kindFolder(info.kind), info.name),
                              file.lexically_normal().string(), newest.load()};
  if (dl_iterate_phdr(&widen, code) == 0) code->end = code->begin;
  newest.store(code, std::memory_order_release);
}

const PluginCode* pluginAt(const void* address) {
  const auto a = reinterpret_cast<std::uintptr_t>(address);
  const PluginCode* code = newest.load(std::memory_order_acquire);
  while (code && (a < code->begin || a >= code->end)) code = code->next;
  return code;
}

const PluginCode* pluginOnStack() {
  const PluginCode* found = nullptr;
  _Unwind_Backtrace(&look, &found);
  return found;
}

// Both C++ libraries hold in it nothing but where the object is.
const PluginCode* thrower() {
  const std::exception_ptr now = std::current_exception();
  static_assert(sizeof now == sizeof lastThrow.object);
  return now && std::memcmp(&now, &lastThrow.object, sizeof now) == 0 ? lastThrow.thrower : nullptr;
}

std::string whatWasThrown() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return "out of memory";
  } catch (const std::exception& e) {
    return e.what();
  } catch (...) {
    return "what is no std::exception";
  }
}

std::exception_ptr asError(const Location& where, const PluginInfo* maker) {
  const PluginCode* culprit = thrower();
  if (!culprit) culprit = pluginAt(maker);
  try {
    throw;
  } catch (const Error& error) {
    return std::make_exception_ptr(error.at(where));
  } catch (const std::bad_alloc&) {
    return std::current_exception();
  } catch (...) {
    if (!culprit) return std::current_exception();
    return std::make_exception_ptr(Error(
        where, fmt::format("{} threw: {}", culprit->label(), whatWasThrown()), Failure::plugin));
  }
}

Making::Making(const Location& where) : before_(std::exchange(making, where)) {}
Making::~Making() {
  making = before_;
}
Location Making::current() {
  return making;
}

}  // namespace pbrt

// Comes before the C++ library's own in the order of linking. Costs nothing until something throws.
extern "C" void __cxa_throw(void* object, void* type,  // NOLINT: its name
                            void (*destroy)(void*)) {
  using CxaThrow = void (*)(void*, void*, void (*)(void*));
  static const auto real = reinterpret_cast<CxaThrow>(dlsym(RTLD_NEXT, "__cxa_throw"));
  pbrt::lastThrow = {object, pbrt::pluginOnStack()};
  real(object, type, destroy);
  __builtin_unreachable();
}
