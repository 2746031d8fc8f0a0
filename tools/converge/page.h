#pragma once
// The parts of the page, as they stand beside this file.

namespace pbrt {

extern const char* const kPageHtml;  // with the placeholders /*STYLE*/, /*REPORT*/null, /*SCRIPT*/
extern const char* const kPageStyle;
extern const char* const kPageScript;

}  // namespace pbrt
