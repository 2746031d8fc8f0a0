#pragma once

namespace nowhere {

// In a library that is not there when a plug-in is opened.
void defined(int);

}  // namespace nowhere
