// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <utility>

#include <deferred_shade/config.hpp>
#include <deferred_shade/detail/cpu/prefetch.hpp>
#include <deferred_shade/detail/cpu/tuning.hpp>
#include <deferred_shade/types.hpp>

// The steps of a stable counting sort on a CPU: load ids as keys, in a loop that compilers
// vectorise; count the keys; put the requests to their places.

namespace deferred_shade::detail {

/// The ids from request `first` on. Compilers vectorise a loop that counts from 0 over them, but
/// not one over `first + i`, because that sum may wrap.
template <class Ids>
Ids ids_from(Ids const& ids, request_index first) {
  return ids + static_cast<typename std::iterator_traits<Ids>::difference_type>(first);
}

/// Loads the shaders of the first `size` requests, and `Shaders` for those that name none.
template <shader_id Shaders, class Ids, class Key>
void load_keys(Ids const& ids, std::size_t size, Key* __restrict keys) {
  for (std::size_t i = 0; i < size; ++i) {
    keys[i] = static_cast<Key>(detail::shader_of(ids, static_cast<request_index>(i), Shaders));
  }
}

/// The same for the `size` requests from `first` on, at most `Size`.
template <shader_id Shaders, std::size_t Size, class Ids>
void load_keys(Ids const& ids, request_index first, request_index size,
               sort_key<Shaders> (&keys)[Size]) {
  if (size == Size) {
    detail::load_keys<Shaders>(detail::ids_from(ids, first), Size, keys);  // vectors at -O2, too
  } else {
    detail::load_keys<Shaders>(detail::ids_from(ids, first), size, keys);
  }
}

#if DEFERRED_SHADE_HAS_GNU
template <std::size_t Bytes>
struct byte_vector_of;
template <>
struct byte_vector_of<16> {
  using type = std::uint8_t __attribute__((vector_size(16)));
};
template <>
struct byte_vector_of<32> {
  using type = std::uint8_t __attribute__((vector_size(32)));
};
#endif

/// The bytes of the vectors in which the keys of a table are compared, or 0 if they are counted one
/// by one.
template <shader_id Shaders, class Tuning>
inline constexpr std::size_t compared_bytes = vector_bytes != 0 &&
                                                      Tuning::compares_keys(Shaders, vector_bytes)
                                                  ? vector_bytes
                                                  : 0;

/// How often each of the keys 0 to `Shaders` occurs in each part of a sequence. The `Parts` parts
/// have equal length; the last one has the rest as well. `VectorBytes` is compared_bytes, which
/// depends on the instruction set of a translation unit. It is a part of the type: the linker then
/// takes no function from a unit with another one.
template <shader_id Shaders, request_index Parts, std::size_t VectorBytes>
class key_counts {
  static constexpr bool compares = VectorBytes != 0;
  static_assert(
      !compares || Shaders <= 0xff,
      "deferred_shade: cpu_tuning::compares_keys must be false for more than 255 shaders");
  using key = sort_key<Shaders>;

 public:
  void add(key const* keys, request_index size) {
    request_index compared = 0;
#if DEFERRED_SHADE_HAS_GNU
    if constexpr (compares) {
      request_index const length = size / Parts;
      for (request_index p = 0; p < Parts; ++p) {
        compared = add_vectors(keys + p * length, length, of_part_[p]);
      }
    }
#endif
    in_turn(compared, size, [keys](std::uint32_t* counts, std::size_t i) { ++counts[keys[i]]; });
  }

  std::uint32_t of(shader_id k) const {
    std::uint32_t sum = 0;
    for (auto const& counts : of_part_) sum += counts[k];
    return sum;
  }

  /// Puts the numbers `first` to `first + size - 1` to the places of their keys, in this order.
  /// next[k] is the place of the next number whose key is k, before and after. Must follow a single
  /// call of `add` with the same keys; turns the counts into places.
  template <class Number>
  void place(key const* keys, request_index size, Number first, std::uint32_t* next,
             Number* places) {
    for (shader_id k = 0; k <= Shaders; ++k) {
      for (auto& counts : of_part_) counts[k] = std::exchange(next[k], next[k] + counts[k]);
    }
    in_turn(0, size, [=](std::uint32_t* next_of_part, std::size_t i) {
      places[next_of_part[keys[i]]++] = static_cast<Number>(first + i);
    });
  }

 private:
  // Calls `f(counts, i)` for every key i from number `begin` of its part on. Indices have 64 bits,
  // which do not wrap: otherwise clang keeps a counter for each part, in memory.
  template <class Function>
  void in_turn(std::size_t begin, std::size_t size, Function const& f) {
    std::size_t const length = size / Parts;
    for (std::size_t i = begin; i < length; ++i) {
      for (std::size_t p = 0; p < Parts; ++p) f(of_part_[p], p * length + i);
    }
    for (std::size_t i = Parts * length; i < size; ++i) f(of_part_[Parts - 1], i);
  }

#if DEFERRED_SHADE_HAS_GNU
  // Counts by subtracting comparisons, which are -1 for a key of the shader. Returns how many keys
  // it has counted. If the inner loop is not unrolled, g++ keeps the counts in memory.
  static request_index add_vectors(key const* keys, request_index size, std::uint32_t* counts_of) {
    using byte_vector = typename byte_vector_of<VectorBytes>::type;
    constexpr std::uint32_t width = VectorBytes;
    constexpr std::uint32_t together = 4;  // shaders to a load of keys
    request_index i = 0;
    while (size - i >= width) {
      request_index const rows = (std::min)((size - i) / width, request_index{255});
      std::uint32_t named = 0;
      for (shader_id k = 0; k < Shaders; k += together) {
        byte_vector counts[together] = {};
        for (request_index row = 0; row < rows; ++row) {
          byte_vector some;
          std::memcpy(&some, keys + i + row * width, width);
#pragma GCC unroll 4
          for (shader_id j = 0; j < together; ++j) {
            counts[j] -= reinterpret_cast<byte_vector>(some == static_cast<std::uint8_t>(k + j));
          }
        }
        for (shader_id j = 0; j < together && k + j < Shaders; ++j) {
          std::uint32_t sum = 0;
          for (request_index lane = 0; lane < width; ++lane) sum += counts[j][lane];
          counts_of[k + j] += sum;
          named += sum;
        }
      }
      counts_of[Shaders] += rows * width - named;
      i += rows * width;
    }
    return i;
  }
#endif

  std::uint32_t of_part_[Parts][Shaders + 1] = {};
};

/// How many neighbouring keys are looked at together, and whether that many are the same.
inline constexpr request_index key_step = 8;
template <class Key>
bool are_same(Key const* keys) {
  return std::memcmp(keys, keys + 1, (key_step - 1) * sizeof(Key)) == 0;
}

/// The share of key_step neighbours that are the same, in quarters (0 to 4), from a sample of an
/// eighth.
template <class Key>
request_index quarters_same(Key const* keys, request_index size) {
  request_index looks = 0, same = 0;
  for (request_index i = 0; size - i >= key_step;
       ++looks, i += (std::min)(size - i, 8 * key_step)) {
    same += detail::are_same(keys + i);
  }
  return looks == 0 ? 0 : 4 * same / looks;
}

/// Puts one number to the place of its key. Prefetches ahead of it into the cache `Ahead`: hardware
/// prefetches too late, or not at all if there are many places. `none` is for places that are near
/// each other.
template <cache_level Ahead, class Number>
void place_one(std::size_t key, Number number, std::uint32_t* next, Number* places) {
  std::uint32_t const place = next[key]++;
  places[place] = number;
  detail::prefetch<Ahead>(places, place + prefetched_bytes / sizeof(Number));
}

/// Does what key_counts::place does, but one key after the other and without counts of the keys.
template <cache_level Ahead, class Key, class Number>
void place_each(Key const* keys, request_index size, Number first, std::uint32_t* next,
                Number* places) {
  request_index i = 0;
#if DEFERRED_SHADE_HAS_GNU && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  if constexpr (Ahead == cache_level::second_level) {  // saves loads: one for eight bytes of keys
    for (std::uint64_t word; size - i >= sizeof word / sizeof(Key);) {
      std::memcpy(&word, keys + i, sizeof word);
      for (std::size_t bit = 0; bit < 64; bit += 8 * sizeof(Key), ++i) {
        detail::place_one<Ahead>(static_cast<Key>(word >> bit), static_cast<Number>(first + i),
                                 next, places);
      }
    }
  }
#endif
  for (; i < size; ++i)
    detail::place_one<Ahead>(keys[i], static_cast<Number>(first + i), next, places);
}

/// As place_each, but key_step equal keys take one access to `next`; one by one, each would wait
/// for the one before.
template <cache_level Ahead, class Key, class Number>
void place_by_keys(Key const* keys, request_index size, Number first, std::uint32_t* next,
                   Number* places) {
  request_index i = 0;
  for (bool const coherent = detail::quarters_same(keys, size) > 0;
       coherent && size - i >= key_step; i += key_step) {
    auto const number = static_cast<Number>(first + i);
    if (detail::are_same(keys + i)) {
      Number* const here = places + next[keys[i]];
      next[keys[i]] += key_step;
      detail::prefetch<Ahead>(here, prefetched_bytes_by_eight / sizeof(Number));
      for (request_index j = 0; j < key_step; ++j) here[j] = static_cast<Number>(number + j);
    } else {
      detail::place_each<Ahead>(keys + i, key_step, number, next, places);
    }
  }
  detail::place_each<Ahead>(keys + i, size - i, static_cast<Number>(first + i), next, places);
}

}  // namespace deferred_shade::detail
