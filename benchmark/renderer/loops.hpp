// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/iterator/zip_iterator.h>
#include <thrust/partition.h>
#include <thrust/sort.h>
#include <thrust/tuple.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "batch.hpp"

// The ways that renderers loop over bounces. Each runs a frame that has begun; all of them leave
// the same film.

namespace renderer {

/// Shades a path in its place, unless it has ended.
template <std::uint32_t Materials>
struct shade_in_place {
  views at;
  scene in;
  __device__ std::uint8_t operator()(request_index i) const {
    std::uint8_t id = at.ids[i];
    if (id == ended) return id;
    path p = at.paths[i];
    hit h = at.hits[i];
    id = shade_by_switch<Materials>(id, p, h, in);
    at.paths[i] = p;
    at.hits[i] = h;
    at.ids[i] = id;
    return id;
  }
};

/// As they come: one kernel with a switch over all places, whether or not the path has ended.
template <std::uint32_t Materials>
struct unsorted {
  void operator()(frame& f) const {
    for (int b = 0; b < bounces; ++b) {
      bench::for_each_request(f.n, shade_in_place<Materials>{f.now.all(), f.in});
    }
  }
};

struct is_live {
  __host__ __device__ bool operator()(std::uint8_t id) const { return id != ended; }
};

/// Thrust: a partition of what goes on, of which the host reads the number, then a sort of the
/// structs by material, then the same kernel.
template <std::uint32_t Materials>
struct thrust_sort {
  void operator()(frame& f) const {
    std::size_t live = f.n;
    for (int b = 0; b < bounces && live > 0; ++b) {
      auto const structs =
          thrust::make_zip_iterator(thrust::make_tuple(f.now.paths.begin(), f.now.hits.begin()));
      if (Materials > 1) {
        thrust::sort_by_key(bench::policy(), f.now.ids.begin(),
                            f.now.ids.begin() + static_cast<std::ptrdiff_t>(live), structs);
      }
      bench::for_each_request(live, shade_in_place<Materials>{f.now.all(), f.in});
      auto const with_ids = thrust::make_zip_iterator(
          thrust::make_tuple(f.now.paths.begin(), f.now.hits.begin(), f.now.ids.begin()));
      auto const end = thrust::partition(
          bench::policy(), with_ids, with_ids + static_cast<std::ptrdiff_t>(live), has_live_id{});
      live = static_cast<std::size_t>(end - with_ids);
    }
  }

  struct has_live_id {
    template <class Tuple>
    __host__ __device__ bool operator()(Tuple const& t) const {
      return thrust::get<2>(t) != ended;
    }
  };
};

/// A queue of requests for each material.
struct queues {
  request_index* requests;  ///< `capacity` for each
  std::uint32_t* sizes;
  std::size_t capacity;

  /// Adds a request: one atomic operation for the lanes of a warp that add to the same queue.
  __device__ void push(std::uint8_t id, request_index i) const {
    unsigned const peers = __match_any_sync(__activemask(), id);
    unsigned const lane = threadIdx.x % 32;
    int const leader = __ffs(static_cast<int>(peers)) - 1;
    std::uint32_t first = 0;
    if (static_cast<int>(lane) == leader) {
      first = atomicAdd(&sizes[id], static_cast<std::uint32_t>(__popc(peers)));
    }
    first = __shfl_sync(peers, first, leader);
    auto const rank = static_cast<std::uint32_t>(__popc(peers & ((1U << lane) - 1)));
    requests[id * capacity + first + rank] = i;
  }
};

static __global__ void fill_queues(std::size_t n, std::uint8_t const* ids, queues to) {
  std::size_t const i = std::size_t{blockIdx.x} * blockDim.x + threadIdx.x;
  if (i < n) to.push(ids[i], static_cast<request_index>(i));
}

template <std::uint32_t Materials, int Material>
__global__ void run_queue(queues from, queues to, views at, scene in) {
  std::uint32_t const size = from.sizes[Material];
  for (std::uint32_t q = blockIdx.x * blockDim.x + threadIdx.x; q < size;
       q += gridDim.x * blockDim.x) {
    request_index const i = from.requests[Material * from.capacity + q];
    path p = at.paths[i];
    hit h = at.hits[i];
    std::uint8_t const id = shade_hit<Material, Materials>(p, h, in);
    at.paths[i] = p;
    at.hits[i] = h;
    if (id != ended) to.push(id, i);
  }
}

/// A queue per material, filled by atomics; one kernel per queue, with a grid that fills the GPU.
template <std::uint32_t Materials>
class material_queues {
 public:
  explicit material_queues(std::size_t n)
      : requests_(2 * n * Materials), sizes_(2 * Materials), n_(n) {}

  void operator()(frame& f) {
    cudaMemsetAsync(raw(sizes_), 0, 2 * Materials * sizeof(std::uint32_t), bench::stream());
    fill_queues<<<static_cast<unsigned>((n_ + 255) / 256), 256, 0, bench::stream()>>>(
        n_, raw(f.now.ids), half(0));
    for (int b = 0; b < bounces; ++b) {
      run_all<0>(half(b % 2), half(1 - b % 2), f);
      cudaMemsetAsync(half(b % 2).sizes, 0, Materials * sizeof(std::uint32_t), bench::stream());
    }
  }

 private:
  queues half(int which) {
    std::size_t const w = static_cast<std::size_t>(which);
    return {raw(requests_) + w * n_ * Materials, raw(sizes_) + w * Materials, n_};
  }

  template <int Material>
  void run_all(queues from, queues to, frame& f) {
    if constexpr (Material < static_cast<int>(Materials)) {
      auto const blocks = static_cast<unsigned>((std::min)(n_ / 256 + 1, std::size_t{132 * 8}));
      run_queue<Materials, Material>
          <<<blocks, 256, 0, bench::stream()>>>(from, to, f.now.all(), f.in);
      run_all<Material + 1>(from, to, f);
    }
  }

  array<request_index> requests_;
  array<std::uint32_t> sizes_;
  std::size_t n_;
};

}  // namespace renderer
