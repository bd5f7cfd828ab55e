// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cuda_pipeline.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/begin_tile.hpp>
#include <deferred_shade/detail/cuda/call.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/staging.hpp>
#include <deferred_shade/detail/cuda/tile_rows.hpp>
#include <deferred_shade/detail/cuda/tile_sort.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// Runs a tile of record shaders. Requests are loaded into shared memory in memory order and shaded
/// in shader order. The results take the place of the requests and are stored in memory order.
/// `one_source`: all shaders have the same pointer as source.
template <std::uint32_t Threads, std::uint32_t Items, class Count, class Ids, class... Shaders>
__global__ void __launch_bounds__(Threads)
    staged_kernel(Count n, Ids ids, shader_list<Shaders...> const __grid_constant__ shaders,
                  bool one_source) {
  using records = staging<Shaders...>;
  using request = typename records::request;
  using result = typename records::result;
  using source_type = typename records::source_type;
  using sink_type = typename records::sink_type;
  using sort = tile_sort<sizeof...(Shaders), Threads, Items>;
  extern __shared__ uint4 slots[];
  __shared__ typename sort::temporary_storage temporary;
  __shared__ std::uint32_t starts[sort::columns];
  __shared__ tile_rows<sort> rows;
  __shared__ std::uint16_t order[sort::size];      // the positions of the requests, sorted
  __shared__ std::uint16_t shader_at[sort::size];  // the shader of the request at a position
  __shared__ alignas(source_type) unsigned char sources[sizeof...(Shaders)][sizeof(source_type)];
  __shared__ alignas(sink_type) unsigned char sinks[sizeof...(Shaders)][sizeof(sink_type)];
  auto const slot = [](std::uint32_t position) {
    return reinterpret_cast<char*>(slots) + position * records::slot;
  };

  request_index first;
  std::uint32_t size;
  if (!detail::begin_tile<sort::size>(n, first, size)) return;

  if constexpr (records::copies_words) {
    if (one_source) {
      auto const* const words =
          reinterpret_cast<uint4 const*>(shaders.template get<0>().source + first);
      auto const count = static_cast<std::uint32_t>(size * (records::slot / sizeof(uint4)));
      for (std::uint32_t w = threadIdx.x; w < count; w += Threads) {
        __pipeline_memcpy_async(&slots[w], &words[w], sizeof(uint4));
      }
      __pipeline_commit();
    }
  }
  if (threadIdx.x == 0) {
    shaders.for_each([&](auto id, auto const& shader) {
      std::memcpy(sources[decltype(id)::value], detail::address_of(shader.source),
                  sizeof(shader.source));
      std::memcpy(sinks[decltype(id)::value], detail::address_of(shader.sink), sizeof(shader.sink));
    });
  }
  std::uint32_t keys[Items];
  std::uint32_t places[Items];
  sort::load(ids, first, size, keys);
  sort::find_places(temporary, keys, places, starts);
  __syncthreads();
#pragma unroll
  for (std::uint32_t item = 0; item < Items; ++item) {
    std::uint32_t const position = sort::position(item);
    if (sort::has_place(keys[item])) order[places[item]] = static_cast<std::uint16_t>(position);
    shader_at[position] = static_cast<std::uint16_t>(keys[item]);
  }
  rows.find(starts);
  if (!(records::copies_words && one_source)) {
    __syncthreads();
    for (std::uint32_t p = threadIdx.x; p < size; p += Threads) {
      if (shader_at[p] == sizeof...(Shaders)) continue;
      auto const& source = *reinterpret_cast<source_type const*>(sources[shader_at[p]]);
      *reinterpret_cast<request*>(slot(p)) = detail::load_on_device(source, first + p);
    }
  }
  __pipeline_wait_prior(0);
  __syncthreads();
  rows.for_each(starts, [&](shader_id id, std::uint32_t place) {
    char* const memory = slot(order[place]);
    request const r = *reinterpret_cast<request const*>(memory);
    shaders.visit(
        id, [&](auto const& shader) { *reinterpret_cast<result*>(memory) = shader.function(r); });
  });
  __syncthreads();
  for (std::uint32_t p = threadIdx.x; p < size; p += Threads) {
    if (shader_at[p] == sizeof...(Shaders)) continue;
    detail::store_on_device(*reinterpret_cast<sink_type const*>(sinks[shader_at[p]]), first + p,
                            *reinterpret_cast<result const*>(slot(p)));
  }
}

template <class Tuning, class Policy, class Count, class Ids, class... Shaders>
void run_staged(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders) {
  using records = staging<Shaders...>;
  constexpr std::uint32_t items = Tuning::staged_items(records::slot);
  constexpr std::uint32_t threads = Tuning::staged_threads(sizeof...(Shaders));
  constexpr std::size_t tile = threads * items;
  bool one_source = records::copies_words;
  if constexpr (records::copies_words) {
    shaders.for_each([&](auto, auto const& shader) {
      one_source = one_source && shader.source == shaders.template get<0>().source;
    });
  }
  detail::launch<&staged_kernel<threads, items, Count, Ids, Shaders...>>(
      "local_sort_then_dispatch", detail::stream_of(exec),
      {(detail::maximum_of(n) + tile - 1) / tile, threads, tile * records::slot}, n, ids, shaders,
      one_source);
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
