// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>

#include <deferred_shade/items.hpp>

namespace deferred_shade::detail {

/// The items of a loop on a CPU, of which workers take some at a time.
class item_source {
 public:
  /// Items from `first` to `last` - 1.
  struct range {
    item_index first, last;
  };

  item_source(items const& all, std::size_t workers)
      : first_(all.first), count_(all.count), workers_(workers), control_(all.control) {}

  /// The next items that are left, at most `wanted`, and none if no further item is to begin. Near
  /// the end a worker gets fewer: all then end at about the same time.
  range take(item_index wanted) {
    if (stops() != stop_when::never) return {0, 0};
    item_index taken = taken_.load(std::memory_order_relaxed), n = 0;
    do {
      item_index const left = count_ - taken;
      item_index const share = workers_ == 1 ? left : left / (4 * workers_) + 1;
      n = (std::min)({wanted, share, left});
    } while (n != 0 && !taken_.compare_exchange_weak(taken, taken + n, std::memory_order_relaxed));
    if (control_ != nullptr) control_->add_begun(n);
    return {first_ + taken, first_ + taken + n};
  }

  /// Whether `take` may return items yet.
  bool has_more() const {
    return taken_.load(std::memory_order_relaxed) != count_ && stops() == stop_when::never;
  }

  void add_ended(item_index n) {
    if (control_ != nullptr) control_->add_ended(n);
  }

  /// Whether the loop is to end now.
  bool must_end() const { return stops() == stop_when::round_ended; }

 private:
  stop_when stops() const { return control_ == nullptr ? stop_when::never : control_->stops(); }

  item_index first_, count_;
  std::size_t workers_;
  run_control* control_;
  std::atomic<item_index> taken_{0};
};

}  // namespace deferred_shade::detail
