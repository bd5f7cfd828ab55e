// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include <deferred_shade/config.hpp>
#include <deferred_shade/detail/bits.hpp>
#include <deferred_shade/types.hpp>

// Records laid out word by word: a vector holds the same member of neighbouring records.

namespace deferred_shade::detail {

/// Whether a record can be taken apart into words.
template <class T>
inline constexpr bool has_words =
    is_copied_by_bytes<T>&& std::is_default_constructible_v<T>&& std::is_copy_assignable_v<T> &&
    !std::is_empty_v<T> && sizeof(T) % 4 == 0 && sizeof(T) <= 256;

#if DEFERRED_SHADE_HAS_GNU
/// The vector that most CPUs can load and store at once.
using four_words = std::uint32_t __attribute__((vector_size(16)));

inline void transpose(four_words (&rows)[4]) noexcept {
  four_words const ab01 = __builtin_shufflevector(rows[0], rows[1], 0, 4, 1, 5);
  four_words const ab23 = __builtin_shufflevector(rows[0], rows[1], 2, 6, 3, 7);
  four_words const cd01 = __builtin_shufflevector(rows[2], rows[3], 0, 4, 1, 5);
  four_words const cd23 = __builtin_shufflevector(rows[2], rows[3], 2, 6, 3, 7);
  rows[0] = __builtin_shufflevector(ab01, cd01, 0, 1, 4, 5);
  rows[1] = __builtin_shufflevector(ab01, cd01, 2, 3, 6, 7);
  rows[2] = __builtin_shufflevector(ab23, cd23, 0, 1, 4, 5);
  rows[3] = __builtin_shufflevector(ab23, cd23, 2, 3, 6, 7);
}
#endif

/// Copies word number `word` of a record. Not a member of the template below: g++ 13 would merge
/// equal members for different records, and warn about the bounds of another record.
inline void copy_word(std::size_t word, void const* record, std::uint32_t& to) noexcept {
  std::memcpy(&to, static_cast<unsigned char const*>(record) + 4 * word, 4);
}

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
  // By value: with a reference, g++ keeps the record in memory and the loop scalar.
  void set(std::size_t lane, T record) noexcept {
    set(lane, detail::bits_as<words>(record), each_word());
  }
  /// Sets a record from memory, in a loop that is not vectorised.
  void copy(std::size_t lane, T const& record) noexcept {
    for (std::size_t word = 0; word < count; ++word)
      detail::copy_word(word, detail::address_of(record), words_[word][lane]);
  }
  /// Sets four records, at `lane` and the lanes after it.
  void copy(std::size_t lane, T const& a, T const& b, T const& c, T const& d) noexcept {
#if DEFERRED_SHADE_HAS_GNU
    constexpr std::size_t shuffled = count / 4 * 4;
    for (std::size_t word = 0; word < shuffled; word += 4) {
      four_words out[4] = {words_of(a, word), words_of(b, word), words_of(c, word),
                           words_of(d, word)};
      detail::transpose(out);
      for (std::size_t i = 0; i < 4; ++i) std::memcpy(&words_[word + i][lane], &out[i], 16);
    }
#else
    constexpr std::size_t shuffled = 0;
#endif
    if constexpr (shuffled < count) {  // g++ warns about a loop that it knows to be empty
      for (std::size_t word = shuffled; word < count; ++word) {
        detail::copy_word(word, detail::address_of(a), words_[word][lane]);
        detail::copy_word(word, detail::address_of(b), words_[word][lane + 1]);
        detail::copy_word(word, detail::address_of(c), words_[word][lane + 2]);
        detail::copy_word(word, detail::address_of(d), words_[word][lane + 3]);
      }
    }
  }

 private:
  template <std::size_t... Word>
  T get(std::size_t lane, std::index_sequence<Word...>) const noexcept {
    return detail::bits_as<T>(words{{words_[Word][lane]...}});
  }
  template <std::size_t... Word>
  void set(std::size_t lane, words const& record, std::index_sequence<Word...>) noexcept {
    ((words_[Word][lane] = record.word[Word]), ...);
  }
#if DEFERRED_SHADE_HAS_GNU
  static four_words words_of(T const& record, std::size_t first) noexcept {
    four_words words;
    std::memcpy(&words,
                reinterpret_cast<unsigned char const*>(detail::address_of(record)) + 4 * first, 16);
    return words;
  }
#endif

  std::uint32_t words_[count][Size];
};

}  // namespace deferred_shade::detail
