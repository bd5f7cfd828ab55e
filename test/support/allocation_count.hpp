// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace test {

/// Whether this build counts allocations: with glibc, and without a sanitizer, which has an
/// allocator of its own.
extern bool const counts_allocations;

/// The calls of malloc, calloc, realloc and aligned_alloc, operator new included, in this process
/// so far.
std::size_t allocations();

}  // namespace test
