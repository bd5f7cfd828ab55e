// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cub/device/device_scan.cuh>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/bucket_tile.hpp>
#include <deferred_shade/detail/cuda/copied_ids.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/tile_sort.hpp>
#include <deferred_shade/detail/cuda/warp.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

// Buckets for tables of up to 511 shaders: a thread block counts a tile in shared memory.

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// Sets counts[k * tiles + t] to the number of requests of shader k in tile t. A thread takes
/// neighbouring requests and adds once for each run of equal ids.
template <shader_id Shaders, class Count, class Ids>
__global__ void __launch_bounds__(bucket_threads)
    counter_bucket_count_kernel(Count n, Ids ids, std::uint32_t* counts) {
  __shared__ std::uint32_t shared[Shaders + 1];
  detail::begin_after_earlier_kernels();
  for (std::uint32_t k = threadIdx.x; k <= Shaders; k += bucket_threads) shared[k] = 0;
  __syncthreads();
  std::uint32_t keys[bucket_items];
  tile_of_block(detail::size_of(n)).load_neighbours_of_thread<Shaders>(ids, keys);
  std::uint32_t length = 0;
#pragma unroll
  for (std::uint32_t item = 0; item < bucket_items; ++item) {
    ++length;
    if (item + 1 < bucket_items && keys[item + 1] == keys[item]) continue;
    atomicAdd(&shared[keys[item]], length);
    length = 0;
  }
  __syncthreads();
  for (std::uint32_t k = threadIdx.x; k < Shaders; k += bucket_threads) {
    counts[k * gridDim.x + blockIdx.x] = shared[k];
  }
}

/// Puts the requests of every tile to their places. `places[k * tiles + t]` is the place of the
/// first request of shader k in tile t; the last element is the number of requests that have a
/// shader.
template <shader_id Shaders, class Count, class Ids>
__global__ void __launch_bounds__(bucket_threads,
                                  blocks_that_fit(counter_place_blocks, bucket_threads))
    counter_bucket_place_kernel(Count n, Ids ids, std::uint32_t const* places,
                                request_index* permutation, request_index* offsets) {
  using sort = tile_sort<Shaders, bucket_threads, bucket_items>;
  __shared__ union {
    typename sort::temporary_storage sorting;
    std::uint32_t slots[sort::size];  // the sorted tile: the shader above the position
  } shared;
  __shared__ std::uint32_t starts[sort::columns];
  __shared__ std::uint32_t shift[Shaders];  // from places in the tile to places in the batch
  detail::begin_after_earlier_kernels();
  tile_of_block const tile(detail::size_of(n));
  std::uint32_t keys[bucket_items];
  std::uint32_t ranks[bucket_items];
  sort::load(ids, tile.first, tile.size, keys);
  sort::find_places(shared.sorting, keys, ranks, starts);
  __syncthreads();
  for (std::uint32_t k = threadIdx.x; k < Shaders; k += bucket_threads) {
    std::uint32_t const place = places[k * gridDim.x + blockIdx.x];
    shift[k] = place - starts[k];
    if (blockIdx.x == 0) offsets[k] = place;
  }
  if (blockIdx.x == 0 && threadIdx.x == 0) offsets[Shaders] = places[Shaders * gridDim.x];
#pragma unroll
  for (std::uint32_t item = 0; item < bucket_items; ++item) {
    shared.slots[ranks[item]] = keys[item] << 16 | sort::position(item);
  }
  __syncthreads();
  std::uint32_t const used = starts[Shaders];
#pragma unroll
  for (std::uint32_t item = 0; item < bucket_items; ++item) {
    std::uint32_t const p = item * bucket_threads + threadIdx.x;
    if (p >= used) break;
    std::uint32_t const slot = shared.slots[p];
    permutation[shift[slot >> 16] + p] = tile.first + (slot & 0xffff);
  }
}

template <shader_id Shaders, class Count, class Ids, class Workspace>
grouping counter_bucket_grouping(cudaStream_t stream, Count n, Ids ids, Workspace& scratch) {
  std::size_t const maximum = detail::maximum_of(n);
  std::size_t const tiles = (std::max)(std::size_t{1}, (maximum + bucket_tile - 1) / bucket_tile);
  auto const scan = [&](void* memory, std::size_t& bytes, std::uint32_t* counts) {
    detail::check_cuda(
        cub::DeviceScan::ExclusiveSum(memory, bytes, counts, counts,
                                      static_cast<std::int64_t>(tiles * Shaders + 1), stream),
        "bucket scan");
  };
  detail::forget_earlier_error();
  std::size_t bytes = 0;
  scan(nullptr, bytes, nullptr);
  using passes = two_passes<Shaders, Ids>;
  using first_ids = typename passes::first;
  using second_ids = typename passes::second;
  auto const [permutation, counts, memory, offsets, copy] = scratch.take(
      elements<request_index>(maximum), elements<std::uint32_t>(tiles * Shaders + 1),
      elements<std::byte>(bytes), elements<request_index>(Shaders + 1), passes::memory(maximum));
  launch_shape const shape{tiles, bucket_threads};
  detail::launch<&counter_bucket_count_kernel<Shaders, Count, first_ids>>(
      "bucket count", stream, shape, n, passes::read_first(ids, copy), counts);
  scan(memory, bytes, counts);
  detail::launch<&counter_bucket_place_kernel<Shaders, Count, second_ids>>(
      "bucket place", stream, shape, n, passes::read_second(ids, copy), counts, permutation,
      offsets);
  return {permutation, offsets, maximum};
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
