#include "nowhere.h"

namespace nowhere {

void defined(int) {}

}  // namespace nowhere
