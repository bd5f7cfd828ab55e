// SPDX-License-Identifier: Apache-2.0
// Kernels of a renderer's own, over batches that the library groups: one kernel for each material,
// or one for all. Nothing waits for the host. Paths that have ended are gone after each bounce.
#include <thrust/device_vector.h>
#include <thrust/host_vector.h>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <deferred_shade/deferred_shade.hpp>
#include <utility>

namespace ds = deferred_shade;

constexpr int materials = 3;
constexpr int bounces = 6;

struct path {
  std::uint32_t pixel, random;
  float weight;
};
/// The arrays of a batch. The renderer keeps them twice.
struct arrays {
  path* paths;
  std::uint8_t* ids;
};

/// Moves a path on. Returns the material that it hits next, or 255 if it has ended.
DEFERRED_SHADE_HOST_DEVICE inline std::uint8_t shade(int material, path& p) {
  p.weight *= 1.0F - 0.125F * static_cast<float>(material);
  p.random = p.random * 1664525U + 1013904223U;
  return static_cast<std::uint8_t>(p.random >> 28 == 0 ? 255 : (p.random >> 16) % materials);
}

__device__ std::size_t this_thread() { return std::size_t{blockIdx.x} * blockDim.x + threadIdx.x; }
__device__ std::size_t all_threads() { return std::size_t{gridDim.x} * blockDim.x; }

/// One material: the places p of its segment. A path is read through the permutation. What it
/// becomes is written to its place.
template <int Material>
__global__ void shade_segment(ds::request_groups groups, arrays now, arrays next) {
  std::size_t const end = groups.offsets[Material + 1];
  for (std::size_t p = groups.offsets[Material] + this_thread(); p < end; p += all_threads()) {
    path here = now.paths[groups.permutation[p]];
    next.ids[p] = shade(Material, here);
    next.paths[p] = here;
  }
}

/// All materials: neighbouring threads find the same one, except where two segments meet.
__global__ void shade_all(ds::request_groups groups, arrays now, arrays next) {
  std::size_t const end = groups.offsets[materials];
  int material = 0;
  for (std::size_t p = this_thread(); p < end; p += all_threads()) {
    while (p >= groups.offsets[material + 1]) ++material;
    path here = now.paths[groups.permutation[p]];
    next.ids[p] = shade(material, here);
    next.paths[p] = here;
  }
}

/// The last segment: paths that have ended.
__global__ void retire(ds::request_groups groups, path const* paths, float* film) {
  std::size_t const end = groups.offsets[materials + 1];
  for (std::size_t p = groups.offsets[materials] + this_thread(); p < end; p += all_threads()) {
    path const& here = paths[groups.permutation[p]];
    film[here.pixel] = here.weight;
  }
}

void render(bool one_kernel, cudaStream_t stream, int n, arrays now, arrays next, float* film) {
  constexpr int blocks = 512, threads = 256;
  auto const exec = thrust::cuda::par_nosync.on(stream);
  ds::workspace<ds::cuda_allocator<std::byte>> scratch[2];
  auto const bytes = ds::by_bucket::workspace_bytes(exec, static_cast<std::size_t>(n), materials);
  for (auto& s : scratch) s.reserve_bytes(bytes);  // nothing allocates from here on

  auto groups = ds::group(exec, n, now.ids, materials, scratch[0]);
  for (int b = 1; b <= bounces; ++b) {
    if (one_kernel) {
      shade_all<<<blocks, threads, 0, stream>>>(groups, now, next);
    } else {
      shade_segment<0><<<blocks, threads, 0, stream>>>(groups, now, next);
      shade_segment<1><<<blocks, threads, 0, stream>>>(groups, now, next);
      shade_segment<2><<<blocks, threads, 0, stream>>>(groups, now, next);
    }
    std::swap(now, next);
    // The workspaces take turns: live().n is read from the other one.
    groups = ds::group(exec, groups.live().n, now.ids, materials, scratch[b % 2]);
    retire<<<blocks, threads, 0, stream>>>(groups, now.paths, film);
  }
}

/// Renders on the GPU and compares with a loop over one path at a time.
bool is_right(bool one_kernel) {
  std::uint32_t const n = 100000;
  thrust::host_vector<path> paths(n);
  thrust::host_vector<std::uint8_t> ids(n);
  thrust::host_vector<float> expected(n, 0.0F);
  for (std::uint32_t i = 0; i < n; ++i) {
    paths[i] = {i, i * 2654435761U, 1.0F};
    ids[i] = static_cast<std::uint8_t>(i % materials);
    path p = paths[i];
    std::uint8_t id = ids[i];
    for (int b = 0; b < bounces && id < materials; ++b) id = shade(id, p);
    if (id >= materials) expected[i] = p.weight;
  }
  thrust::device_vector<path> now = paths, next(n);
  thrust::device_vector<std::uint8_t> now_ids = ids, next_ids(n);
  thrust::device_vector<float> film(n, 0.0F);
  cudaStream_t stream{};
  cudaStreamCreate(&stream);
  render(one_kernel, stream, n, {now.data().get(), now_ids.data().get()},
         {next.data().get(), next_ids.data().get()}, film.data().get());
  bool const ran = cudaStreamSynchronize(stream) == cudaSuccess;
  cudaStreamDestroy(stream);
  return ran && thrust::host_vector<float>(film) == expected;
}

int main() {
  bool const by_segments = is_right(false);
  bool const by_one_kernel = is_right(true);
  std::printf("one kernel for each material: %s, one for all: %s\n",
              by_segments ? "right" : "wrong", by_one_kernel ? "right" : "wrong");
  return by_segments && by_one_kernel ? 0 : 1;
}
