// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/tuning.hpp>
#include <deferred_shade/detail/cuda/warp.hpp>
#include <deferred_shade/detail/moved.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>

// A warp moves the elements at 32 neighbouring places together, word by word: neighbouring lanes
// take neighbouring words of an element. So a struct is read and written in whole sectors, whatever
// its size. The lane that knows where an element lies tells the others by a shuffle.

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// The words that elements of type T are moved in: `Wide`, of up to 16 bytes, if the addresses of
/// the arrays allow it; else as the alignment of T allows.
template <class T, bool Wide>
struct words_of {
  static constexpr std::size_t largest(std::size_t limit) {
    std::size_t bytes = 16;
    while (bytes > limit || sizeof(T) % bytes != 0) bytes /= 2;
    return bytes;
  }
  static constexpr std::size_t bytes = largest(Wide ? 16 : alignof(T));
  static constexpr auto count = static_cast<std::uint32_t>(sizeof(T) / bytes);
  using type = std::conditional_t<
      bytes == 16, uint4,
      std::conditional_t<
          bytes == 8, uint2,
          std::conditional_t<bytes == 4, std::uint32_t,
                             std::conditional_t<bytes == 2, std::uint16_t, std::uint8_t>>>>;
};

/// Whether both arrays begin where wide words may.
template <class T>
bool are_wide(moved<T> array) {
  constexpr std::size_t bytes = words_of<T, true>::bytes;
  return reinterpret_cast<std::uintptr_t>(array.from) % bytes == 0 &&
         reinterpret_cast<std::uintptr_t>(array.to) % bytes == 0;
}

/// Moves the elements at the `size` places from `first` on, in `Rows` rows of 32. This lane knows
/// those of its own column: others[r] stands at place first + r * 32 + lane. Up to eight words are
/// under way at a time.
template <bool Scatter, std::uint32_t Words, std::uint32_t Rows, class Word>
__device__ void move_rows(Word const* from, Word* to, request_index const* others,
                          std::size_t first, std::uint32_t size) {
  constexpr std::uint32_t staged = Words <= 8 ? Words : 4;
  std::uint32_t const lane = threadIdx.x % warp_size;
#pragma unroll(Words <= 16 ? (Words + staged - 1) / staged : 1)
  for (std::uint32_t k = 0; k < Words; k += staged) {
    Word words[Rows][staged];
    // Where a word lies in the array that is in the order, and in the one that is not.
    auto const for_each_word = [&](bool far, auto const& f) {
#pragma unroll
      for (std::uint32_t r = 0; r < Rows; ++r) {
#pragma unroll
        for (std::uint32_t j = 0; j < staged; ++j) {
          if (Words % staged != 0 && k + j >= Words) continue;
          std::uint32_t const w = (k + j) * warp_size + lane;
          std::uint32_t const element = w / Words;
          std::size_t place = first + r * warp_size + element;
          if (far) place = __shfl_sync(all_lanes, others[r], static_cast<int>(element));
          if (r * warp_size + element < size) f(words[r][j], place * Words + w % Words);
        }
      }
    };
    for_each_word(!Scatter, [&](Word& word, std::size_t at) { word = from[at]; });
    for_each_word(Scatter, [&](Word& word, std::size_t at) { to[at] = word; });
  }
}

/// The same of one array, for all places of a warp.
template <bool Scatter, bool Wide, std::uint32_t Rows, class T>
__device__ void move_array(moved<T> array, request_index const (&others)[Rows], std::size_t first,
                           std::uint32_t size) {
  using words = words_of<T, Wide>;
  using word = typename words::type;
  constexpr std::uint32_t wanted = words::count == 1 ? 4 : words::count == 2 ? 2 : 1;
  constexpr std::uint32_t rows = wanted < Rows ? wanted : Rows;
  auto const* const from = reinterpret_cast<word const*>(array.from);
  auto* const to = reinterpret_cast<word*>(array.to);
#pragma unroll
  for (std::uint32_t r = 0; r < Rows; r += rows) {
    if (r * warp_size >= size) return;
    detail::move_rows<Scatter, words::count, rows>(from, to, others + r, first + r * warp_size,
                                                   size - r * warp_size);
  }
}

/// Moves all arrays. Every warp has `Rows` rows of 32 neighbouring places.
template <bool Scatter, bool Wide, std::uint32_t Rows, class... T>
__global__ void __launch_bounds__(moved_threads)
    move_kernel(request_order order, moved<T>... arrays) {
  detail::begin_after_earlier_kernels();
  constexpr std::size_t places = Rows * warp_size;
  std::size_t const n = detail::size_of(order.n);
  std::size_t const thread = std::size_t{blockIdx.x} * moved_threads + threadIdx.x;
  std::size_t const first = thread / warp_size * places;
  if (first >= n) return;
  auto const size = static_cast<std::uint32_t>((min)(n - first, places));
  request_index others[Rows];
#pragma unroll
  for (std::uint32_t r = 0; r < Rows; ++r) {
    std::uint32_t const p = r * warp_size + threadIdx.x % warp_size;
    others[r] = p < size ? order.permutation[first + p] : 0;
  }
  (detail::move_array<Scatter, Wide>(arrays, others, first, size), ...);
}

template <bool Scatter, class Policy, class... T>
void move_arrays(cuda_system, Policy const& exec, request_order order, moved<T>... arrays) {
  constexpr std::uint32_t rows = detail::moved_rows((sizeof(T) + ... + 0));
  char const* const what = Scatter ? "scatter" : "gather";
  launch_shape const shape{detail::blocks_for(order.n.maximum, moved_threads * rows),
                           moved_threads};
  if ((detail::are_wide(arrays) && ... && true)) {
    detail::launch<&move_kernel<Scatter, true, rows, T...>>(what, detail::stream_of(exec), shape,
                                                            order, arrays...);
  } else {
    detail::launch<&move_kernel<Scatter, false, rows, T...>>(what, detail::stream_of(exec), shape,
                                                             order, arrays...);
  }
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
