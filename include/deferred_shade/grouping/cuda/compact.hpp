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

#include <deferred_shade/cuda/launch.hpp>
#include <deferred_shade/system.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade::detail {

/// Whether a request names shader `id`.
template <shader_id Shaders, class Count, class Ids>
struct names_shader {
  Count n;
  Ids ids;
  shader_id id;
  __device__ bool operator()(request_index i) const {
    return i < size_of(n) && shader_of(ids, i, Shaders) == id;
  }
};

/// Adds a number that lies in device memory: the offset of a segment, where the host does not know
/// it.
struct add_offset {
  request_index const* offset;
  __host__ __device__ request_index operator()(request_index i) const { return *offset + i; }
};

template <shader_id Shaders, class Policy, class Count, class Ids, class Workspace>
grouping compact_grouping(cuda_system, Policy const& exec, Count n, Ids ids, Workspace& scratch,
                          std::bitset<Shaders> const& wanted) {
  std::size_t const maximum = maximum_of(n);
  cudaStream_t const stream = stream_of(exec);
  cudaGetLastError();  // CUB would take what the renderer left there for an error of its own
  thrust::counting_iterator<request_index> const requests(0);
  // The segment of a shader begins where the one before ends, which its launch has written.
  auto const select = [&](void* memory, std::size_t& bytes, shader_id k, request_index* permutation,
                          request_index* offsets) {
    auto const places = thrust::make_transform_iterator(requests, add_offset{offsets + k});
    auto const segment = thrust::make_permutation_iterator(permutation, places);
    auto const end =
        thrust::make_transform_output_iterator(offsets + k + 1, add_offset{offsets + k});
    check_cuda(cub::DeviceSelect::If(memory, bytes, requests, segment, end,
                                     static_cast<std::int64_t>(maximum),
                                     names_shader<Shaders, Count, Ids>{n, ids, k}, stream),
               "stream compaction");
  };
  std::size_t bytes = 0;
  select(nullptr, bytes, 0, nullptr, nullptr);
  auto const [permutation, memory, offsets] =
      scratch.take(elements<request_index>(maximum), elements<std::byte>(bytes),
                   elements<request_index>(Shaders + 1));
  check_cuda(cudaMemsetAsync(offsets, 0, sizeof(request_index), stream), "clearing an offset");
  for (shader_id k = 0; k < Shaders; ++k) {
    if (wanted[k]) {
      select(memory, bytes, k, permutation, offsets);
    } else {
      check_cuda(cudaMemcpyAsync(offsets + k + 1, offsets + k, sizeof(request_index),
                                 cudaMemcpyDeviceToDevice, stream),
                 "copying an offset");
    }
  }
  return {permutation, offsets, maximum};
}

}  // namespace deferred_shade::detail
