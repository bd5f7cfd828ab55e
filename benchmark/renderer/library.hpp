// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deferred_shade/deferred_shade.hpp>
#include <utility>

#include "loops.hpp"

// The same loop with the library.

namespace renderer {

namespace ds = deferred_shade;

/// One shader of the table for `shade`: paths stay where they are.
template <std::uint32_t Materials, int Material>
struct in_place {
  views at;
  scene in;
  __device__ void operator()(request_index i) const {
    path p = at.paths[i];
    hit h = at.hits[i];
    // The ids of a batch are read while it runs: the next ones go elsewhere.
    next[i] = shade_hit<Material, Materials>(p, h, in);
    at.paths[i] = p;
    at.hits[i] = h;
  }
  std::uint8_t* next;
};

template <std::uint32_t Materials, int... All>
auto table_in_place(frame& f, std::uint8_t* next, std::integer_sequence<int, All...>) {
  return ds::shader_table{in_place<Materials, All>{f.now.all(), f.in, next}...};
}

/// `shade` by a schedule: paths that have ended stay.
template <std::uint32_t Materials, class Schedule>
struct scheduled {
  ds::workspace<ds::cuda_allocator<std::byte>> scratch{};
  void operator()(frame& f) {
    std::uint8_t* ids = raw(f.now.ids);
    std::uint8_t* next = raw(f.next.ids);
    cudaMemsetAsync(next, ended, f.n, bench::stream());
    for (int b = 0; b < bounces; ++b) {
      auto const shaders =
          table_in_place<Materials>(f, next, std::make_integer_sequence<int, Materials>());
      ds::shade(bench::policy(), Schedule{}, f.n, ids, shaders, scratch);
      std::swap(ids, next);
      cudaMemsetAsync(next, ended, f.n, bench::stream());
    }
  }
};

/// Runs the requests of all segments, in their order: p is the place of one, and `from` says where
/// it is read. What it becomes is written to its place.
template <std::uint32_t Materials, class From>
__global__ void shade_segments(request_index const* offsets, From from, views to, scene in) {
  std::size_t const p = std::size_t{blockIdx.x} * blockDim.x + threadIdx.x;
  if (p >= offsets[Materials]) return;
  std::uint32_t id = 0;
  while (p >= offsets[id + 1]) ++id;
  auto const [paths, hits, i] = from.at(p);
  path path_here = paths[i];
  hit hit_here = hits[i];
  to.ids[p] = shade_by_switch<Materials>(id, path_here, hit_here, in);
  to.paths[p] = path_here;
  to.hits[p] = hit_here;
}

struct place {
  path const* paths;
  hit const* hits;
  std::size_t i;
};
/// Read through the permutation.
struct through {
  request_index const* permutation;
  path const* paths;
  hit const* hits;
  __device__ place at(std::size_t p) const { return {paths, hits, permutation[p]}; }
};
/// Read where `gather` has put it.
struct gathered {
  path const* paths;
  hit const* hits;
  __device__ place at(std::size_t p) const { return {paths, hits, p}; }
};

/// Shades paths where they lie, as many as there are.
template <std::uint32_t Materials>
struct shade_some_in_place {
  shade_in_place<Materials> shade;
  request_index const* count;
  __device__ void operator()(request_index i) const {
    if (count == nullptr || i < *count) shade(i);
  }
};

/// Group by material, and then shade in that order, into the other arrays: paths that have ended
/// are gone after each bounce, and nothing is read by the host. `Gathers`: by `gather`, for kernels
/// that expect their paths side by side; else the kernel itself reads through the permutation. With
/// one material, grouping only compacts: every second bounce is shaded in place.
template <std::uint32_t Materials, bool Gathers>
class grouped {
  using workspace = ds::workspace<ds::cuda_allocator<std::byte>>;

 public:
  void operator()(frame& f) {
    arrays* now = &f.now;
    arrays* next = &f.next;
    ds::request_groups groups{};
    for (int b = 0; b < bounces; ++b) {
      if (Materials == 1 && b % 2 == 0) {
        request_index const* const count = b == 0 ? nullptr : groups.live().n.pointer;
        bench::for_each_request(f.n, shade_some_in_place<Materials>{{now->all(), f.in}, count});
        continue;
      }
      // In turns: the number of requests lies in the workspace of the grouping before.
      workspace& scratch = scratch_[b / (Materials == 1 ? 2 : 1) % 2];
      auto const exec = bench::policy();
      bool const all = groups.permutation == nullptr;
      groups = all ? ds::group(exec, f.n, raw(now->ids), Materials, scratch)
                   : ds::group(exec, groups.live().n, raw(now->ids), Materials, scratch);
      shade(f, groups, *now, *next);
      std::swap(now, next);
    }
  }

 private:
  void shade(frame const& f, ds::request_groups const& groups, arrays& now, arrays& next) {
    auto const blocks = static_cast<unsigned>((f.n + 255) / 256);
    if constexpr (Gathers) {
      ds::gather(bench::policy(), groups.live(), ds::moved{raw(now.paths), raw(next.paths)},
                 ds::moved{raw(now.hits), raw(next.hits)});
      shade_segments<Materials><<<blocks, 256, 0, bench::stream()>>>(
          groups.offsets, gathered{raw(next.paths), raw(next.hits)}, next.all(), f.in);
    } else {
      shade_segments<Materials><<<blocks, 256, 0, bench::stream()>>>(
          groups.offsets, through{groups.permutation, raw(now.paths), raw(now.hits)}, next.all(),
          f.in);
    }
  }

  workspace scratch_[2];
};

}  // namespace renderer
