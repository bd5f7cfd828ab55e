// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/overlap.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// Begins a kernel whose blocks own tiles of up to `Size` requests, of a batch of `n`. Finds the
/// first request of this block's tile and their number. Returns false if the batch ends before the
/// tile.
template <std::uint32_t Size, class Count>
__device__ bool begin_tile(Count n, request_index& first, std::uint32_t& size) {
  detail::begin_after_earlier_kernels();
  std::size_t const tile = std::size_t{blockIdx.x} * Size;
  std::size_t const end = detail::size_of(n);
  if (tile >= end) return false;
  first = static_cast<request_index>(tile);
  size = static_cast<std::uint32_t>((min)(std::size_t{Size}, end - tile));
  return true;
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
