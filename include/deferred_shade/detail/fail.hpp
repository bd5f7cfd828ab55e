// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/config.hpp>
#if !DEFERRED_SHADE_HAS_EXCEPTIONS
#include <cstdio>
#include <cstdlib>
#endif

namespace deferred_shade::detail {

/// Throws an `Error` that is made of `arguments`. Without exceptions (-fno-exceptions), writes the
/// error's message to stderr as one line and aborts.
template <class Error, class... Arguments>
[[noreturn]] inline void fail(Arguments const&... arguments) {
#if DEFERRED_SHADE_HAS_EXCEPTIONS
  throw Error(arguments...);
#else
  std::fprintf(stderr, "%s\n", Error(arguments...).what());
  std::abort();
#endif
}

}  // namespace deferred_shade::detail
