// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

#include <deferred_shade/detail/checked_count.hpp>
#include <deferred_shade/detail/device_lambda.hpp>
#include <deferred_shade/detail/ids.hpp>
#include <deferred_shade/detail/shader_subset.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/record_shaders.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

// What functions ask of their arguments. If a check fails, the later ones pass and nothing else is
// compiled: the first error is the only one.

namespace deferred_shade {

template <class T>
struct cuda_allocator;

namespace detail {

// Members of a workspace: see workspace.hpp.
template <class T, class = void>
inline constexpr bool has_take = false;
template <class T>
inline constexpr bool has_take<
    T, std::void_t<decltype(std::declval<T&>().take(std::declval<elements<request_index>>(),
                                                    std::declval<elements<std::byte>>()))>> = true;
template <class T, class = void>
inline constexpr bool has_reserve = false;
template <class T>
inline constexpr bool has_reserve<
    T, std::void_t<decltype(std::declval<T&>().reserve(std::size_t{}, std::size_t{}))>> = true;
template <class T, class = void>
inline constexpr bool has_begin_phase = false;
template <class T>
inline constexpr bool has_begin_phase<
    T, std::void_t<decltype(std::declval<T const&>().begin_phase(std::declval<phase const&>()))>> =
    !std::is_void_v<decltype(std::declval<T const&>().begin_phase(std::declval<phase const&>()))>;

// Where the memory of an allocator lies, if its type tells.
template <class Allocator>
inline constexpr bool is_on_host = false;
template <class T>
inline constexpr bool is_on_host<std::allocator<T>> = true;
template <class Allocator>
inline constexpr bool is_on_device = false;
template <class T>
inline constexpr bool is_on_device<cuda_allocator<T>> = true;

/// Whether a shader can be called. If not, the table or the record shader has said what is wrong.
/// (nvcc does not tell what a lambda for the device alone can be called with.)
template <class Shader>
struct is_callable : std::bool_constant<is_device_lambda<Shader> ||
                                        std::is_invocable_v<Shader const&, request_index>> {};
template <class Source, class Function, class Sink>
struct is_callable<record_shader<Source, Function, Sink>>
    : std::bool_constant<record_types<Source, Function, Sink>::met> {};

/// Whether all hold. Uses a loop: a recursion over the shaders of a large table would be too deep.
template <bool... Values>
constexpr bool all_of() {
  bool const values[] = {Values..., true};
  for (bool const value : values) {
    if (!value) return false;
  }
  return true;
}

/// The last shader that a table has.
template <class... Shaders>
constexpr shader_id last_id() {
  constexpr present_ids<Shaders...> present;
  return present.count == 0 ? 0 : present.ids[present.count - 1];
}

// Facts and assertions are apart: clang takes no constant of a class in which an assertion failed.

/// What is so of a batch. `Checked`: what was checked before holds.
template <bool Checked, class Policy, class Count, class Ids, class Workspace>
struct facts_of_batch {
  static constexpr bool on_cuda = std::is_same_v<system_of<Policy>, cuda_system>;
  static constexpr bool checked = has_system<Policy> && Checked;
  static constexpr bool n =
      is_device_count<Count> || (std::is_integral_v<Count> && !std::is_same_v<Count, bool>);
  static constexpr bool ids = checked && n && has_ids<Ids> && are_ids<Ids>();

  static constexpr bool takes = has_take<Workspace>;
  static constexpr bool reserves = has_reserve<Workspace>;
  static constexpr bool has_phases = has_begin_phase<Workspace>;

  using allocator = typename allocator_of<Workspace>::type;
  static constexpr bool reachable_by_gpu = !on_cuda || !is_on_host<allocator>;
  static constexpr bool reachable_by_cpu = on_cuda || !is_on_device<allocator>;

  static constexpr bool met =
      ids && takes && reserves && has_phases && reachable_by_gpu && reachable_by_cpu;
};

/// What every function that runs or groups a batch asks.
template <bool Checked, class Policy, class Count, class Ids, class Workspace>
struct requirements_of_batch {
 private:
  using fact = facts_of_batch<Checked, Policy, Count, Ids, Workspace>;
  using checked_exec = std::integral_constant<std::size_t, sizeof(requirements_of_exec<Policy>)>;
  using checked_ids = std::integral_constant<std::size_t, sizeof(requirements_of_ids<Ids>)>;
  static constexpr bool ids = fact::ids;

  static_assert(!fact::checked || fact::n,
                "deferred_shade: n must be an integer or a device_count");
  static_assert(!ids || fact::takes,
                "deferred_shade: scratch must be a workspace that is not const, or have its member "
                "take(elements<T>...); workspace.hpp says what it does");
  static_assert(!ids || !fact::takes || fact::reserves,
                "deferred_shade: scratch must be a workspace, or have its member reserve(n, "
                "shaders); workspace.hpp says what it does");
  static_assert(
      !ids || !fact::takes || !fact::reserves || fact::has_phases,
      "deferred_shade: scratch must be a workspace, or have its member begin_phase(phase) "
      "const, which returns an object; workspace.hpp says what it does");
  static_assert(fact::reachable_by_gpu,
                "deferred_shade: scratch must have memory that the GPU reaches, not "
                "std::allocator's; write deferred_shade::workspace scratch{exec}");
  static_assert(fact::reachable_by_cpu,
                "deferred_shade: scratch must have memory that the CPU reaches, not that of a "
                "cuda_allocator; write deferred_shade::workspace scratch{exec}");
};

/// What `group` asks of its arguments.
template <class Policy, class Count, class Ids, class Workspace>
struct requirements_of_group {
  static constexpr bool met = facts_of_batch<true, Policy, Count, Ids, Workspace>::met;
  using checked_batch =
      std::integral_constant<std::size_t,
                             sizeof(requirements_of_batch<true, Policy, Count, Ids, Workspace>)>;
};

/// What functions ask of their arguments.
template <class Schedule, class Policy, class Count, class Ids, class Workspace, class... Shaders>
struct requirements_of_shade {
 private:
  static constexpr bool on_cuda = std::is_same_v<system_of<Policy>, cuda_system>;
  static constexpr bool callable = all_of<is_callable<Shaders>::value...>();
  static constexpr bool on_machine = on_cuda || all_of<!is_device_lambda<Shaders>...>();
  static constexpr bool checked = callable && on_machine;
  using batch = facts_of_batch<checked, Policy, Count, Ids, Workspace>;
  using checked_batch =
      std::integral_constant<std::size_t,
                             sizeof(requirements_of_batch<checked, Policy, Count, Ids, Workspace>)>;
  static constexpr bool wide_enough() {
    if constexpr (batch::ids) {
      return detail::largest_id_of<Ids>() >= detail::last_id<Shaders...>();
    } else {
      return true;
    }
  }
  static constexpr bool copies = !on_cuda || std::is_copy_constructible_v<shader_table<Shaders...>>;

 public:
  static constexpr bool met = batch::met && wide_enough() && copies;
  using value = std::bool_constant<met>;  // which clang computes here, and no later

  static_assert(on_machine,
                "deferred_shade: a shader that is a lambda for __device__ alone must have an exec "
                "for CUDA; write [=] __host__ __device__ (...)");
  static_assert(
      wide_enough(),
      "deferred_shade: the type of ids must be wide enough for the id of the last shader; "
      "use std::uint16_t or std::uint32_t, or a smaller table");
  static_assert(copies, "deferred_shade: shaders must be copyable where exec is for CUDA");
};

}  // namespace detail
}  // namespace deferred_shade
