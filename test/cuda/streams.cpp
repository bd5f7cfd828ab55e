// SPDX-License-Identifier: Apache-2.0
// Several host threads, streams and GPUs at once, and the order of work on one stream.
#include <thrust/device_allocator.h>
#include <thrust/execution_policy.h>
#include <atomic>
#include <chrono>
#include <exception>
#include <string>
#include <thread>
#include <vector>

#include "catch.hpp"
#include "support/device_batch.hpp"
#include "support/every_schedule.hpp"

namespace ds = deferred_shade;

namespace {

constexpr std::uint32_t shaders = test::device_batch::shaders;

std::vector<std::uint8_t> some_ids(std::uint32_t n, std::uint32_t seed) {
  return test::make_ids<std::uint8_t>(seed % 2 == 0 ? test::layout::random : test::layout::coherent,
                                      n, shaders, seed);
}

int device_count() {
  int count = 0;
  test::check_cuda(cudaGetDeviceCount(&count));
  return count;
}

/// Runs every schedule `rounds` times on a stream of its own, with data of its own. Returns what
/// went wrong first: Catch2 takes no assertion from a second thread.
std::string shade_on_own_stream(int device, std::uint32_t seed, std::uint32_t rounds) try {
  test::check_cuda(cudaSetDevice(device));
  std::string wrong;
  test::stream stream;
  auto const exec = thrust::cuda::par_nosync.on(stream);
  std::uint32_t const n = 30011 + seed % 5000;
  test::device_batch batch(n);
  ds::workspace scratch{exec};
  for (std::uint32_t round = 0; round < rounds; ++round) {
    int number = 0;
    test::for_each_schedule([&](auto schedule) {
      batch.send(some_ids(n, seed + round), stream);
      ds::shade(exec, schedule, n, batch.ids(), batch.table(), scratch);
      batch.fetch(stream);
      stream.wait();
      if (wrong.empty() && batch.first_wrong() != n) {
        wrong = "device " + std::to_string(device) + ", schedule " + std::to_string(number) +
                ", round " + std::to_string(round) + ", request " +
                std::to_string(batch.first_wrong());
      }
      ++number;
    });
  }
  return wrong;
} catch (std::exception const& error) {
  return error.what();
}

/// `per_device` threads for each of `devices` GPUs, all at once.
void check_threads(int devices, int per_device) {
  std::uint32_t const seed = test::run_seed();
  CAPTURE(seed);
  std::uint32_t const rounds = test::quick() ? 1 : 10;
  auto const count = static_cast<std::size_t>(devices * per_device);
  std::vector<std::string> wrong(count);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < count; ++t) {
    int const device = static_cast<int>(t) % devices;
    threads.emplace_back([&wrong, t, device, seed, rounds] {
      wrong[t] = shade_on_own_stream(device, seed + 1000 * static_cast<std::uint32_t>(t), rounds);
    });
  }
  for (auto& thread : threads) thread.join();
  for (std::string const& message : wrong) CHECK(message == "");
}

/// Something that work on a stream waits for. A host that waits for the stream in vain is let go
/// after a while: the test fails then, and does not hang.
class gate {
 public:
  explicit gate(cudaStream_t stream) {
    test::check_cuda(cudaLaunchHostFunc(stream, &gate::wait, this));
  }
  gate(gate const&) = delete;
  gate& operator=(gate const&) = delete;
  ~gate() {
    open();
    while (!passed_) std::this_thread::yield();
  }
  void open() { open_ = true; }

 private:
  static void CUDART_CB wait(void* self) {
    auto* const that = static_cast<gate*>(self);
    auto const end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!that->open_ && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    that->passed_ = true;
  }
  std::atomic<bool> open_{false};
  std::atomic<bool> passed_{false};
};

}  // namespace

TEST_CASE("four threads shade at once, each on a stream with a workspace of its own", "[cuda]") {
  check_threads(1, 4);
}

TEST_CASE("all GPUs shade at once, each with a workspace of its own", "[cuda]") {
  check_threads(device_count(), 1);
}

TEST_CASE("one thread goes from GPU to GPU", "[cuda]") {
  // What a launch asks a GPU for must not be remembered for another one.
  for (int round = 0; round < 2; ++round) {
    for (int device = 0; device < device_count(); ++device) {
      CHECK(shade_on_own_stream(device, test::run_seed(), 1) == "");
    }
  }
  test::check_cuda(cudaSetDevice(0));
}

TEST_CASE("shade returns before it has run, and runs in the order of its stream", "[cuda]") {
  std::uint32_t const n = 30011;
  std::uint32_t const seed = test::run_seed();
  CAPTURE(seed);
  test::stream stream;
  test::device_batch batch(n);
  auto const check = [&](auto const& exec, auto schedule) {
    ds::workspace scratch{exec};
    // Warm: memory and the code of the kernels are on the GPU.
    batch.send(some_ids(n, seed), stream);
    ds::shade(exec, schedule, n, batch.ids(), batch.table(), scratch);
    batch.fetch(stream);
    stream.wait();
    REQUIRE(batch.first_wrong() == n);
    // Other ids follow, which no one sees who does not wait for the stream.
    gate closed(stream);
    batch.send(some_ids(n, seed + 1), stream);
    ds::shade(exec, schedule, n, batch.ids(), batch.table(), scratch);
    batch.fetch(stream);
    CHECK(cudaStreamQuery(stream) == cudaErrorNotReady);
    cudaGetLastError();  // that was no error
    closed.open();
    stream.wait();
    CHECK(batch.first_wrong() == n);
  };
  test::for_each_schedule(
      [&](auto schedule) { check(thrust::cuda::par_nosync.on(stream), schedule); });
  check(thrust::cuda::par.on(stream), ds::sort_then_dispatch<>{});
  check(thrust::cuda::par.on(stream), ds::compact_then_dispatch<>{});
  check(thrust::cuda::par.on(stream), ds::bucket_then_dispatch<ds::implicit_serialization>{});
}

TEST_CASE("every kind of CUDA policy will do", "[cuda]") {
  std::uint32_t const n = 10007;
  test::device_batch batch(n);
  std::uint32_t seed = test::run_seed();
  auto const check = [&](auto const& exec, cudaStream_t stream) {
    ++seed;
    CAPTURE(seed);
    ds::workspace scratch{exec};
    auto const check_schedule = [&](auto schedule) {
      batch.send(some_ids(n, seed), stream);
      ds::shade(exec, schedule, n, batch.ids(), batch.table(), scratch);
      batch.fetch(stream);
      test::check_cuda(cudaStreamSynchronize(stream));
      CHECK(batch.first_wrong() == n);
    };
    check_schedule(ds::explicit_serialization{});
    check_schedule(ds::sort_then_dispatch<>{});
    check_schedule(ds::bucket_then_dispatch<>{});
  };
  test::stream stream;
  thrust::device_allocator<std::byte> memory;
  cudaStream_t const default_stream{};
  check(thrust::device, default_stream);
  check(thrust::cuda::par, default_stream);
  check(thrust::cuda::par_nosync, default_stream);
  check(thrust::cuda::par.on(stream), stream);
  check(thrust::cuda::par_nosync.on(stream), stream);
  check(thrust::cuda::par(memory).on(stream), stream);
}
