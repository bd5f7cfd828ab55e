// SPDX-License-Identifier: Apache-2.0
// A workspace of a policy of the standard library.
// errors: 3
// error: a workspace must be made of an allocator or of an execution policy of Thrust's system cpp,
// omp, tbb
#include "program.hpp"

#include <execution>

auto capacity() {
#ifdef RIGHT
  ds::workspace scratch{thrust::cpp::par};
#else
  ds::workspace scratch{std::execution::par};
#endif
  return scratch.capacity();
}
