// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deferred_shade/cuda.hpp>
#include <deferred_shade/workspace.hpp>

/// What a renderer keeps from one batch to the next: no CUDA compiler is needed to hold it.
struct renderer {
  deferred_shade::workspace<deferred_shade::cuda_allocator<std::byte>> scratch;
};

/// Shades `n` requests on the current device and gives how many came out right.
int shade_batch(renderer& r, int n);
