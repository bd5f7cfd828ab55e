// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cuda_runtime.h>
#include <thrust/iterator/transform_iterator.h>
#include <cstdint>
#include <type_traits>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/warp.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// Ids that lie in memory, or are each computed from an element of an array there.
template <class Ids>
struct ids_in_memory {
  static constexpr bool possible = false;
};
template <class Id>
struct ids_in_memory<Id*> {
  static constexpr bool possible = true;
  using stored = std::remove_cv_t<Id>;
  static __device__ stored const* pointer(Id* ids) { return ids; }
  template <class Value>
  static __device__ Value made_of(Id*, Value id) {
    return id;
  }
};
template <class Function, class Id>
struct ids_in_memory<thrust::transform_iterator<Function, Id*, shader_id, shader_id>> {
  static constexpr bool possible = std::is_integral_v<Id> || std::is_enum_v<Id>;  // not records
  using iterator = thrust::transform_iterator<Function, Id*, shader_id, shader_id>;
  using stored = std::remove_cv_t<Id>;
  static __device__ stored const* pointer(iterator ids) { return ids.base(); }
  static __device__ shader_id made_of(iterator ids, stored id) { return ids.functor()(id); }
};

/// Loads the shaders of `Items` neighbouring requests, of which `size` exist. keys[i] is the shader
/// of request `first + i`, or `Shaders` if it names none or does not exist.
///
/// Ids that lie in memory are loaded 16 bytes at a time if they are aligned.
template <shader_id Shaders, std::uint32_t Items, class Ids>
__device__ void load_neighbours(Ids const& ids, request_index first, std::uint32_t size,
                                std::uint32_t (&keys)[Items]) {
  using memory = ids_in_memory<Ids>;
  if constexpr (memory::possible) {
    using id = typename memory::stored;
    constexpr std::uint32_t per_vector = sizeof(uint4) / sizeof(id);
    if constexpr (Items % per_vector == 0) {
      auto const* const vectors = reinterpret_cast<uint4 const*>(memory::pointer(ids) + first);
      if (size >= Items && reinterpret_cast<std::uintptr_t>(vectors) % sizeof(uint4) == 0) {
#pragma unroll
        for (std::uint32_t v = 0; v < Items / per_vector; ++v) {
          uint4 const vector = vectors[v];
          id const* const loaded = reinterpret_cast<id const*>(&vector);
          std::uint32_t const words[] = {vector.x, vector.y, vector.z, vector.w};
#pragma unroll
          for (std::uint32_t i = 0; i < per_vector; ++i) {
            shader_id key;
            if constexpr (std::is_same_v<id, std::uint8_t>) {  // saves an instruction for each
              key = memory::made_of(ids, __byte_perm(words[i / 4], 0, 0x4440 + i % 4));
            } else {
              key = static_cast<shader_id>(memory::made_of(ids, loaded[i]));
            }
            keys[v * per_vector + i] = (min)(key, Shaders);
          }
        }
        return;
      }
    }
  }
#pragma unroll
  for (std::uint32_t i = 0; i < Items; ++i) {
    keys[i] = i < size ? detail::shader_of(ids, first + i, Shaders) : Shaders;
  }
}

/// The same for rows. keys[i] is the shader of request `first + i * 32`; `first` is the first
/// request of this lane, and `size` requests exist from there on.
template <shader_id Shaders, std::uint32_t Items, class Ids>
__device__ void load_rows(Ids const& ids, request_index first, std::uint32_t size,
                          std::uint32_t (&keys)[Items]) {
  if (__all_sync(all_lanes, size > (Items - 1) * warp_size)) {  // then no load waits for a branch
#pragma unroll
    for (std::uint32_t i = 0; i < Items; ++i) {
      keys[i] = detail::shader_of(ids, first + i * warp_size, Shaders);
    }
  } else {
#pragma unroll
    for (std::uint32_t i = 0; i < Items; ++i) {
      std::uint32_t const distance = i * warp_size;
      keys[i] = distance < size ? detail::shader_of(ids, first + distance, Shaders) : Shaders;
    }
  }
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
