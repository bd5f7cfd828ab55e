// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include <deferred_shade/records.hpp>
#include <deferred_shade/types.hpp>

// How a CPU fills its vectors: the records of requests that name one shader are laid out word by
// word, so that a vector holds the same member of neighbouring records, and the shader runs in a
// loop that compilers vectorise (docs/guide.md, "Vectors on a CPU").

#if defined(__GNUC__) && !defined(__CUDACC__)
#define DEFERRED_SHADE_HAS_GNU 1
#else
#define DEFERRED_SHADE_HAS_GNU 0
#endif

/// Goes before a function that is compiled by itself, with all that it calls inlined.
#if DEFERRED_SHADE_HAS_GNU
#define DEFERRED_SHADE_FLATTEN __attribute__((flatten, noinline))
#else
#define DEFERRED_SHADE_FLATTEN
#endif

namespace deferred_shade::detail {

/// The bits of `from` as another type. (Compilers keep what their builtin makes in registers.)
template <class To, class From>
To bits_as(From const& from) noexcept {
  static_assert(sizeof(To) == sizeof(From));
#if DEFERRED_SHADE_HAS_GNU && (defined(__clang__) || __GNUC__ >= 11)
  return __builtin_bit_cast(To, from);
#else
  To to;
  std::memcpy(static_cast<void*>(&to), &from, sizeof(To));
  return to;
#endif
}

/// Whether a record can be taken apart into words.
template <class T>
inline constexpr bool has_words =
    std::is_trivially_copyable_v<T>&& std::is_default_constructible_v<T>&&
        std::is_copy_assignable_v<T> &&
    !std::is_empty_v<T> && sizeof(T) % 4 == 0 && sizeof(T) <= 256;

/// `Size` records of type T, as arrays of their words.
template <class T, std::size_t Size>
class lanes {
  static constexpr std::size_t count = sizeof(T) / 4;
  using each_word = std::make_index_sequence<count>;
  struct words {
    std::uint32_t word[count];
  };

 public:
  T get(std::size_t lane) const noexcept { return get(lane, each_word()); }
  // By value: a reference would have g++ keep the record in memory, and the loop scalar.
  void set(std::size_t lane, T record) noexcept { set(lane, bits_as<words>(record), each_word()); }
  /// The same from memory, for a loop that is not vectorised.
  void copy(std::size_t lane, T const& record) noexcept { copy(lane, record, each_word()); }

 private:
  template <std::size_t... Word>
  T get(std::size_t lane, std::index_sequence<Word...>) const noexcept {
    return bits_as<T>(words{{words_[Word][lane]...}});
  }
  template <std::size_t... Word>
  void set(std::size_t lane, words const& record, std::index_sequence<Word...>) noexcept {
    ((words_[Word][lane] = record.word[Word]), ...);
  }
  template <std::size_t... Word>
  void copy(std::size_t lane, T const& record, std::index_sequence<Word...>) noexcept {
    auto const* const bytes = reinterpret_cast<unsigned char const*>(&record);
    (std::memcpy(&words_[Word][lane], bytes + 4 * Word, 4), ...);
  }

  std::uint32_t words_[count][Size];
};

/// A stretch of at least so many neighbours of one shader is run where it lies.
inline constexpr std::size_t long_stretch = 64;

/// Whether the requests of a shader can be packed.
template <class Shader>
inline constexpr bool is_packable = false;
template <class Source, class Function, class Sink>
inline constexpr bool is_packable<record_shader<Source, Function, Sink>> =
    has_words<typename record_shader<Source, Function, Sink>::request_type>&&
        has_words<typename record_shader<Source, Function, Sink>::result_type>;

/// The requests of a shader that are packed at a time: up to 256, and as many as take, with their
/// results, at most 16 KiB of the first-level cache.
template <class Shader>
inline constexpr std::size_t packed_lanes = std::min(std::size_t{256},
                                                     16384 /
                                                         (sizeof(typename Shader::request_type) +
                                                          sizeof(typename Shader::result_type)) /
                                                         16 * 16);

/// Brings the request that a source holds for request i near to this core, where it holds any.
template <class Source>
void prefetch(Source const& source, request_index i) noexcept {
#if DEFERRED_SHADE_HAS_GNU
  if constexpr (std::is_pointer_v<Source>) {
    using request = std::remove_pointer_t<Source>;
    if constexpr (std::is_object_v<request>) {  // an address is all that it takes, valid or not
      auto const address = reinterpret_cast<std::uintptr_t>(source) + sizeof(request) * i;
      __builtin_prefetch(reinterpret_cast<void const*>(address), 0, 2);
    }
  }
#endif
  static_cast<void>(source);
  static_cast<void>(i);
}

/// Runs a shader on the requests `first + order[j]` for j from 0 to `count` - 1, which is at most
/// `packed_lanes`. A function of its own, so that all shaders have their lanes in the same place of
/// the stack, and with all that it calls inlined, since a loop with a call in it stays scalar.
template <class Shader, class Order>
DEFERRED_SHADE_FLATTEN void run_packed(Shader const& shader, request_index first,
                                       Order const* order, std::size_t count) {
  using request = typename Shader::request_type;
  using result = typename Shader::result_type;
  lanes<request, packed_lanes<Shader>> requests;
  lanes<result, packed_lanes<Shader>> results;
  for (std::size_t j = 0; j < count; ++j) {
    requests.copy(j, load(shader.source, first + order[j]));
  }
  auto const& function = shader.function;
  for (std::size_t j = 0; j < count; ++j) {
    request const r = requests.get(j);
    results.set(j, function(r));
  }
  for (std::size_t j = 0; j < count; ++j) store(shader.sink, first + order[j], results.get(j));
}

/// Runs one shader on the requests `first + order[j]` for j from 0 to `count` - 1, `order`
/// ascending.
template <class Shader, class Order>
void run_segment(Shader const& shader, request_index first, Order const* order, std::size_t count) {
  if constexpr (is_packable<Shader>) {
    for (std::size_t begin = 0; begin < count; begin += packed_lanes<Shader>) {
      std::size_t const size = std::min(packed_lanes<Shader>, count - begin);
      Order const* const part = order + begin;
      if (size >= long_stretch && static_cast<std::size_t>(part[size - 1] - part[0]) == size - 1) {
        for (std::size_t j = 0; j < size; ++j) shader(first + part[j]);
      } else {
        run_packed(shader, first, part, size);
      }
    }
  } else {
    for (std::size_t j = 0; j < count; ++j) shader(first + order[j]);
  }
}

}  // namespace deferred_shade::detail
