// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cub/device/device_radix_sort.cuh>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/tuning.hpp>
#include <deferred_shade/detail/cuda/warp.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// Writes the pairs to sort. Requests at and beyond the count get the key of those without a
/// shader, and end up last.
template <shader_id Shaders, class Key, class Count, class Ids>
__global__ void radix_pairs_kernel(std::size_t maximum, Count n, Ids ids, Key* keys,
                                   request_index* indices) {
  detail::begin_after_earlier_kernels();
  std::size_t const p = std::size_t{blockIdx.x} * blockDim.x + threadIdx.x;
  if (p >= maximum) return;
  auto const i = static_cast<request_index>(p);
  keys[i] = static_cast<Key>(i < detail::size_of(n) ? detail::shader_of(ids, i, Shaders) : Shaders);
  indices[i] = i;
}

/// Sets offsets[k] to the number of keys below k.
template <shader_id Shaders, class Key>
__global__ void radix_offsets_kernel(std::size_t size, Key const* keys, request_index* offsets) {
  detail::begin_after_earlier_kernels();
  std::uint32_t const k = blockIdx.x * blockDim.x + threadIdx.x;
  if (k > Shaders) return;
  std::size_t first = 0;
  for (std::size_t length = size; length > 0;) {
    std::size_t const half = length / 2;
    bool const below = keys[first + half] < k;
    first = below ? first + half + 1 : first;
    length = below ? length - half - 1 : half;
  }
  offsets[k] = static_cast<request_index>(first);
}

template <shader_id Shaders, class Policy, class Count, class Ids, class Workspace>
grouping radix_grouping(cuda_system, Policy const& exec, Count n, Ids ids, Workspace& scratch) {
  using key = sort_key<Shaders>;
  constexpr std::uint32_t threads = copy_threads;
  std::size_t const maximum = detail::maximum_of(n);
  cudaStream_t const stream = detail::stream_of(exec);
  detail::forget_earlier_error();
  auto const sort = [&](void* memory, std::size_t& bytes, cub::DoubleBuffer<key>& keys,
                        cub::DoubleBuffer<request_index>& indices) {
    detail::check_cuda(cub::DeviceRadixSort::SortPairs(memory, bytes, keys, indices,
                                                       static_cast<std::int64_t>(maximum), 0,
                                                       detail::bits_for(Shaders), stream),
                       "radix sort");
  };
  std::size_t bytes = 0;
  cub::DoubleBuffer<key> keys(nullptr, nullptr);
  cub::DoubleBuffer<request_index> indices(nullptr, nullptr);
  sort(nullptr, bytes, keys, indices);
  auto const [keys_0, keys_1, indices_0, indices_1, memory, offsets] =
      scratch.take(elements<key>(maximum), elements<key>(maximum), elements<request_index>(maximum),
                   elements<request_index>(maximum), elements<std::byte>(bytes),
                   elements<request_index>(Shaders + 1));
  keys = {keys_0, keys_1};
  indices = {indices_0, indices_1};
  detail::launch<&radix_pairs_kernel<Shaders, key, Count, Ids>>(
      "radix sort's pairs", stream, {detail::blocks_for(maximum, threads), threads}, maximum, n,
      ids, keys_0, indices_0);
  sort(memory, bytes, keys, indices);
  detail::launch<&radix_offsets_kernel<Shaders, key>>(
      "radix sort's offsets", stream, {detail::blocks_for(Shaders + 1, threads), threads}, maximum,
      keys.Current(), offsets);
  return {indices.Current(), offsets, maximum};
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
