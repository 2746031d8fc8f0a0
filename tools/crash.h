#pragma once
// Last words: what is said when a plug-in crashes.

#include <string>

namespace pbrt {

// From now on a crash (of memory, arithmetic, an illegal instruction, abort(), a stack used up) is
// told of on standard error: the signal, the pixel and sample or the statement of the scene, and
// the plug-in on the stack, where there is one; then the process ends as it would have. Under a
// sanitizer, which tells more, it does nothing.
void tellOfCrashes();

// What a message about a crash ends with, instead of what was said before: how to go on. Cut at 500
// bytes; empty: nothing.
void adviseAfterCrash(const std::string& advice);

}  // namespace pbrt
