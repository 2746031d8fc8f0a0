#pragma once
// The laws of each kind.

#include "law.h"

namespace pbrt::laws {

// Of every plug-in, whatever its kind. The first throws Error if it cannot be made: then no other
// law has anything to go by.
inline constexpr std::string_view kMade = "is-made";
std::span<const Law> commonLaws();

std::span<const Law> shapeLaws();
std::span<const Law> materialLaws();
std::span<const Law> textureLaws();
std::span<const Law> lightLaws();
std::span<const Law> cameraLaws();
std::span<const Law> samplerLaws();
std::span<const Law> filterLaws();
std::span<const Law> integratorLaws();
std::span<const Law> volumeLaws();

// Those of a kind, in the order in which they are best read; the common ones come before them.
std::span<const Law> lawsOf(PluginKind kind);

}  // namespace pbrt::laws
