#pragma once
// Where handlers of signals run when a thread has used up its stack.

namespace pbrt {

// Gives this thread a stack for handlers, until it ends. Again: nothing. The tool says which
// signals are handled, if any.
void provideSignalStack();

}  // namespace pbrt
