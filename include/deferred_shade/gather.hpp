// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/config.hpp>  // first: it refuses what is too old

#include <deferred_shade/detail/cpu/gather.hpp>
#include <deferred_shade/detail/moved.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>
#ifdef __CUDACC__
#include <deferred_shade/detail/cuda/gather.hpp>
#endif

namespace deferred_shade {

/// Puts arrays of a batch into an order, all of them in one pass: `to[p] = from[permutation[p]]`
/// for p from 0 to n - 1. What `to` holds from n on stays.
///
/// - `exec`: as for `shade`. On CUDA, nothing waits for the stream or for the host.
/// - `order`: `groups.live()`, the requests that name a shader, or `groups.all()`, of what `group`
///   returns; or any other order, in which each request stands at most once.
/// - `arrays`: a moved{from, to} for each array, of elements of any size and alignment that are
///   copied by bytes (is_copied_by_bytes). No `to` overlaps any array that is read.
///
/// A renderer keeps each array twice, and `to` becomes the array of its next batch: its paths then
/// lie in the order of their shaders, without those that have ended, and `order.n` is their number.
/// It lies in the workspace of `group`: the next batch takes another one, in turns.
///
/// Throws std::invalid_argument if a pointer is null or `to` is `from`; on a CPU, std::length_error
/// if the number of requests exceeds its maximum; and cuda_error if CUDA refuses the launch.
///
///     auto const groups = ds::group(exec, n, ids, materials, scratch[bounce % 2]);
///     ds::gather(exec, groups.live(), ds::moved{paths, next_paths}, ds::moved{hits, next_hits});
///     n = groups.live().n;
template <class Policy, class... T>
void gather(Policy const& exec, request_order order, moved<T>... arrays) {
  detail::check_moved<Policy>("gather", order, arrays...);
  if constexpr (detail::can_move<Policy, T...>) {
    detail::move_arrays<false>(detail::system_of<Policy>{}, exec, order, arrays...);
  }
}

/// The way back: `to[permutation[p]] = from[p]`. Elements of `to` that `order` does not name stay.
/// All else is as for `gather`.
template <class Policy, class... T>
void scatter(Policy const& exec, request_order order, moved<T>... arrays) {
  detail::check_moved<Policy>("scatter", order, arrays...);
  if constexpr (detail::can_move<Policy, T...>) {
    detail::move_arrays<true>(detail::system_of<Policy>{}, exec, order, arrays...);
  }
}

}  // namespace deferred_shade
