// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/record_shaders.hpp>
#include <deferred_shade/types.hpp>

// How kernels call the renderer's shaders, functions of records, sources and sinks. These functions
// are for the device alone, and nvcc refuses a shader without __device__ in them. In a host/device
// function it is told not to check, and such a shader would do nothing.

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

template <class Source>
__device__ decltype(auto) load_on_device(Source const& source, request_index i) {
  if constexpr (std::is_invocable_v<Source const&, request_index>) {
    return source(i);
  } else {
    return source[i];
  }
}

template <class Sink, class Result>
__device__ void store_on_device(Sink const& sink, request_index i, Result const& result) {
  if constexpr (std::is_invocable_v<Sink const&, request_index, Result const&>) {
    static_cast<void>(sink(i, result));
  } else {
    sink[i] = result;
  }
}

/// Runs a shader on request i, as shader(i) does.
template <class Shader>
__device__ void call_on_device(Shader const& shader, request_index i) {
  if constexpr (is_record_shader<Shader>) {
    typename Shader::request_type const request = detail::load_on_device(shader.source, i);
    detail::store_on_device(shader.sink, i, shader.function(request));
  } else {
    static_cast<void>(shader(i));
  }
}

/// For shader_list::visit: runs the visited shader on request i.
struct run_on_device {
  request_index i;
  template <class Shader>
  __device__ void operator()(Shader const& shader) const {
    detail::call_on_device(shader, i);
  }
};

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
