#pragma once
// The last line of a terminal, redrawn while a command works, and what is printed above it.

#include <string>
#include <string_view>

namespace pbrt {

// Whether standard error is a terminal that can redraw a line.
bool hasStatusLine();

// Characters that a status line may have: the terminal's width (COLUMNS, if it is set) but one, as
// some terminals begin a new line after the last.
int statusWidth();

// Shows a line in place of the one before; empty: none. Only where hasStatusLine(). Any thread.
void showStatus(const std::string& text);

// Prints a line to standard error, above the status line if there is one. Any thread. Takes no
// memory.
void printError(std::string_view line) noexcept;

}  // namespace pbrt
