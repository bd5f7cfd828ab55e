// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/iterator/counting_iterator.h>
#include <thrust/iterator/permutation_iterator.h>
#include <thrust/iterator/transform_iterator.h>
#include <thrust/iterator/transform_output_iterator.h>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <cub/device/device_select.cuh>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/warp.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// Whether a request names shader `id`.
template <shader_id Shaders, class Count, class Ids>
struct names_shader {
  Count n;
  Ids ids;
  shader_id id;
  __device__ bool operator()(request_index i) const {
    return i < detail::size_of(n) && detail::shader_of(ids, i, Shaders) == id;
  }
};

/// Adds a number in device memory: the offset of a segment, which the host does not know.
struct add_offset {
  request_index const* offset;
  __host__ __device__ request_index operator()(request_index i) const { return *offset + i; }
};

/// Bits of a bitset, for kernels.
template <shader_id Shaders>
struct shader_bits {
  std::uint32_t words[Shaders / 32 + 1] = {};

  explicit shader_bits(std::bitset<Shaders> const& from) {
    for (std::size_t k = 0; k < Shaders; ++k) words[k / 32] |= std::uint32_t{from[k]} << k % 32;
  }
  __device__ bool operator[](shader_id k) const { return (words[k / 32] >> k % 32 & 1U) != 0; }
};

/// Makes the segments of shaders that were not compacted empty: they begin and end where the one
/// before ends.
template <shader_id Shaders>
__global__ void empty_segments_kernel(request_index* offsets, shader_bits<Shaders> compacted) {
  detail::begin_after_earlier_kernels();
  shader_id const end = blockIdx.x * blockDim.x + threadIdx.x;
  if (end > Shaders || end == 0 || compacted[end - 1]) return;
  shader_id last = end - 1;
  while (last > 0 && !compacted[last - 1]) --last;
  offsets[end] = last == 0 ? 0 : offsets[last];
}

template <shader_id Shaders, class Policy, class Count, class Ids, class Workspace>
grouping compact_grouping(cuda_system, Policy const& exec, Count n, Ids ids, Workspace& scratch,
                          std::bitset<Shaders> const& wanted) {
  std::size_t const maximum = detail::maximum_of(n);
  cudaStream_t const stream = detail::stream_of(exec);
  detail::forget_earlier_error();
  thrust::counting_iterator<request_index> const requests(0);
  // The segment of a shader begins at `*begin`, the end of the one before, which an earlier launch
  // has written.
  auto const select_shader = [&](void* memory, std::size_t& bytes, shader_id k,
                                 request_index* permutation, request_index const* begin,
                                 request_index* end_at) {
    auto const places = thrust::make_transform_iterator(requests, add_offset{begin});
    auto const segment = thrust::make_permutation_iterator(permutation, places);
    auto const end = thrust::make_transform_output_iterator(end_at, add_offset{begin});
    detail::check_cuda(cub::DeviceSelect::If(memory, bytes, requests, segment, end,
                                             static_cast<std::int64_t>(maximum),
                                             names_shader<Shaders, Count, Ids>{n, ids, k}, stream),
                       "stream compaction");
  };
  std::size_t bytes = 0;
  select_shader(nullptr, bytes, 0, nullptr, nullptr, nullptr);
  auto const [permutation, memory, offsets] =
      scratch.take(elements<request_index>(maximum), elements<std::byte>(bytes),
                   elements<request_index>(Shaders + 1));
  detail::check_cuda(cudaMemsetAsync(offsets, 0, sizeof(request_index), stream),
                     "clearing an offset");
  request_index* begin = offsets;
  for (shader_id k = 0; k < Shaders; ++k) {
    if (!wanted[k]) continue;
    select_shader(memory, bytes, k, permutation, begin, offsets + k + 1);
    begin = offsets + k + 1;
  }
  if (!wanted.all()) {
    constexpr std::uint32_t threads = 128;
    detail::launch<&empty_segments_kernel<Shaders>>(
        "stream compaction", stream, {detail::blocks_for(Shaders + 1, threads), threads}, offsets,
        shader_bits<Shaders>(wanted));
  }
  return {permutation, offsets, maximum};
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
