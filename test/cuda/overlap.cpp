// SPDX-License-Identifier: Apache-2.0
// Batches one right behind the other, between kernels of the renderer and with nothing in between
// that would wait: from compute capability 9.0 on, their kernels overlap, and none may run ahead of
// what it needs.
// Covers detail/cuda/overlap.hpp.
#include <cuda_runtime.h>
#include <thrust/device_vector.h>
#include <cstdint>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "support/compare.hpp"
#include "support/cuda.hpp"
#include "support/every_schedule.hpp"
#include "support/random_ids.hpp"

namespace ds = deferred_shade;

namespace {

using test::check_cuda;

constexpr std::uint32_t shaders = 5;

/// The shader that request i names in a round: one of the five, or none.
DEFERRED_SHADE_HOST_DEVICE std::uint8_t id_of(ds::request_index i, std::uint32_t round) {
  std::uint32_t x = (i + 1) * 2654435761U ^ (round + 1) * 2246822519U;
  x = (x ^ x >> 15) * 739995745U;
  return static_cast<std::uint8_t>((x ^ x >> 12) % (shaders + 2));
}

DEFERRED_SHADE_HOST_DEVICE std::uint32_t next_sum(std::uint32_t sum, std::uint32_t id) {
  return sum * 5 + id + 1;
}

/// Keeps a thread in 64 of its block busy for a while.
__device__ void linger([[maybe_unused]] ds::request_index i) {
  if (i % 64 == 0) __nanosleep(20000);
}

/// The renderer's part: it writes the ids of a round late, and lets what follows start early.
__global__ void write_ids(std::uint32_t n, std::uint32_t const* round, std::uint8_t* ids) {
#if __CUDA_ARCH__ >= 900
  asm volatile("griddepcontrol.launch_dependents;");
#endif
  ds::request_index const i = blockIdx.x * blockDim.x + threadIdx.x;
  linger(i);
  if (i < n) ids[i] = id_of(i, *round);
}

__global__ void begin_next_round(std::uint32_t* round) { ++*round; }

/// The first shader is slow, so that the others would be done before it.
struct summing_shader {
  std::uint32_t id;
  std::uint32_t* sums;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const {
#ifdef __CUDA_ARCH__
    if (id == 0) linger(i);
#endif
    sums[i] = next_sum(sums[i], id);
  }
};

/// Rounds of a renderer: ids are written and shaded, again and again.
class rounds {
 public:
  explicit rounds(std::uint32_t n) : n_(n), ids_(n), sums_(n), round_(1), expected_(n) {
    test::cuda::wait();
  }

  void write(cudaStream_t stream) {
    write_ids<<<(n_ + 255) / 256, 256, 0, stream>>>(n_, raw(round_), raw(ids_));
    check_cuda(cudaGetLastError());
  }
  template <class Schedule, class Workspace>
  void shade(cudaStream_t stream, Schedule const& schedule, Workspace& scratch) {
    std::uint32_t* const sums = raw(sums_);
    ds::shade(
        thrust::cuda::par_nosync.on(stream), schedule, n_,
        static_cast<std::uint8_t const*>(raw(ids_)),
        ds::shader_table{summing_shader{0, sums}, summing_shader{1, sums}, summing_shader{2, sums},
                         summing_shader{3, sums}, summing_shader{4, sums}},
        scratch);
  }
  void advance(cudaStream_t stream) {
    begin_next_round<<<1, 1, 0, stream>>>(raw(round_));
    check_cuda(cudaGetLastError());
  }

  /// Notes that the ids of the next round are shaded `batches` times.
  void expect(std::uint32_t batches) {
    for (; batches > 0; --batches) {
      for (std::uint32_t i = 0; i < n_; ++i) {
        std::uint32_t const id = id_of(i, expected_rounds_);
        if (id < shaders) expected_[i] = next_sum(expected_[i], id);
      }
    }
    ++expected_rounds_;
  }

  /// Whether every request has gone through all that is expected; for the first time, it waits.
  bool are_right(cudaStream_t stream) {
    std::vector<std::uint32_t> sums(n_);
    check_cuda(cudaMemcpyAsync(sums.data(), raw(sums_), n_ * sizeof(std::uint32_t),
                               cudaMemcpyDeviceToHost, stream));
    check_cuda(cudaStreamSynchronize(stream));
    return test::first_difference(sums, expected_) == n_;
  }

 private:
  template <class T>
  static T* raw(thrust::device_vector<T>& data) {
    return thrust::raw_pointer_cast(data.data());
  }

  std::uint32_t n_;
  thrust::device_vector<std::uint8_t> ids_;
  thrust::device_vector<std::uint32_t> sums_;
  thrust::device_vector<std::uint32_t> round_;
  std::vector<std::uint32_t> expected_;
  std::uint32_t expected_rounds_ = 0;
};

std::uint32_t batch_size() { return test::quick() ? 8193 : 200003; }

}  // namespace

TEST_CASE("batches of one schedule follow each other", "[cuda]") {
  test::for_each_schedule([](auto schedule) {
    test::stream const stream;
    rounds all(batch_size());
    ds::workspace scratch{thrust::cuda::par};
    for (int round = 0; round < 4; ++round) {
      all.write(stream);
      all.shade(stream, schedule, scratch);
      all.shade(stream, schedule, scratch);
      all.advance(stream);
      all.expect(2);
    }
    CHECK(all.are_right(stream));
  });
}

TEST_CASE("batches of different schedules follow each other", "[cuda]") {
  test::stream const stream;
  rounds all(batch_size());
  ds::workspace scratch{thrust::cuda::par};
  for (int time = 0; time < 3; ++time) {
    test::for_each_schedule([&](auto schedule) {
      all.write(stream);
      all.shade(stream, schedule, scratch);
      all.shade(stream, ds::bucket_then_dispatch<>{}, scratch);
      all.advance(stream);
      all.expect(2);
    });
  }
  CHECK(all.are_right(stream));
}

TEST_CASE("captured batches follow each other", "[cuda]") {
  test::for_each_schedule([](auto schedule) {
    std::uint32_t const n = batch_size();
    test::stream const stream;
    rounds all(n);
    ds::workspace scratch{thrust::cuda::par};
    scratch.reserve(n, shaders);
    cudaGraph_t graph = nullptr;
    cudaGraphExec_t bounce = nullptr;
    check_cuda(cudaStreamBeginCapture(stream, cudaStreamCaptureModeThreadLocal));
    all.write(stream);
    all.shade(stream, schedule, scratch);
    all.shade(stream, schedule, scratch);
    all.advance(stream);
    check_cuda(cudaStreamEndCapture(stream, &graph));
    check_cuda(cudaGraphInstantiate(&bounce, graph, 0));
    for (int round = 0; round < 4; ++round) {
      check_cuda(cudaGraphLaunch(bounce, stream));
      all.expect(2);
    }
    CHECK(all.are_right(stream));
    check_cuda(cudaGraphExecDestroy(bounce));
    check_cuda(cudaGraphDestroy(graph));
  });
}
