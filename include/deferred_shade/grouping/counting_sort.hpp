// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>

#include <deferred_shade/config.hpp>
#include <deferred_shade/prefetch.hpp>
#include <deferred_shade/types.hpp>

// The steps of a stable counting sort on a CPU: ids are loaded as keys, which compilers make
// vectors of; keys are counted; and what they belong to is put to its place.

namespace deferred_shade::detail {

/// The ids of request `first` and of those after it. A loop that counts from 0 over them becomes
/// vectors; one over `first + i` does not, because such a sum may wrap.
template <class Ids>
Ids ids_from(Ids const& ids, request_index first) {
  return ids + static_cast<typename std::iterator_traits<Ids>::difference_type>(first);
}

/// Loads the shaders of the first `size` requests: `Shaders` for those that name none.
template <shader_id Shaders, class Ids>
void load_keys(Ids const& ids, std::size_t size, sort_key<Shaders>* __restrict keys) {
  for (std::size_t i = 0; i < size; ++i) {
    keys[i] =
        static_cast<sort_key<Shaders>>(shader_of(ids, static_cast<request_index>(i), Shaders));
  }
}

/// The same for the `size` requests from `first` on, at most `Size`.
template <shader_id Shaders, std::size_t Size, class Ids>
void load_keys(Ids const& ids, request_index first, request_index size,
               sort_key<Shaders> (&keys)[Size]) {
  if (size == Size) {
    load_keys<Shaders>(ids_from(ids, first), Size, keys);  // vectors at -O2, too
  } else {
    load_keys<Shaders>(ids_from(ids, first), size, keys);
  }
}

#if DEFERRED_SHADE_HAS_GNU
// No wider than the instructions are: g++ takes wider ones apart byte by byte.
#ifdef __AVX2__
using byte_vector = std::uint8_t __attribute__((vector_size(32)));
#else
using byte_vector = std::uint8_t __attribute__((vector_size(16)));
#endif
#endif

/// How often each of the keys 0 to `Shaders` occurs.
template <shader_id Shaders>
class key_counts {
  using key = sort_key<Shaders>;

 public:
  void add(key const* keys, request_index size) {
    request_index i = 0;
#if DEFERRED_SHADE_HAS_GNU
    if constexpr (Shaders <= 3 * sizeof(byte_vector) / 8) i = add_vectors(keys, size);
#endif
    for (; size - i >= ways; i += ways) {
      ++partial_[0][keys[i]];
      if constexpr (ways == 4) {
        ++partial_[1][keys[i + 1]];
        ++partial_[2][keys[i + 2]];
        ++partial_[3][keys[i + 3]];
      }
    }
    for (; i < size; ++i) ++partial_[0][keys[i]];
  }

  std::uint32_t of(shader_id k) const {
    std::uint32_t sum = 0;
    for (auto const& counts : partial_) sum += counts[k];
    return sum;
  }

 private:
#if DEFERRED_SHADE_HAS_GNU
  // Compares vectors of keys with one shader after the other, and subtracts the answers, which are
  // -1 where they agree: for few shaders less work than to look at the keys one by one. Returns how
  // many keys it has counted.
  request_index add_vectors(key const* keys, request_index size) {
    constexpr request_index width = sizeof(byte_vector);
    request_index i = 0;
    while (size - i >= width) {
      request_index const rows = std::min((size - i) / width, request_index{255});
      std::uint32_t none = rows * width;
      for (shader_id k = 0; k < Shaders; ++k) {
        byte_vector counts{};
        for (request_index row = 0; row < rows; ++row) {
          byte_vector some;
          std::memcpy(&some, keys + i + row * width, width);
          counts -= reinterpret_cast<byte_vector>(some == static_cast<std::uint8_t>(k));
        }
        std::uint32_t sum = 0;
        for (request_index lane = 0; lane < width; ++lane) sum += counts[lane];
        partial_[0][k] += sum;
        none -= sum;
      }
      partial_[0][Shaders] += none;
      i += rows * width;
    }
    return i;
  }
#endif

  // Neighbours often are the same. Four counters in turn keep the one increment from waiting for
  // the other, as long as they stay in the first-level cache.
  static constexpr request_index ways = Shaders < 512 ? 4 : 1;
  std::uint32_t partial_[ways][Shaders + 1] = {};
};

/// How many neighbouring keys are looked at together, and whether that many are the same.
inline constexpr request_index key_step = 8;
template <class Key>
bool are_same(Key const* keys) {
  return std::memcmp(keys, keys + 1, (key_step - 1) * sizeof(Key)) == 0;
}

/// Whether neighbours often are the same, by a look at an eighth of them.
template <class Key>
bool are_coherent(Key const* keys, request_index size) {
  request_index looks = 0;
  request_index same = 0;
  for (request_index i = 0; size - i >= key_step; ++looks, i += std::min(size - i, 8 * key_step)) {
    same += are_same(keys + i);
  }
  return same > looks / 4;
}

/// Puts the numbers `first` to `first + size - 1` to the places of their keys, in this order:
/// next[k] is the place of the next number whose key is k, before and after. With `Prefetch`, what
/// is behind a place is prefetched: for places that are too many, and too far from each other, for
/// the processor to do so by itself.
template <bool Prefetch, class Key, class Number>
void place_by_keys(Key const* keys, request_index size, Number first, std::uint32_t* next,
                   Number* places) {
  constexpr request_index ahead = 128 / sizeof(Number);
  request_index i = 0;
  auto const place_up_to = [&](request_index end) {
    for (; i < end; ++i) {
      std::uint32_t const place = next[keys[i]]++;
      places[place] = static_cast<Number>(first + i);
      if constexpr (Prefetch) prefetch<true>(places, place + ahead);
    }
  };
  // Those that are the same take one look at `next`, where each would wait for the one before.
  for (bool const coherent = are_coherent(keys, size); coherent && size - i >= key_step;) {
    if (are_same(keys + i)) {
      Number* const here = places + next[keys[i]];
      next[keys[i]] += key_step;
      for (request_index j = 0; j < key_step; ++j) here[j] = static_cast<Number>(first + i + j);
      i += key_step;
    } else {
      place_up_to(i + key_step);
    }
  }
  place_up_to(size);
}

}  // namespace deferred_shade::detail
