// SPDX-License-Identifier: Apache-2.0
// What a workspace takes of a GPU's memory, from whom, and what happens when there is none left.
// Covers cuda.hpp.
#include <thrust/device_allocator.h>
#include <thrust/mr/allocator.h>
#include <thrust/mr/disjoint_pool.h>
#include <thrust/mr/new.h>
#include <thrust/system/cuda/memory_resource.h>
#include <algorithm>
#include <new>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "support/device_batch.hpp"
#include "support/every_schedule.hpp"
#include "support/ledger.hpp"

namespace ds = deferred_shade;

namespace {

constexpr std::uint32_t shaders = test::device_batch::shaders;

using counted = test::ledger_allocator<std::byte, test::cuda>;

/// A shader that no GPU can launch by itself: a block has at most 1024 threads.
struct too_wide {
  static constexpr int block_size = 4096;
  int* runs;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const { ++runs[i]; }
};

std::vector<std::uint8_t> random_ids(std::uint32_t n) {
  return test::make_ids<std::uint8_t>(test::layout::random, n, shaders, test::run_seed());
}

/// Runs `schedule` on a batch of random ids; whether it is right.
template <class Schedule, class Allocator>
bool shades_right(Schedule const& schedule, test::device_batch& batch, std::uint32_t n,
                  ds::workspace<Allocator>& scratch) {
  batch.send(random_ids(n), cudaStream_t{});
  ds::shade(test::cuda::policy(), schedule, n, batch.ids(), batch.table(), scratch);
  batch.fetch(cudaStream_t{});
  test::cuda::wait();
  return batch.first_wrong() == n;
}

/// Runs what groups through a workspace, with every grouping.
template <class Allocator>
void check_workspace(ds::workspace<Allocator>& scratch) {
  std::uint32_t const n = 20011;
  CAPTURE(test::run_seed());
  test::device_batch batch(n);
  CHECK(shades_right(ds::compact_then_dispatch<>{}, batch, n, scratch));
  CHECK(shades_right(ds::sort_then_dispatch<>{}, batch, n, scratch));
  CHECK(shades_right(ds::bucket_then_dispatch<>{}, batch, n, scratch));
}

}  // namespace

TEST_CASE("a workspace on a GPU allocates when a batch is the largest so far", "[cuda]") {
  CAPTURE(test::run_seed());
  test::for_each_schedule([](auto schedule) {
    test::ledger book;
    ds::workspace scratch{counted(book)};
    std::size_t most = 0;
    for (std::uint32_t const n : {100U, 30011U, 29000U, 100U, 30011U}) {
      test::device_batch batch(n);
      std::size_t const before = book.allocations;
      CHECK(shades_right(schedule, batch, n, scratch));
      CHECK(book.allocations <= before + (n > most ? 1 : 0));
      CHECK(book.live_bytes == scratch.capacity());
      most = std::max<std::size_t>(most, n);
    }
  });
}

TEST_CASE("a workspace from a CUDA policy is on the GPU", "[cuda]") {
  ds::workspace scratch{test::cuda::policy()};
  STATIC_REQUIRE(std::is_same_v<decltype(scratch), ds::workspace<ds::cuda_allocator<std::byte>>>);
  int* const array = std::get<0>(scratch.take(ds::elements<int>(1000)));
  cudaPointerAttributes attributes{};
  test::check_cuda(cudaPointerGetAttributes(&attributes, array));
  CHECK(attributes.type == cudaMemoryTypeDevice);
  CHECK(reinterpret_cast<std::uintptr_t>(array) % 128 == 0);
}

// [api_error]: a call of the CUDA runtime fails on purpose, which a tool that watches it reports.
TEST_CASE("memory that a GPU does not have is refused by name, and harms nothing",
          "[cuda][api_error]") {
  std::size_t free = 0;
  std::size_t total = 0;
  test::check_cuda(cudaMemGetInfo(&free, &total));
  std::size_t const bytes = total / 128 * 128 * 2;
  ds::workspace scratch{test::cuda::policy()};
  std::string message;
  try {
    scratch.take(ds::elements<std::byte>(bytes));
  } catch (ds::cuda_error const& error) {
    message = error.what();
    CHECK(error.code() == cudaErrorMemoryAllocation);
  }
  CAPTURE(message);
  // With what the workspace aligns by.
  CHECK(message.find(std::to_string(bytes + 128) + " bytes") != std::string::npos);
  CHECK(scratch.capacity() == 0);
  CHECK(cudaGetLastError() == cudaSuccess);
  check_workspace(scratch);
}

TEST_CASE("an array whose bytes do not fit a size has no memory", "[cuda]") {
  auto const too_many = static_cast<std::size_t>(-1) / sizeof(double) + 2;
  CHECK_THROWS_AS(ds::cuda_allocator<double>().allocate(too_many), std::bad_array_new_length);
}

TEST_CASE("a batch whose memory is refused leaves results alone", "[cuda]") {
  std::uint32_t const n = 30011;
  CAPTURE(test::run_seed());
  test::for_each_schedule([n](auto schedule) {
    test::ledger book;
    ds::workspace scratch{counted(book)};
    test::device_batch batch(n);
    thrust::device_vector<std::uint32_t> const count(1, n);
    book.limit = 4096;
    CHECK_THROWS_AS(scratch.reserve(n, shaders), std::bad_alloc);
    batch.send(random_ids(n), cudaStream_t{});
    // A device_count takes its memory whatever the schedule needs.
    CHECK_THROWS_AS(ds::shade(test::cuda::policy(), schedule,
                              ds::device_count{thrust::raw_pointer_cast(count.data()), n},
                              batch.ids(), batch.table(), scratch),
                    std::bad_alloc);
    batch.fetch(cudaStream_t{});
    test::cuda::wait();
    CHECK(batch.first_wrong(0) == n);
    CHECK(scratch.capacity() == 0);
    CHECK(book.live_bytes == 0);
    book.limit = static_cast<std::size_t>(-1);
    CHECK(shades_right(schedule, batch, n, scratch));
  });
}

TEST_CASE("a workspace takes Thrust's allocators and memory resources", "[cuda]") {
  ds::workspace from_allocator{thrust::device_allocator<std::byte>()};
  check_workspace(from_allocator);

  thrust::cuda::memory_resource device;
  using device_memory = thrust::mr::allocator<std::byte, thrust::cuda::memory_resource>;
  ds::workspace from_resource{device_memory(&device)};
  check_workspace(from_resource);

  using pool_type =
      thrust::mr::disjoint_unsynchronized_pool_resource<thrust::cuda::memory_resource,
                                                        thrust::mr::new_delete_resource>;
  thrust::mr::new_delete_resource host;
  pool_type pool(&device, &host, pool_type::get_default_options());
  using pooled_memory = thrust::mr::allocator<std::byte, pool_type>;
  ds::workspace from_pool{pooled_memory(&pool)};
  check_workspace(from_pool);
  ds::workspace moved{std::move(from_pool)};
  check_workspace(moved);
}

TEST_CASE("a launch that CUDA refuses is an error of CUDA, and harms nothing",
          "[cuda][api_error]") {
  std::uint32_t const n = 1000;
  auto const exec = test::cuda::policy();
  auto const ids = test::on<test::cuda>(std::vector<std::uint8_t>(n, 0));
  auto runs = test::on<test::cuda>(std::vector<int>(n, 0));
  ds::workspace scratch{exec};
  auto const check = [&](auto schedule) {
    CHECK_THROWS_AS(
        ds::shade(exec, schedule, n, ids.data(), ds::shader_table{too_wide{runs.data()}}, scratch),
        ds::cuda_error);
    test::cuda::wait();
    CHECK(runs == test::on<test::cuda>(std::vector<int>(n, 0)));
    CHECK(cudaGetLastError() == cudaSuccess);
  };
  check(ds::explicit_serialization{});
  check(ds::bucket_then_dispatch<>{});
  check_workspace(scratch);
}

TEST_CASE("a workspace that ends while a stream is captured gives its memory back", "[cuda]") {
  auto const free_bytes = [] {
    std::size_t free = 0, total = 0;
    test::check_cuda(cudaMemGetInfo(&free, &total));
    return free;
  };
  std::size_t const bytes = std::size_t{256} << 20;
  ds::workspace first{test::cuda::policy()};  // so that the context is there
  first.reserve_bytes(1000);
  std::size_t const before = free_bytes();
  cudaStream_t stream{};
  test::check_cuda(cudaStreamCreate(&stream));
  {
    ds::workspace scratch{test::cuda::policy()};
    scratch.reserve_bytes(bytes);
    CHECK(free_bytes() + bytes <= before);
    test::check_cuda(cudaStreamBeginCapture(stream, cudaStreamCaptureModeGlobal));
  }
  cudaGraph_t graph{};
  test::check_cuda(cudaStreamEndCapture(stream, &graph));  // the capture is not broken off
  {
    ds::workspace next{test::cuda::policy()};
    next.reserve_bytes(1000);
  }
  CHECK(free_bytes() + bytes / 2 >= before);
  test::check_cuda(cudaGraphDestroy(graph));
  test::check_cuda(cudaStreamDestroy(stream));
}
