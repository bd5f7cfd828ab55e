// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <deferred_shade/blocks.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade {

/// What a group of lanes pays for divergence: `costs[k]` is the cost of shader k, in any unit, and
/// `width` is the number of consecutive requests that share a program counter.
struct efficiency_model {
  double const* costs;
  shader_id shaders;
  std::uint32_t width = 32;
};

/// How often each shader occurs in a wave, in requests and in groups of `width` requests.
struct occurrences {
  /// requests[k]: the requests of shader k; requests[shaders]: those that name none.
  std::vector<std::uint64_t> requests;
  /// groups[k]: the groups in which shader k occurs.
  std::vector<std::uint64_t> groups;
};

/// Counts shaders in `n` requests, in groups of `width`; the last group may be incomplete.
///
/// For reports, not for every wave: allocates, and returns to the host. Throws
/// std::invalid_argument where `width` is 0.
template <class Policy, class Ids>
occurrences count_occurrences(Policy const& exec, request_index n, Ids ids, shader_id shaders,
                              std::uint32_t width = 32) {
  if (width == 0) {
    throw std::invalid_argument("deferred_shade::count_occurrences: width is 0");
  }
  // A block is a whole number of groups; each has its own counters, so that the sums are exact and
  // independent of who owns which block.
  std::size_t const all_groups = (std::size_t{n} + width - 1) / width;
  detail::block_partition const blocks(all_groups, shaders);
  std::size_t const columns = std::size_t{shaders} + 1;
  std::vector<occurrences> partial(blocks.count());
  detail::for_each_block(exec, blocks, [=, &partial](std::size_t b) {
    occurrences count{std::vector<std::uint64_t>(columns), std::vector<std::uint64_t>(columns)};
    std::vector<std::uint64_t> last_group(columns);  // one more than the group; 0: none yet
    for (std::size_t g = blocks.begin(b); g < blocks.end(b); ++g) {
      std::size_t const end = std::min(std::size_t{n}, (g + 1) * width);
      for (std::size_t i = g * width; i < end; ++i) {
        shader_id const k = shader_of(ids, static_cast<request_index>(i), shaders);
        ++count.requests[k];
        if (last_group[k] != g + 1) ++count.groups[k];
        last_group[k] = g + 1;
      }
    }
    partial[b] = std::move(count);
  });

  occurrences total{std::vector<std::uint64_t>(columns), std::vector<std::uint64_t>(shaders)};
  for (occurrences const& count : partial) {
    for (std::size_t k = 0; k < columns; ++k) total.requests[k] += count.requests[k];
    for (std::size_t k = 0; k < shaders; ++k) total.groups[k] += count.groups[k];
  }
  return total;
}

/// The heterogeneous efficiency of `n` requests in the order in which lanes take them: the work
/// that shaders ask for over the work that the lanes are held for,
///
///     sum(n_i |A_i|) / (width * sum(min(n_i, 1) |A_i|)),
///
/// summed over all groups of `width` requests and all shaders i, where n_i counts the requests of
/// shader i in the group and |A_i| is its cost (Hoberock et al., HPG 2009, section 5). 1 is a wave
/// without divergence; a wave in which no shader runs wastes nothing and has 1, too. Lanes whose id
/// names no shader are idle.
///
/// For reports: allocates. Throws std::invalid_argument where the width is 0.
template <class Policy, class Ids>
double heterogeneous_efficiency(Policy const& exec, request_index n, Ids ids,
                                efficiency_model const& model) {
  occurrences const count = count_occurrences(exec, n, ids, model.shaders, model.width);
  double useful = 0;
  double held = 0;
  for (shader_id k = 0; k < model.shaders; ++k) {
    useful += static_cast<double>(count.requests[k]) * model.costs[k];
    held += static_cast<double>(count.groups[k]) * model.costs[k];
  }
  return held > 0 ? useful / (model.width * held) : 1.0;
}

/// The heterogeneous efficiency of every group on its own: writes ceil(n / width) values to
/// `efficiency`, NaN for a group in which no shader runs.
///
/// Throws std::invalid_argument where the width is 0.
template <class Policy, class Ids>
void group_efficiency(Policy const& exec, request_index n, Ids ids, efficiency_model const& model,
                      float* efficiency) {
  if (model.width == 0) {
    throw std::invalid_argument("deferred_shade::group_efficiency: the width is 0");
  }
  std::size_t const groups = (std::size_t{n} + model.width - 1) / model.width;
  detail::block_partition const blocks(groups, 0);
  detail::for_each_block(exec, blocks, [=](std::size_t b) {
    std::vector<std::uint64_t> last_group(std::size_t{model.shaders} + 1);
    for (std::size_t g = blocks.begin(b); g < blocks.end(b); ++g) {
      double useful = 0;
      double held = 0;
      std::size_t const end = std::min(std::size_t{n}, (g + 1) * model.width);
      for (std::size_t i = g * model.width; i < end; ++i) {
        shader_id const k = shader_of(ids, static_cast<request_index>(i), model.shaders);
        if (k == model.shaders) continue;
        useful += model.costs[k];
        if (last_group[k] != g + 1) held += model.costs[k];
        last_group[k] = g + 1;
      }
      efficiency[g] = held > 0 ? static_cast<float>(useful / (model.width * held))
                               : std::numeric_limits<float>::quiet_NaN();
    }
  });
}

}  // namespace deferred_shade
