// SPDX-License-Identifier: Apache-2.0
// A target of 32 bits, by another name for its std::size_t.
// error: std::size_t must have 64 bits, in which sizes of batches are computed; compile for a
// 64-bit target
// errors: 4
#include <cstddef>
#include <deferred_shade/detail/cpu/parallel_for.hpp>
#include <numeric>
#ifndef RIGHT
#define size_t uint32_t
#endif
#include <deferred_shade/detail/cpu/block_partition.hpp>
