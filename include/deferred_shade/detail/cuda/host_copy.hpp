// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cuda_runtime.h>
#include <cstddef>
#include <string>
#include <vector>

#include <deferred_shade/cuda.hpp>
#include <deferred_shade/detail/checked_count.hpp>
#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/tuning.hpp>
#include <deferred_shade/types.hpp>

// Copies from a CUDA device, for reports that the host computes.

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// The number of requests, read when the work on the stream is done. Throws what checked_count
/// throws.
template <class Integer>
request_index count_on_host(std::string const& caller, cudaStream_t, Integer n) {
  return detail::checked_count(caller, n);
}
template <class Integer>
request_index count_on_host(std::string const& caller, cudaStream_t stream,
                            device_count<Integer> n) {
  detail::checked_maximum(caller, n);
  Integer count{};
  detail::check_cuda(cudaMemcpyAsync(&count, n.pointer, sizeof count, cudaMemcpyDefault, stream),
                     "reading a device_count");
  detail::check_cuda(cudaStreamSynchronize(stream), "reading a device_count");
  return detail::checked_count(caller, device_count<Integer>{&count, n.maximum});
}

template <class Ids>
__global__ void copy_ids_kernel(std::size_t n, Ids ids, shader_id* copy) {
  detail::begin_after_earlier_kernels();
  std::size_t const i = std::size_t{blockIdx.x} * blockDim.x + threadIdx.x;
  if (i >= n) return;
  constexpr auto none = static_cast<shader_id>(-1);  // no table is that large
  copy[i] = detail::shader_of(ids, static_cast<request_index>(i), none);
}

/// A copy of the ids of `n` requests. Waits for the stream.
template <class Ids>
std::vector<shader_id> ids_on_host(cudaStream_t stream, std::size_t n, Ids ids) {
  std::vector<shader_id> copy(n);
  if (n == 0) return copy;
  struct buffer {
    explicit buffer(std::size_t n) : ids(cuda_allocator<shader_id>().allocate(n)) {}
    buffer(buffer const&) = delete;
    ~buffer() { cuda_allocator<shader_id>().deallocate(ids, 0); }
    shader_id* ids;
  } const device(n);
  detail::launch<&copy_ids_kernel<Ids>>("copying ids", stream,
                                        {detail::blocks_for(n, copy_threads), copy_threads}, n, ids,
                                        device.ids);
  detail::check_cuda(cudaMemcpyAsync(copy.data(), device.ids, n * sizeof(shader_id),
                                     cudaMemcpyDeviceToHost, stream),
                     "copying ids");
  detail::check_cuda(cudaStreamSynchronize(stream), "copying ids");
  return copy;
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
