// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

// One include for the tests: Catch2 version 3 where it is installed, else version 2.13.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
#else
#include <catch2/catch.hpp>
#endif

// Version 2 has the matchers in namespace Catch, version 3 in Catch::Matchers.
#if defined(CATCH_VERSION_MAJOR) && CATCH_VERSION_MAJOR >= 3
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
inline auto ContainsText(std::string const& text) {
  return Catch::Matchers::ContainsSubstring(text);
}
#else
using Catch::WithinAbs;
using Catch::WithinRel;
inline auto ContainsText(std::string const& text) { return Catch::Contains(text); }
#endif
