#pragma once
// Which plug-in is to blame: for an address, for a stack, for what was thrown.

#include <cstdint>
#include <exception>
#include <filesystem>
#include <string>

#include "core/base/error.h"

namespace pbrt {

struct PluginInfo;

// Where the code and the tables of an opened plug-in lie. Never freed, as plug-ins are never
// closed.
struct PluginCode {
  std::uintptr_t begin = 0, end = 0;
  std::string name;  // "materials/matte"
  std::string file;
  const PluginCode* next = nullptr;  // the one opened before

  std::string label() const { return name + " (" + file + ")"; }
};

// Enters a plug-in that was opened; once is enough.
void registerPlugin(const PluginInfo& info, const std::filesystem::path& file);

// These take no lock and no memory, so that handlers of signals may ask. Null: no plug-in.
const PluginCode* pluginAt(const void* address);
// The innermost call of this thread that runs in a plug-in, seen from whoever asks.
const PluginCode* pluginOnStack();

// The plug-in that an object with virtual functions is of: their table lies in it. Null for the
// core's own.
template <class T>
const PluginCode* pluginOf(const T& object) {
  static_assert(std::is_polymorphic_v<T>);
  return pluginAt(*reinterpret_cast<const void* const*>(&object));
}

// Within a handler: the innermost plug-in on the stack when it was thrown. Null: there was none, or
// another thread threw it.
const PluginCode* thrower();
// Within a handler: the text of what was thrown.
std::string whatWasThrown();
// Within a handler: the same as an Error that names its plug-in (if nobody threw it here, `maker`)
// and the place, if known. Error gains the place only; std::bad_alloc stays what it is.
std::exception_ptr asError(const Location& where = {}, const PluginInfo* maker = nullptr);

// What this thread makes an object for, while one lives.
class Making {
 public:
  explicit Making(const Location& where);
  ~Making();
  Making(const Making&) = delete;
  Making& operator=(const Making&) = delete;
  // Nowhere: nothing is being made. A handler of signals may ask.
  static Location current();

 private:
  Location before_;
};

}  // namespace pbrt
