// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/for_each.h>
#include <thrust/iterator/counting_iterator.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <deferred_shade/detail/cpu/segment.hpp>
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
    thrust::for_each_n(exec, thrust::counting_iterator<request_index>(0), std::size_t{n},
                       [ids, &shader](request_index i) {
                         if (detail::shader_of(ids, i, sizeof...(Shaders)) == decltype(id)::value)
                           static_cast<void>(shader(i));
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
    if constexpr (is_packable<type>) {
      // Small chunks for a small segment, so that every worker has some.
      std::size_t const chunk = size < 16384 ? 32 : packed_lanes<type>;
      request_index const* const segment = group.permutation + begin;
      thrust::for_each_n(exec, thrust::counting_iterator<std::uint32_t>(0),
                         (size + chunk - 1) / chunk,
                         [&shader, segment, size, chunk](std::uint32_t c) {
                           std::size_t const from = c * chunk;
                           std::size_t const count = (std::min)(chunk, size - from);
                           // What comes next is prefetched: the next chunk, mostly the same
                           // worker's.
                           run_segment(
                               shader, count, [=](std::size_t j) { return segment[from + j]; },
                               [=, &shader](std::size_t j) {
                                 std::size_t const next = from + chunk + j;
                                 if (next < size) prefetch_records(shader, segment[next]);
                               });
                         });
    } else {
      thrust::for_each_n(exec, group.permutation + begin, size,
                         [&shader](request_index i) { static_cast<void>(shader(i)); });
    }
  });
}

}  // namespace deferred_shade::detail
