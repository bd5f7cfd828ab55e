// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <utility>
#include <vector>

namespace path_tracer {

/// What the integrator asks of the machine that it runs on: a Thrust execution policy, arrays in
/// memory that the policy's workers reach, their elements on the host, and clocks. This one is for
/// the policies of CPUs; that of GPUs has the same members.
template <class Policy>
class host_backend {
 public:
  explicit host_backend(Policy exec) : exec_(exec) {}

  Policy const& policy() const { return exec_; }

  /// An array of `n` elements, each T{}; its data() may be wrapped, see thrust::raw_pointer_cast.
  template <class T>
  std::vector<T> make_array(std::size_t n) const {
    return std::vector<T>(n, T{});
  }

  /// `n` elements for the host, or an array, once all that was started before is done.
  template <class T>
  std::vector<T> to_host(T const* first, std::size_t n) const {
    return {first, first + n};
  }
  template <class T>
  std::vector<T> to_host(std::vector<T>&& array) const {
    return std::move(array);
  }

  /// Measures from start() to stop() what the policy runs in between.
  class stopwatch {
   public:
    explicit stopwatch(host_backend const&) {}
    void start() { start_ = clock::now(); }
    void stop() { stop_ = clock::now(); }
    double milliseconds() const {
      return std::chrono::duration<double, std::milli>(stop_ - start_).count();
    }

   private:
    using clock = std::chrono::steady_clock;
    clock::time_point start_, stop_;
  };

  /// A CPU has no clock but the host's.
  struct device_clock {
    static constexpr bool exists = false;
    explicit device_clock(host_backend const&) {}
  };

 private:
  Policy exec_;
};

}  // namespace path_tracer
