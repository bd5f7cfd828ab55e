// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <deferred_shade/types.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "app/timeline.hpp"

namespace path_tracer {

/// Writes down what a rendering does and when. On the host that is by the steady clock: on a CPU
/// the work itself, with a GPU its submission. Inside of batches, the work on a device is written
/// down as well, by the clock of its stream.
template <class Backend>
class span_recorder {
 public:
  /// Records nothing where `most` is 0, else ends with the batch that reaches so many spans.
  span_recorder(Backend const& backend, std::size_t most) : most_(most), recording_(most > 0) {
    if (recording_) device_.emplace(backend);
    start_ = clock::now();
  }
  span_recorder(span_recorder const&) = delete;
  span_recorder& operator=(span_recorder const&) = delete;

  /// A span, from where open() made it to the end of its life.
  class scope {
   public:
    scope(span_recorder* recorder, std::size_t host, std::size_t piece)
        : recorder_(recorder), host_(host), piece_(piece) {}
    scope(scope const&) = delete;
    scope& operator=(scope const&) = delete;
    ~scope() {
      if (recorder_ != nullptr) recorder_->close(host_, piece_);
    }

   private:
    span_recorder* recorder_;
    std::size_t host_, piece_;
  };

  /// A batch begins, and ends: no span of it may be open then.
  void begin_batch() {
    recording_ = result_.spans.size() < most_;
    in_batch_ = true;
    if (most_ > 0) ++result_.batches;
    if (recording_) ++result_.batches_in_it;
  }
  void end_batch() {
    if constexpr (has_device) {
      if (recording_) read_device();
    }
    recording_ = most_ > 0;
    in_batch_ = false;
  }

  [[nodiscard]] scope open(std::string_view name, std::optional<std::uint64_t> requests = {}) {
    return open(span{std::string(name), {}, requests});
  }

  /// An observer for the library.
  auto observer() {
    return [this](deferred_shade::phase const& p) {
      return open(span{p.name, p.shader, p.requests});
    };
  }

  timeline take() { return std::move(result_); }

 private:
  using clock = std::chrono::steady_clock;
  using device_clock = typename Backend::device_clock;
  static constexpr bool has_device = device_clock::exists;
  static constexpr std::size_t no_piece = ~std::size_t{0};

  std::int64_t now() const {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(clock::now() - start_).count();
  }

  scope open(span s) {
    if (!recording_) return {nullptr, 0, 0};
    std::size_t piece = no_piece;
    std::size_t const host = result_.spans.size();
    if constexpr (has_device) {
      if (in_batch_) {
        pieces_.push_back(s);
        pieces_.back().on_device = true;
        piece = device_->begin();
      }
    }
    s.begin = s.end = now();
    result_.spans.push_back(std::move(s));
    return {this, host, piece};
  }

  void close(std::size_t host, [[maybe_unused]] std::size_t piece) noexcept {
    if constexpr (has_device) {
      if (piece != no_piece) device_->end(piece);
    }
    result_.spans[host].end = now();
  }

  void read_device() {
    auto const times = device_->read();
    for (std::size_t k = 0; k < times.size(); ++k) {
      std::tie(pieces_[k].begin, pieces_[k].end) = times[k];
      result_.spans.push_back(std::move(pieces_[k]));
    }
    pieces_.clear();
  }

  std::size_t most_;
  bool recording_, in_batch_ = false;
  clock::time_point start_;
  std::optional<device_clock> device_;
  std::vector<span> pieces_;  // of the batch, for the device
  timeline result_;
};

}  // namespace path_tracer
