// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/device_vector.h>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "compare.hpp"
#include "cuda.hpp"
#include "schedule_properties.hpp"

namespace test {

/// A batch in the memory of the current GPU alone, where no host function can read it by mistake.
/// It travels there and back on a stream of the caller's.
class device_batch {
 public:
  static constexpr std::uint32_t shaders = 5;

  explicit device_batch(std::uint32_t n)
      : n_(n), host_ids_(n), host_value_(n), host_runs_(n), ids_(n), value_(n), runs_(n) {
    cuda::wait();
  }

  /// Fills the batch with `ids`, and its trace with what no shader writes.
  void send(std::vector<std::uint8_t> const& ids, cudaStream_t stream) {
    trace<cpp> const empty(n_);
    host_ids_.assign(ids.begin(), ids.end());
    host_value_.assign(empty.value.begin(), empty.value.end());
    host_runs_.assign(empty.runs.begin(), empty.runs.end());
    copy(raw(ids_), host_ids_.data(), stream);
    copy(raw(value_), host_value_.data(), stream);
    copy(raw(runs_), host_runs_.data(), stream);
  }

  /// The trace comes back.
  void fetch(cudaStream_t stream) {
    copy(host_value_.data(), raw(value_), stream);
    copy(host_runs_.data(), raw(runs_), stream);
  }

  std::uint8_t const* ids() const { return thrust::raw_pointer_cast(ids_.data()); }
  auto table() { return tracing_table<shaders>(raw(value_), raw(runs_)); }

  /// The first request whose trace, as it was fetched, is not what a loop over `count` requests
  /// leaves; the size of the batch if there is none.
  std::size_t first_wrong(std::uint32_t count) const {
    trace<cpp> const expected = traced_by_loop<shaders>(n_, host_ids_.data(), count);
    return std::min(first_difference(host_runs_, expected.runs),
                    first_difference(host_value_, expected.value));
  }
  std::size_t first_wrong() const { return first_wrong(n_); }

 private:
  template <class T>
  static T* raw(thrust::device_vector<T>& data) {
    return thrust::raw_pointer_cast(data.data());
  }
  template <class T>
  void copy(T* to, T const* from, cudaStream_t stream) const {
    check_cuda(cudaMemcpyAsync(to, from, n_ * sizeof(T), cudaMemcpyDefault, stream));
  }

  std::uint32_t n_;
  cuda::vector<std::uint8_t> host_ids_;
  cuda::vector<float> host_value_;
  cuda::vector<std::uint32_t> host_runs_;
  thrust::device_vector<std::uint8_t> ids_;
  thrust::device_vector<float> value_;
  thrust::device_vector<std::uint32_t> runs_;
};

}  // namespace test
