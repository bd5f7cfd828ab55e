// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/config.hpp>  // first: it refuses what is too old

#include <algorithm>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <deferred_shade/detail/checked_count.hpp>
#include <deferred_shade/detail/cpu/block_partition.hpp>
#include <deferred_shade/detail/fail.hpp>
#include <deferred_shade/detail/ids.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/detail/work.hpp>
#include <deferred_shade/types.hpp>
#ifdef __CUDACC__
#include <deferred_shade/detail/cuda/host_copy.hpp>
#endif

namespace deferred_shade {
namespace detail {

inline void check_width(std::string const& caller, std::uint32_t width) {
  if (width == 0) {
    detail::fail<std::invalid_argument>("deferred_shade::" + caller +
                                        ": a group of width 0 has no lanes");
  }
}

/// Calls `f(policy, count, ids)` with a policy for a CPU, `n` on the host, and ids that the host
/// can read.
template <class Policy, class Count, class Ids, class Function>
auto on_host(host_system, std::string const& caller, Policy const& exec, Count n, Ids ids,
             Function const& f) {
  request_index const count = detail::checked_count(caller, n);
  detail::check_array(caller, "ids", ids, count);
  return f(exec, count, ids);
}
#ifdef __CUDACC__
template <class Policy, class Count, class Ids, class Function>
auto on_host(cuda_system, std::string const& caller, Policy const& exec, Count n, Ids ids,
             Function const& f) {
  cudaStream_t const stream = detail::stream_of(exec);
  request_index const count = detail::count_on_host(caller, stream, n);
  detail::check_array(caller, "ids", ids, count);
  std::vector<shader_id> const copy = detail::ids_on_host(stream, count, ids);
  return f(thrust::cpp::par, count, copy.data());
}
#endif

}  // namespace detail

/// What a group of lanes pays for divergence. `costs[k]` is the cost of shader k, in any unit, for
/// `shaders` shaders; the host reads it. `width` is the number of consecutive requests that share a
/// program counter. The cost of a shader that occurs is finite and not negative. Other costs are
/// not read.
struct efficiency_model {
  double const* costs;
  shader_id shaders;
  std::uint32_t width = 32;
};

/// How often each shader occurs in a batch, in requests and in groups of `width` requests.
struct occurrences {
  /// requests[k]: the requests of shader k; requests[shaders]: those that name none.
  std::vector<std::uint64_t> requests;
  /// groups[k]: the groups in which shader k occurs.
  std::vector<std::uint64_t> groups;

  /// The shaders that occur, for specialized and shader_table::expecting. Throws
  /// std::invalid_argument if the table that was counted did not have `Shaders` shaders.
  template <shader_id Shaders>
  std::bitset<Shaders> occurring() const {
    if (groups.size() != Shaders) {
      detail::fail<std::invalid_argument>("deferred_shade::occurrences::occurring: " +
                                          std::to_string(groups.size()) + " shaders were counted");
    }
    std::bitset<Shaders> result;
    for (shader_id k = 0; k < Shaders; ++k) result[k] = requests[k] > 0;
    return result;
  }
};

namespace detail {

template <class Policy, class Ids>
occurrences occurrences_of(Policy const& exec, std::size_t size, Ids const& ids, shader_id shaders,
                           std::uint32_t width) {
  // Every block has its own counters and whole groups. So the sums are exact, whoever owns a block.
  block_partition const blocks(size, shaders, width);
  std::size_t const columns = std::size_t{shaders} + 1;
  std::vector<std::uint64_t> requests(blocks.count() * columns), groups = requests;
  std::vector<std::uint64_t> last_group = requests;  // its number + 1; 0: none yet
  detail::for_each_block(exec, blocks, [&](std::size_t b) {
    std::size_t const row = b * columns;
    for (std::size_t i = blocks.begin(b); i < blocks.end(b); ++i) {
      std::size_t const k = row + detail::shader_of(ids, static_cast<request_index>(i), shaders);
      std::uint64_t const group = i / width + 1;
      ++requests[k];
      if (last_group[k] != group) ++groups[k];
      last_group[k] = group;
    }
  });

  occurrences total{std::vector<std::uint64_t>(columns), std::vector<std::uint64_t>(shaders)};
  for (std::size_t b = 0; b < blocks.count(); ++b) {
    for (std::size_t k = 0; k < columns; ++k) total.requests[k] += requests[b * columns + k];
    for (std::size_t k = 0; k < shaders; ++k) total.groups[k] += groups[b * columns + k];
  }
  return total;
}

/// Throws if the cost of a shader that occurs is negative, infinite or NaN.
inline void check_costs(std::string const& caller, occurrences const& count,
                        efficiency_model const& model) {
  for (shader_id k = 0; k < model.shaders; ++k) {
    if (count.requests[k] == 0) continue;
    detail::check_array(caller, "costs", model.costs, 1);
    double const cost = model.costs[k];
    if (!(cost >= 0 && cost <= (std::numeric_limits<double>::max)())) {
      detail::fail<std::invalid_argument>(
          "deferred_shade::" + caller + ": costs[" + std::to_string(k) + "] is " +
          std::to_string(cost) +
          ", and the cost of a shader that occurs is finite and not negative");
    }
  }
}

template <class Policy, class Ids>
void efficiency_of_groups(Policy const& exec, std::size_t size, Ids const& ids,
                          efficiency_model const& model, float* efficiency) {
  block_partition const blocks(size, model.shaders, model.width);
  std::vector<std::size_t> last_group(blocks.count() * model.shaders);
  detail::for_each_block(exec, blocks, [&](std::size_t b) {
    std::size_t* const last = last_group.data() + b * model.shaders;
    for (std::size_t first = blocks.begin(b); first < blocks.end(b); first += model.width) {
      std::size_t const group = first / model.width;
      auto const sum = [&](double scale) {
        work result;
        // Each sum has a mark of its own for what it has seen.
        std::size_t const seen = 2 * group + (scale == 1.0 ? 1 : 2);
        for (std::size_t i = first; i < (std::min)(size, first + model.width); ++i) {
          shader_id const k = detail::shader_of(ids, static_cast<request_index>(i), model.shaders);
          if (k == model.shaders) continue;
          double const cost = model.costs[k] * scale;
          result.useful += cost;
          if (last[k] != seen) result.held += cost;
          last[k] = seen;
        }
        return result;
      };
      efficiency[group] = static_cast<float>(
          detail::finite_work(model.width, sum)
              .efficiency(model.width, std::numeric_limits<double>::quiet_NaN()));
    }
  });
}

}  // namespace detail

/// Counts the shaders of `n` requests, in groups of `width` requests; the last group may be
/// incomplete.
///
/// For reports, not for every batch: it allocates. On CUDA it waits for the stream and copies the
/// ids to the host, which counts them. Throws std::invalid_argument if `width` is 0, `n` negative,
/// or `ids` null while `n` is not 0; std::length_error if `n` exceeds `max_requests`;
/// std::bad_alloc; and cuda_error if CUDA refuses.
template <class Policy, class Count, class Ids>
occurrences count_occurrences(Policy const& exec, Count n, Ids ids, shader_id shaders,
                              std::uint32_t width = 32) {
  if constexpr (detail::requirements_of_ids<Ids>::met) {
    detail::check_width("count_occurrences", width);
    return detail::on_host(detail::system_of<Policy>{}, "count_occurrences", exec, n, ids,
                           [&](auto const& policy, std::size_t size, auto const& host_ids) {
                             return detail::occurrences_of(policy, size, host_ids, shaders, width);
                           });
  } else {
    return {};
  }
}

/// The heterogeneous efficiency of `n` requests in the order in which lanes take them: the work
/// that shaders ask for, divided by the work for which lanes are held. This is
///
///     sum(n_i |A_i|) / (width * sum(min(n_i, 1) |A_i|)),
///
/// summed over all groups of `width` requests and all shaders i. n_i is the number of requests of
/// shader i in the group, and |A_i| is its cost (Hoberock et al., HPG 2009, section 5). 1 means no
/// divergence; it is also the result if no shader runs, or if all that run cost 0. Lanes whose id
/// names no shader count as idle.
///
/// For reports: it allocates. Throws what count_occurrences throws, and std::invalid_argument if
/// the cost of a shader that occurs is negative, infinite or NaN, or if `costs` is null then.
template <class Policy, class Count, class Ids>
double heterogeneous_efficiency(Policy const& exec, Count n, Ids ids,
                                efficiency_model const& model) {
  occurrences const count =
      deferred_shade::count_occurrences(exec, n, ids, model.shaders, model.width);
  detail::check_costs("heterogeneous_efficiency", count, model);
  auto const sum = [&](double scale) {
    detail::work result;
    for (shader_id k = 0; k < model.shaders; ++k) {
      if (count.requests[k] == 0) continue;
      double const cost = model.costs[k] * scale;
      result.useful += static_cast<double>(count.requests[k]) * cost;
      result.held += static_cast<double>(count.groups[k]) * cost;
    }
    return result;
  };
  return detail::finite_work(model.width, sum).efficiency(model.width, 1.0);
}

/// Writes the heterogeneous efficiency of every group to `efficiency`, an array of the host: ceil(n
/// / width) values, NaN for a group in which no shader runs or all that run cost 0.
///
/// Allocates. Throws what heterogeneous_efficiency throws, and std::invalid_argument if
/// `efficiency` is null while `n` is not 0. Nothing is written then.
template <class Policy, class Count, class Ids>
void group_efficiency(Policy const& exec, Count n, Ids ids, efficiency_model const& model,
                      float* efficiency) {
  detail::check_width("group_efficiency", model.width);
  detail::on_host(detail::system_of<Policy>{}, "group_efficiency", exec, n, ids,
                  [&](auto const& policy, std::size_t size, auto const& host_ids) {
                    detail::check_array("group_efficiency", "efficiency", efficiency,
                                        static_cast<request_index>(size));
                    auto const count =
                        detail::occurrences_of(policy, size, host_ids, model.shaders, model.width);
                    detail::check_costs("group_efficiency", count, model);
                    detail::efficiency_of_groups(policy, size, host_ids, model, efficiency);
                  });
}

}  // namespace deferred_shade
