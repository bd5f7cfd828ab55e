// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <deferred_shade/detail/fail.hpp>
#include <deferred_shade/detail/requirements.hpp>
#include <deferred_shade/detail/stage_shaders.hpp>
#include <deferred_shade/items.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {

/// What `begin(slot, item)` returns, or void.
template <class Begin, class = void>
struct begun_by {
  using type = void;
};
template <class Begin>
struct begun_by<Begin, std::void_t<std::invoke_result_t<Begin const&, request_index, item_index>>> {
  using type = std::decay_t<std::invoke_result_t<Begin const&, request_index, item_index>>;
};

/// What `run` asks of its arguments.
template <class Policy, class Begin, class Workspace, class... Stages>
struct requirements_of_run {
 private:
  static constexpr bool callable = all_of<is_callable<Stages>::value...>();
  static constexpr bool exec = callable && has_system<Policy>;
  static constexpr bool on_cpu = exec && !std::is_same_v<system_of<Policy>, cuda_system>;
  static constexpr bool on_machine = on_cpu && all_of<!is_device_lambda<Stages>...>();
  static constexpr bool stages = on_machine && all_of<is_stage<Stages>...>();
  static constexpr bool begins = stages && detail::names_stage<typename begun_by<Begin>::type>();
  static constexpr bool checked = !exec || begins;
  using ids = shader_id const*;
  using checked_batch = std::integral_constant<
      std::size_t, sizeof(requirements_of_batch<checked, Policy, shader_id, ids, Workspace>)>;

 public:
  static constexpr bool met = facts_of_batch<begins, Policy, shader_id, ids, Workspace>::met;
  using value = std::bool_constant<met>;  // which clang computes here, and no later

  static_assert(!exec || on_cpu,
                "deferred_shade: run must have an exec for a CPU; for CUDA, call shade in a "
                "loop");
  static_assert(!on_cpu || on_machine,
                "deferred_shade: a stage must not be a lambda for __device__ alone; write [=] "
                "__host__ __device__ (...)");
  static_assert(!on_machine || stages,
                "deferred_shade: a stage must return the id of the next stage, an integer or an "
                "enumerator of at most 32 bits; the sink of a record stage returns it from "
                "sink(slot, result)");
  static_assert(
      !stages || begins,
      "deferred_shade: begin must be callable as begin(slot, item), by an operator() that "
      "is const, and return the id of the first stage");
};

/// Throws if a loop cannot run.
inline void check_items(items const& all) {
  if (all.count == 0) return;
  if (all.slots == 0) {
    detail::fail<std::invalid_argument>("deferred_shade::run: slots is 0, and count is " +
                                        std::to_string(all.count) +
                                        "; items pass through at least one slot");
  }
  if (all.slots > max_requests) {
    detail::fail<std::length_error>("deferred_shade::run: slots is " + std::to_string(all.slots) +
                                    ", and at most " + std::to_string(max_requests) +
                                    " are possible: their indices have 32 bits");
  }
  if (all.first > (std::numeric_limits<item_index>::max)() - all.count) {
    detail::fail<std::length_error>("deferred_shade::run: the items from " +
                                    std::to_string(all.first) + " on are " +
                                    std::to_string(all.count) + ", and their numbers have 64 bits");
  }
}

}  // namespace deferred_shade::detail
