// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bitset>

#include <deferred_shade/detail/cpu/item_source.hpp>
#include <deferred_shade/detail/stage_shaders.hpp>
#include <deferred_shade/items.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {

/// What a loop runs: how an item begins, and its stages.
template <class Begin, class... Stages>
struct program {
  static constexpr shader_id none = sizeof...(Stages);
  using key = sort_key<none>;

  Begin const& begin;
  shader_table<Stages...> const& stages;

  /// The stage that item `k` needs first in `slot`, or `none`.
  shader_id start(request_index slot, item_index k) const {
    return known(static_cast<shader_id>(begin(slot, k)));
  }

  /// Runs stages on a slot to the end of its request. Returns whether it got there: a loop may be
  /// stopped before.
  bool finish(request_index slot, shader_id id, item_source const& source) const {
    while (id < none) {
      if (source.must_end()) return false;
      shader_id next = none;
      stages.visit(id, [slot, &next](auto const& stage) { next = detail::run_stage(stage, slot); });
      id = known(next);
    }
    return true;
  }

  /// The same id, or `none` if it names no stage that is expected.
  shader_id known(shader_id id) const { return id < none && expected[id] ? id : none; }

  std::bitset<sizeof...(Stages)> expected = stages.expected();
};

/// The slots of one worker, from `first` on.
template <class Program>
class pool {
  using key = typename Program::key;
  static constexpr auto none = static_cast<key>(Program::none);

 public:
  /// `next` has `size` elements.
  pool(Program const& what, request_index first, request_index size, key* next)
      : what_(what), first_(first), size_(size), next_(next) {
    std::fill_n(next_, size_, none);
  }

  request_index size() const { return size_; }
  /// The slots with a request that has not ended.
  request_index live() const { return live_; }
  /// The stages that the slots need next; `Program::none` for those that have ended.
  key* next() const { return next_; }
  next_stages<key> target() const { return {next_, first_, none}; }

  /// Begins an item in every slot that has none, as long as there are any.
  void refill(item_source& source) {
    request_index slot = 0;
    while (live_ < size_) {
      auto [item, last] = source.take(size_ - live_);
      if (item == last) return;
      item_index ended = 0;
      for (; item != last; ++item) {
        while (next_[slot] != none) ++slot;
        next_[slot] = static_cast<key>(what_.start(first_ + slot, item));
        if (next_[slot] != none) {
          ++live_;
        } else {
          ++ended;
        }
      }
      source.add_ended(ended);
    }
  }

  /// Counts the requests that have ended in a round.
  void count_ended(item_source& source) {
    if (!what_.expected.all()) {
      for (request_index i = 0; i < size_; ++i) next_[i] = static_cast<key>(what_.known(next_[i]));
    }
    request_index live = 0;
    for (request_index i = 0; i < size_; ++i) live += next_[i] != none;
    source.add_ended(live_ - live);
    live_ = live;
  }

  /// Runs every request to its end.
  void finish(item_source& source) {
    for (request_index i = 0; i < size_; ++i) {
      if (next_[i] == none) continue;
      if (!what_.finish(first_ + i, next_[i], source)) return;
      next_[i] = none;
      source.add_ended(1);
    }
    live_ = 0;
  }

 private:
  Program const& what_;
  request_index first_, size_, live_ = 0;
  key* next_;
};

}  // namespace deferred_shade::detail
