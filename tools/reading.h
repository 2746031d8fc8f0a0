#pragma once
// Reads the scene that a command line names.

#include "core/parse/parse.h"
#include "options.h"

namespace pbrt {

// Parses the scene files. Their text is in `parser`, for messages to quote.
void parse(Parser& parser, const std::vector<std::string>& files);

// Tells errors of includes, where those are to be passed over.
Reporter includes(const Options& o);

// Says what was passed over. Returns the exit code for a scene with so many errors.
int judge(const Options& o);

}  // namespace pbrt
