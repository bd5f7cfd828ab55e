// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <deferred_shade/detail/cpu/parallel_for.hpp>
#include <deferred_shade/detail/cpu/segment.hpp>
#include <deferred_shade/detail/cpu/tuning.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade::detail {

template <class Policy, class Ids, class... Shaders, class Workspace>
void run_explicit(host_system, Policy const& exec, request_index n, Ids ids,
                  shader_table<Shaders...> const& shaders, Workspace const& scratch) {
  auto const expected = shaders.expected();
  shaders.for_each([&](auto id, auto const& shader) {
    if (!expected[id]) return;
    [[maybe_unused]] auto const running = scratch.begin_phase({"shader", id});
    detail::for_each_request(exec, n, [ids, &shader](request_index i) {
      if (detail::shader_of(ids, i, sizeof...(Shaders)) == decltype(id)::value) {
        static_cast<void>(shader(i));
      }
    });
  });
}

/// Runs a record shader on the `size` requests of its segment, in packed chunks.
template <class Policy, class Shader>
void run_in_chunks(Policy const& exec, Shader const& shader, request_index const* segment,
                   std::size_t size) {
  std::size_t const chunk = size < small_segment ? small_chunk : packed_lanes<Shader>;
  detail::parallel_for(exec, (size + chunk - 1) / chunk, [=, &shader](std::size_t c) {
    std::size_t const from = c * chunk;
    std::size_t const count = (std::min)(chunk, size - from);
    // Prefetches the next chunk, which mostly is the same worker's.
    detail::run_segment(
        shader, count, [=](std::size_t j) { return segment[from + j]; },
        [=, &shader](std::size_t j) {
          std::size_t const next = from + chunk + j;
          if (next < size) detail::prefetch_records(shader, segment[next]);
        });
  });
}

template <class Policy, class... Shaders, class Workspace>
void run_explicit(host_system, Policy const& exec, grouping group,
                  shader_table<Shaders...> const& shaders, Workspace const& scratch) {
  auto const expected = shaders.expected();
  shaders.for_each([&](auto id, auto const& shader) {
    if (!expected[id]) return;
    request_index const begin = group.offsets[id];
    std::size_t const size = group.offsets[id + 1] - begin;
    if (size == 0) return;
    [[maybe_unused]] auto const running = scratch.begin_phase({"shader", id, size});
    using type = std::decay_t<decltype(shader)>;
    request_index const* const segment = group.permutation + begin;
    if constexpr (is_packable<type>) {
      detail::run_in_chunks(exec, shader, segment, size);
    } else {
      detail::for_each_request(exec, size, [&shader, segment](request_index p) {
        static_cast<void>(shader(segment[p]));
      });
    }
  });
}

}  // namespace deferred_shade::detail
