// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cuda_runtime_api.h>
#include <thrust/device_ptr.h>
#include <thrust/device_vector.h>
#include <thrust/mr/allocator.h>
#include <thrust/mr/disjoint_pool.h>
#include <thrust/mr/new.h>
#include <thrust/system/cuda/error.h>
#include <thrust/system/cuda/execution_policy.h>
#include <thrust/system/cuda/memory_resource.h>
#include <thrust/system_error.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace path_tracer {

/// Throws thrust::system_error where a call of the CUDA runtime failed.
inline void check_cuda(cudaError_t status, char const* what) {
  if (status != cudaSuccess) throw thrust::system_error(status, thrust::cuda_category(), what);
}

/// The current CUDA device: everything runs on one stream of it, see host_backend. Throws
/// thrust::system_error where there is none, std::runtime_error where its memory is too small.
class cuda_backend {
 public:
  cuda_backend() { check_cuda(cudaStreamCreate(&stream_), "cannot render with CUDA"); }
  ~cuda_backend() { cudaStreamDestroy(stream_); }
  cuda_backend(cuda_backend const&) = delete;
  cuda_backend& operator=(cuda_backend const&) = delete;

  /// What Thrust's reductions need for a moment comes from a pool: allocating it would wait for the
  /// device each time.
  auto policy() const { return thrust::cuda::par_nosync(allocator_).on(stream_); }

  template <class T>
  thrust::device_vector<T> make_array(std::size_t n) const {
    return allocated<T>(n, [&] { return thrust::device_vector<T>(n, T{}); });
  }

  /// A copy of host memory on the device.
  template <class T>
  thrust::device_vector<T> to_device(T const* first, std::size_t n) const {
    return allocated<T>(n, [&] { return thrust::device_vector<T>(first, first + n); });
  }

  template <class T>
  std::vector<T> to_host(T const* first, std::size_t n) const {
    std::vector<T> result(n);
    check_cuda(
        cudaMemcpyAsync(result.data(), first, n * sizeof(T), cudaMemcpyDeviceToHost, stream_),
        "cannot copy from the CUDA device");
    check_cuda(cudaStreamSynchronize(stream_), "the CUDA device failed");
    return result;
  }
  template <class T>
  std::vector<T> to_host(thrust::device_vector<T>&& array) const {
    return to_host(thrust::raw_pointer_cast(array.data()), array.size());
  }

  struct event {
    cudaEvent_t handle = nullptr;
    event() { check_cuda(cudaEventCreate(&handle), "cannot create a CUDA event"); }
    ~event() { cudaEventDestroy(handle); }
    event(event const&) = delete;
    event& operator=(event const&) = delete;
    void record(cudaStream_t stream) {
      check_cuda(cudaEventRecord(handle, stream), "cannot record a CUDA event");
    }
    void wait() const { check_cuda(cudaEventSynchronize(handle), "the CUDA device failed"); }
    double milliseconds_since(event const& start) const {
      float result = 0;
      check_cuda(cudaEventElapsedTime(&result, start.handle, handle), "cannot read a CUDA event");
      return double{result};
    }
  };

  /// Measures by events: what the stream takes from start() to stop(). Reading it waits for the
  /// second.
  class stopwatch {
   public:
    explicit stopwatch(cuda_backend const& backend) : stream_(backend.stream_) {}
    void start() { start_.record(stream_); }
    void stop() { stop_.record(stream_); }
    double milliseconds() const {
      stop_.wait();
      return stop_.milliseconds_since(start_);
    }

   private:
    cudaStream_t stream_;
    event start_, stop_;
  };

  /// When the stream begins and ends pieces of work, of which the first one holds the others, by
  /// events, which resolve half a microsecond. Time 0 is when the clock is made: the stream is
  /// waited for then, so that it is the host's as well, but for what that takes.
  class device_clock {
   public:
    static constexpr bool exists = true;

    explicit device_clock(cuda_backend const& backend) : stream_(backend.stream_) {
      base_.record(stream_);
      base_.wait();
    }

    /// The number of a piece that begins here.
    std::size_t begin() {
      if (used_ == pieces_.size()) pieces_.emplace_back();
      pieces_[used_].begin.record(stream_);
      return used_++;
    }
    /// What fails here fails the next call too.
    void end(std::size_t piece) noexcept { cudaEventRecord(pieces_[piece].end.handle, stream_); }

    /// Waits for the pieces since the last call and tells when each began and ended, in
    /// nanoseconds.
    std::vector<std::pair<std::int64_t, std::int64_t>> read() {
      std::vector<std::pair<std::int64_t, std::int64_t>> times(used_);
      if (used_ == 0) return times;
      pieces_[0].end.wait();
      for (std::size_t k = 0; k < used_; ++k)
        times[k] = {nanoseconds(pieces_[k].begin), nanoseconds(pieces_[k].end)};
      // From here on times count from the last event, since a float has digits for a while only.
      base_time_ = times[0].second;
      std::swap(base_.handle, pieces_[0].end.handle);
      used_ = 0;
      return times;
    }

   private:
    struct piece {
      event begin, end;
    };
    std::int64_t nanoseconds(event const& e) const {
      return base_time_ + std::llround(1e6 * e.milliseconds_since(base_));
    }

    cudaStream_t stream_;
    event base_;
    std::int64_t base_time_ = 0;
    std::deque<piece> pieces_;  // which never moves an element
    std::size_t used_ = 0;
  };

 private:
  using pool = thrust::mr::disjoint_unsynchronized_pool_resource<thrust::cuda::memory_resource,
                                                                 thrust::mr::new_delete_resource>;

  template <class T, class Function>
  static auto allocated(std::size_t n, Function const& f) {
    try {
      return f();
    } catch (std::bad_alloc const&) {
      throw std::runtime_error("the CUDA device is out of memory: no room for an array of " +
                               std::to_string(n * sizeof(T)) + " bytes");
    }
  }

  cudaStream_t stream_ = nullptr;
  pool pool_;
  mutable thrust::mr::allocator<char, pool> allocator_{&pool_};
};

}  // namespace path_tracer
