// SPDX-License-Identifier: Apache-2.0
// Elements that are aligned more than a workspace is.
// error: elements of a workspace must be aligned to at most 128 bytes
#include "program.hpp"

#ifdef RIGHT
struct alignas(128) wide {
  char byte;
};
#else
struct alignas(256) wide {
  char byte;
};
#endif
auto f() { return ds::elements<wide>(5).count; }
