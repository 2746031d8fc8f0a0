#include "core/scene/faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <tuple>

namespace pbrt {

namespace {

thread_local SamplePlace current __attribute__((tls_model("initial-exec")));

bool before(const Fault& a, const Fault& b) {
  const auto key = [](const SamplePlace& p) { return std::tuple(p.sample, p.pixel.y, p.pixel.x); };
  return key(a.at) < key(b.at);
}

}  // namespace

void FaultLog::add(Fault fault) {
  ++count_;
  const std::scoped_lock lock(mutex_);
  first_.insert(std::ranges::upper_bound(first_, fault, before), std::move(fault));
  if (first_.size() > kKept) first_.pop_back();
}

void FaultLog::addThrown(const SamplePlace& at) {
  const PluginCode* culprit = thrower();
  std::string text = whatWasThrown();
  try {
    throw;
  } catch (const Error& error) {
    text = error.diagnostics().at(0).message;
  } catch (const std::bad_alloc&) {
    outOfMemory_ = true;
  } catch (...) {  // its text will do
  }
  add({at, std::move(text), culprit});
}

std::vector<Fault> FaultLog::first() const {
  const std::scoped_lock lock(mutex_);
  return first_;
}

void FaultLog::locate(const std::function<const PluginCode*(const SamplePlace&)>& search) {
  const std::scoped_lock lock(mutex_);
  for (Fault& fault : first_)
    if (fault.thrown.empty() && !fault.culprit) fault.culprit = search(fault.at);
}

std::string describe(const FaultLog& faults) {
  const std::uint64_t count = faults.count();
  if (count == 0) return {};
  std::string text = count == 1 ? "1 sample failed and counts as black"
                                : fmt::format("{} samples failed and count as black", count);
  const std::vector<Fault> first = faults.first();
  if (first.empty()) return text + ", all of them before this run";
  const Fault& f = first[0];
  return text + fmt::format("; {}: pixel ({}, {}), sample {}: {} {}",
                            count == 1 ? "it is" : "first", f.at.pixel.x, f.at.pixel.y, f.at.sample,
                            f.culprit ? f.culprit->label() : "some part",
                            f.thrown.empty() ? "gave what is not a number, or infinite"
                                             : "threw: " + f.thrown);
}

const SamplePlace& currentSample() {
  return current;
}
void setCurrentSample(const SamplePlace& at) {
  current = at;
}

}  // namespace pbrt
