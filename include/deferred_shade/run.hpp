// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/config.hpp>  // first: it refuses what is too old

#include <deferred_shade/detail/requirements_of_run.hpp>
#include <deferred_shade/items.hpp>
#include <deferred_shade/loop.hpp>
#include <deferred_shade/shader_table.hpp>

namespace deferred_shade {

/// Runs items through stages until all have ended: the whole loop of a renderer.
///
/// A stage is a shader that returns the id of the stage that its request needs next, an integer or
/// an enumerator of at most 32 bits; an id outside the table ends the request. A stage may be a
/// record shader: its sink stores the result and returns the id. Requests live in slots: entries of
/// the renderer's arrays. A slot whose request has ended takes the next item.
///
/// - `exec`: thrust::cpp::par, thrust::omp::par or thrust::tbb::par. The call returns when the loop
///   has ended.
/// - `loop`: one of this library (loop.hpp), or any function object that can be called with `exec`
///   and the arguments below.
/// - `all`: the items, the number of slots, and for a loop that is watched or stopped, its
///   run_control.
/// - `begin`: `begin(slot, k)` makes `slot` the request of item `k`, and returns the id of its
///   first stage.
/// - `stages`: a table of stages. As shaders, they are cheap to copy, run concurrently, do not
///   throw, and write only what belongs to their own slot or item.
/// - `scratch`: a workspace, an `observed` or `tuned` one included. It is reserved for what the
///   loop needs; nothing is allocated once it has seen as many slots.
///
/// Every item begins once and ends once. Which slot an item gets, and what runs at the same time,
/// depends on the loop, on `exec` and on the number of slots. What is computed for it does not, if
/// the renderer keys its random numbers and its results by the item.
///
/// Throws std::invalid_argument if there are items but no slots, and std::length_error if `slots`
/// exceeds max_requests or the number of the last item does not fit in 64 bits: no item has begun
/// then. Throws what the workspace's allocator throws.
///
///     ds::shader_table stages{extend{paths}, matte{paths}, glass{paths}};
///     ds::run(thrust::omp::par, ds::wavefront{}, ds::items{samples, slots}, begin{paths}, stages,
///             scratch);
template <class Policy, class Loop, class Begin, class... Stages, class Workspace>
void run(Policy const& exec, Loop const& loop, items const& all, Begin const& begin,
         shader_table<Stages...> const& stages, Workspace& scratch) {
  using required = detail::requirements_of_run<Policy, Begin, Workspace, Stages...>;
  if constexpr (required::met) {
    detail::check_items(all);
    if (all.control != nullptr) all.control->start();
    if (all.count == 0) return;
    [[maybe_unused]] auto const running = scratch.begin_phase({"run"});
    loop(exec, all, begin, stages, scratch);
  }
}

}  // namespace deferred_shade
