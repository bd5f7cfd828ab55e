// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/binary_search.h>
#include <thrust/execution_policy.h>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <deferred_shade/detail/bits.hpp>
#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/call.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/staging.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/record_shaders.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// Runs every request through the shader that it names.
template <class Count, class Ids, class... Shaders>
__global__ void switch_kernel(Count n, Ids ids,
                              shader_list<Shaders...> const __grid_constant__ shaders) {
  detail::begin_after_earlier_kernels();
  std::size_t const p = std::size_t{blockIdx.x} * blockDim.x + threadIdx.x;
  auto const i = static_cast<request_index>(p);
  if (p < detail::size_of(n)) {
    shaders.visit(detail::shader_of(ids, i, sizeof...(Shaders)), run_on_device{i});
  }
}

/// The same for record shaders. All lanes load their requests together and store their results
/// together; only the functions diverge. `one_place`: all shaders have the same source and the same
/// sink. Otherwise loads and stores diverge as well.
template <class Count, class Ids, class... Shaders>
__global__ void records_kernel(Count n, Ids ids,
                               shader_list<Shaders...> const __grid_constant__ shaders,
                               bool one_place) {
  using request = typename staging<Shaders...>::request;
  using result = typename staging<Shaders...>::result;
  detail::begin_after_earlier_kernels();
  std::size_t const p = std::size_t{blockIdx.x} * blockDim.x + threadIdx.x;
  if (p >= detail::size_of(n)) return;
  auto const i = static_cast<request_index>(p);
  shader_id const id = detail::shader_of(ids, i, sizeof...(Shaders));
  if (id == sizeof...(Shaders)) return;

  auto const at_place = [&](auto const& f) {
    if (one_place) {
      f(shaders.template get<0>());
    } else {
      shaders.visit(id, f);
    }
  };
  alignas(request) unsigned char in[sizeof(request)];
  alignas(result) unsigned char out[sizeof(result)];
  at_place([&](auto const& shader) {
    *reinterpret_cast<request*>(in) = detail::load_on_device(shader.source, i);
  });
  shaders.visit(id, [&](auto const& shader) {
    *reinterpret_cast<result*>(out) = shader.function(*reinterpret_cast<request const*>(in));
  });
  at_place([&](auto const& shader) {
    detail::store_on_device(shader.sink, i, *reinterpret_cast<result const*>(out));
  });
}

/// Runs the requests of a grouping through the shaders of their segments.
template <class... Shaders>
__global__ void segments_kernel(request_index const* permutation, request_index const* offsets,
                                shader_list<Shaders...> const __grid_constant__ shaders) {
  detail::begin_after_earlier_kernels();
  std::size_t const p = std::size_t{blockIdx.x} * blockDim.x + threadIdx.x;
  if (p >= offsets[sizeof...(Shaders)]) return;
  request_index const* const ends = offsets + 1;
  auto const id = thrust::upper_bound(thrust::seq, ends, ends + sizeof...(Shaders), p) - ends;
  shaders.visit(static_cast<shader_id>(id), run_on_device{permutation[p]});
}

/// Whether all shaders of a table have the same source and the same sink.
template <class... Shaders>
bool have_one_place(shader_table<Shaders...> const& shaders) {
  auto const same = [](auto const& a, auto const& b) {
    return std::memcmp(detail::address_of(a), detail::address_of(b), sizeof(a)) ==
           0;  // their types may lack a comparison
  };
  auto const& first = shaders.template get<0>();
  bool result = true;
  shaders.for_each([&](auto, auto const& shader) {
    result = result && same(shader.source, first.source) && same(shader.sink, first.sink);
  });
  return result;
}

template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
void run_implicit(cuda_system, Policy const& exec, Count n, Ids ids,
                  shader_table<Shaders...> const& shaders, Workspace const&) {
  std::size_t const maximum = detail::maximum_of(n);
  constexpr bool records = staging<Shaders...>::possible;
  constexpr std::uint32_t threads =
      cuda_tuning_of<Workspace>::switch_threads(sizeof...(Shaders), records);
  if constexpr (records) {
    detail::launch<&records_kernel<Count, Ids, Shaders...>>(
        "implicit_serialization", detail::stream_of(exec),
        {detail::blocks_for(maximum, threads), threads}, n, ids, shaders,
        detail::have_one_place(shaders));
  } else {
    detail::launch<&switch_kernel<Count, Ids, Shaders...>>(
        "implicit_serialization", detail::stream_of(exec),
        {detail::blocks_for(maximum, threads), threads}, n, ids, shaders);
  }
}

template <class Policy, class... Shaders, class Workspace>
void run_implicit(cuda_system, Policy const& exec, grouping group,
                  shader_table<Shaders...> const& shaders, Workspace const&) {
  constexpr std::uint32_t threads = cuda_tuning_of<Workspace>::grouped_switch_threads;
  detail::launch<&segments_kernel<Shaders...>>(
      "implicit_serialization", detail::stream_of(exec),
      {detail::blocks_for(group.maximum, threads), threads}, group.permutation, group.offsets,
      shaders);
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
