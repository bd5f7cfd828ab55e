// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/config.hpp>  // first: it refuses what is too old

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace deferred_shade {

/// The position of an item among all that pass through a loop. An item is what a renderer's slots
/// work on one after the other: a sample of a pixel, or a particle.
using item_index = std::uint64_t;

/// When a loop ends before all its items have.
enum class stop_when : std::uint32_t {
  never,        ///< it runs to the end
  items_ended,  ///< no further item begins; those that have begun run to their ends
  round_ended   ///< after this round; items that have begun and not ended are given up
};

/// What a running loop tells, and can be told, without waiting for it. Any thread may call its
/// functions at any time.
class run_control {
 public:
  /// Asks the loop to end. A loop that starts afterwards heeds it as well, until stop_when::never.
  void stop(stop_when when) noexcept { stop_.store(when, std::memory_order_relaxed); }
  stop_when stops() const noexcept { return stop_.load(std::memory_order_relaxed); }

  /// The items that have begun since `run` was called: the first ones of its items, without gaps.
  item_index begun() const noexcept { return begun_.load(std::memory_order_acquire); }
  /// The items that have ended since `run` was called. If a loop was stopped by items_ended, or by
  /// nothing, begun() and ended() are equal when it returns.
  item_index ended() const noexcept { return ended_.load(std::memory_order_acquire); }

  // For loops. `run` calls `start`.
  void start() noexcept {
    begun_.store(0, std::memory_order_relaxed);
    ended_.store(0, std::memory_order_relaxed);
  }
  void add_begun(item_index n) noexcept { begun_.fetch_add(n, std::memory_order_release); }
  void add_ended(item_index n) noexcept { ended_.fetch_add(n, std::memory_order_release); }

 private:
  std::atomic<item_index> begun_{0}, ended_{0};
  std::atomic<stop_when> stop_{stop_when::never};
};

/// The items of a loop, and the slots through which they pass.
struct items {
  item_index count;                ///< how many
  std::size_t slots;               ///< the entries of the renderer's arrays; at most max_requests
  item_index first = 0;            ///< the number of the first one
  run_control* control = nullptr;  ///< for a loop that is watched or stopped
};

}  // namespace deferred_shade
