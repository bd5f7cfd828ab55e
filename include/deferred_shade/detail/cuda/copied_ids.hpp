// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cuda_runtime.h>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/load_keys.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// Ids behind an iterator that may be slow to read, and where a copy of them goes: algorithms that
/// read ids twice read the copy the second time.
template <class Ids, class Key>
struct copied_ids {
  Ids ids;
  Key* copy;
};

/// As load_neighbours of load_keys.hpp, and copies the shaders. `first` is a multiple of `Items`.
template <shader_id Shaders, std::uint32_t Items, class Ids, class Key>
__device__ void load_neighbours(copied_ids<Ids, Key> const& from, request_index first,
                                std::uint32_t size, std::uint32_t (&keys)[Items]) {
  constexpr std::uint32_t per_word = 4 / sizeof(Key);
  static_assert(Shaders < std::uint64_t{1} << 8 * sizeof(Key) && Items % (4 * per_word) == 0,
                "deferred_shade: copies of ids must have room for all shaders");
  detail::load_neighbours<Shaders>(from.ids, first, size, keys);
  if (size >= Items) {
    auto* const vectors = reinterpret_cast<uint4*>(from.copy + first);
#pragma unroll
    for (std::uint32_t v = 0; v < Items / (4 * per_word); ++v) {
      std::uint32_t words[4] = {};
#pragma unroll
      for (std::uint32_t i = 0; i < 4 * per_word; ++i) {
        words[i / per_word] |= keys[v * 4 * per_word + i] << i % per_word * (32 / per_word);
      }
      vectors[v] = {words[0], words[1], words[2], words[3]};
    }
  } else {
#pragma unroll
    for (std::uint32_t i = 0; i < Items; ++i) {
      if (i < size) from.copy[first + i] = static_cast<Key>(keys[i]);
    }
  }
}

/// What two passes over ids read, where the first one may copy them. `Shaders` is below 65,536.
template <shader_id Shaders, class Ids>
struct two_passes {
  static constexpr bool copies = !ids_in_memory<Ids>::possible;
  using key = std::conditional_t<(Shaders < 256), std::uint8_t, std::uint16_t>;
  using first = std::conditional_t<copies, copied_ids<Ids, key>, Ids>;
  using second = std::conditional_t<copies, key const*, Ids>;

  /// The memory that a copy of the ids of `n` requests takes.
  static elements<key> memory(std::size_t n) { return elements<key>(copies ? n : 0); }

  static first read_first(Ids ids, [[maybe_unused]] key* copy) {
    if constexpr (copies) {
      return {ids, copy};
    } else {
      return ids;
    }
  }
  static second read_second(Ids ids, [[maybe_unused]] key const* copy) {
    if constexpr (copies) {
      return copy;
    } else {
      return ids;
    }
  }
};

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
