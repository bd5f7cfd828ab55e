// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/copy.h>
#include <thrust/count.h>
#include <thrust/reduce.h>
#include <thrust/sequence.h>
#include <thrust/sort.h>
#include <cstddef>
#include <cstdint>
#ifdef __CUDACC__
#include <cooperative_groups.h>
#include <cub/device/device_radix_sort.cuh>
#endif

#include "machine.hpp"

/// What groupings are compared with. All are made for `n` requests of `shaders` shaders, take ids
/// of 8 bits, and, the queues and the copy excepted, give a stable permutation.
namespace bench {

/// Thrust's sort of 32-bit keys, with temporary memory as Thrust allocates it.
class thrust_sort {
 public:
  thrust_sort(std::size_t n, ds::shader_id) : keys_(n), permutation_(n) {}

  ds::grouping operator()(std::uint8_t const* ids) {
    thrust::copy_n(policy(), thrust::device_pointer_cast(ids), keys_.size(), keys_.begin());
    thrust::sequence(policy(), permutation_.begin(), permutation_.end());
    thrust::stable_sort_by_key(policy(), keys_.begin(), keys_.end(), permutation_.begin());
    ds::grouping group{};
    group.permutation = raw(permutation_);
    return group;
  }

 private:
  array<std::uint32_t> keys_;
  array<request_index> permutation_;
};

/// A copy of 5 bytes per request: reads 5 and writes 5. A grouping reads an id and writes an index,
/// 5 bytes in all, which take half as long at this rate.
class copy_5_bytes {
 public:
  copy_5_bytes(std::size_t n, ds::shader_id) : from_(5 * n / 4, 1), to_(5 * n / 4) {}

  void operator()(std::uint8_t const*) {
    thrust::copy(policy(), from_.begin(), from_.end(), to_.begin());
  }
  bool is_right(std::uint8_t const*) { return from_ == to_; }

 private:
  array<std::uint32_t> from_;
  array<std::uint32_t> to_;
};

#ifdef __CUDACC__

/// CUB's radix sort of (id, index) pairs over the bits that the ids need, and the indices' filling.
class cub_radix_sort {
 public:
  cub_radix_sort(std::size_t n, ds::shader_id shaders) : keys_(n), indices_(n), permutation_(n) {
    while ((std::size_t{1} << bits_) < shaders) ++bits_;
    std::size_t bytes = 0;
    sort(nullptr, bytes, nullptr);
    temporary_.resize(bytes);
  }

  ds::grouping operator()(std::uint8_t const* ids) {
    thrust::sequence(policy(), indices_.begin(), indices_.end());
    std::size_t bytes = temporary_.size();
    sort(raw(temporary_), bytes, ids);
    ds::grouping group{};
    group.permutation = raw(permutation_);
    return group;
  }

 private:
  void sort(void* temporary, std::size_t& bytes, std::uint8_t const* ids) {
    check_cuda(cub::DeviceRadixSort::SortPairs(
        temporary, bytes, ids, raw(keys_), raw(indices_), raw(permutation_),
        static_cast<std::int64_t>(indices_.size()), 0, bits_, stream()));
  }

  int bits_ = 0;
  array<std::uint8_t> keys_;
  array<request_index> indices_;
  array<request_index> permutation_;
  array<std::uint8_t> temporary_;
};

/// Pushes a request to the queue of its shader: the lanes of a warp with the same shader take their
/// places by one atomic addition.
struct push {
  std::uint8_t const* ids;
  std::size_t capacity;
  std::uint32_t* sizes;
  request_index* queues;
  __device__ void operator()(request_index i) const {
    namespace cg = cooperative_groups;
    std::uint32_t const shader = ids[i];
    auto const peers = cg::labeled_partition(cg::coalesced_threads(), shader);
    std::uint32_t first = 0;
    if (peers.thread_rank() == 0) first = atomicAdd(&sizes[shader], peers.size());
    queues[shader * capacity + peers.shfl(first, 0) + peers.thread_rank()] = i;
  }
};

/// Marks the requests that lie at one position of the queues of their shaders.
struct mark_queued {
  push queue;
  ds::shader_id shaders;
  std::uint8_t* queued;
  __device__ void operator()(request_index p) const {
    for (ds::shader_id k = 0; k < shaders; ++k) {
      if (p >= queue.sizes[k]) continue;
      request_index const i = queue.queues[k * queue.capacity + p];
      if (i < queue.capacity && queue.ids[i] == k) queued[i] = 1;
    }
  }
};

/// A queue per shader, each with room for all requests, as wavefront renderers have them. Within a
/// queue, requests are in no certain order.
class queue_push {
 public:
  queue_push(std::size_t n, ds::shader_id shaders) : n_(n), sizes_(shaders), queues_(n * shaders) {}

  void operator()(std::uint8_t const* ids) {
    check_cuda(cudaMemsetAsync(raw(sizes_), 0, sizes_.size() * sizeof(std::uint32_t), stream()));
    for_each_request(n_, pushes(ids));
  }

  /// Whether every request lies in the queue of its shader, once.
  bool is_right(std::uint8_t const* ids) {
    array<std::uint8_t> queued(n_);
    auto const shaders = static_cast<ds::shader_id>(sizes_.size());
    for_each_request(n_, mark_queued{pushes(ids), shaders, raw(queued)});
    return thrust::reduce(policy(), sizes_.begin(), sizes_.end(), std::size_t{0}) == n_ &&
           thrust::count(policy(), queued.begin(), queued.end(), std::uint8_t{0}) == 0;
  }

 private:
  push pushes(std::uint8_t const* ids) { return {ids, n_, raw(sizes_), raw(queues_)}; }

  std::size_t n_;
  array<std::uint32_t> sizes_;
  array<request_index> queues_;
};

#endif

}  // namespace bench
