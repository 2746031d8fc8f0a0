#pragma once
// From the tokens of a parameter to its typed values.

#include "core/plugin/param.h"

namespace pbrt {

// A value as it is written. The places of the items tell their kind by their first character.
struct Value {
  Location where;               // with the brackets
  bool numbersOnly = false;     // a bracketed list of numbers and white space alone; no items then
  std::vector<Location> items;  // numbers, quoted strings, true and false
};

// The bytes of a place.
std::string_view textAt(const Location& where);

// The type of a parameter as the scene writes it, "color" or "rgb"; empty if no scene did. The text
// that the parameter came from must still be there.
std::string_view declaredType(const Param& param);

// The text of a quoted string, its escapes (\" \\ \' \n \t \r \b \f) resolved.
std::string unquote(const Location& quoted);

// What a value has to be: completes the message "expected ...".
struct Wanted {
  std::string_view what;
  std::string_view of;
};

// Appends the numbers of a value; T is float, double or int.
template <class T>
void readNumbers(const Value& value, const Wanted& wanted, std::vector<T>& numbers);

// The parameter which the quoted declaration and the value give. Throws Error at the place of
// what is wrong: the declaration, the type, one of the values, or their count.
Param makeParam(const Location& declaration, const Value& value);

// The same for Option, where the type may be left out, as pbrt-v4 itself does: "seed" 1. The value
// then tells it: bool, integer (2.0 is one), float or string.
Param makeOption(const Location& declaration, const Value& value);

}  // namespace pbrt
