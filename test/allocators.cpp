// SPDX-License-Identifier: Apache-2.0
// Allocators that a renderer may bring: with pointers of their own kind, and with memory that is
// aligned to whatever they like.
#include <deferred_shade/workspace.hpp>

#include <cstdint>
#include <cstdlib>
#include <deferred_shade/deferred_shade.hpp>
#include <memory>

#include "catch.hpp"
#include "support/every_schedule.hpp"
#include "support/schedule_properties.hpp"

namespace ds = deferred_shade;

namespace test_allocators {

/// A pointer that knows its address relative to a base, as those into shared memory do.
template <class T>
class offset_pointer {
 public:
  using element_type = T;
  using difference_type = std::ptrdiff_t;
  using value_type = std::remove_cv_t<T>;
  using pointer = offset_pointer;
  using reference = std::add_lvalue_reference_t<T>;
  using iterator_category = std::random_access_iterator_tag;
  template <class U>
  using rebind = offset_pointer<U>;

  offset_pointer() = default;
  offset_pointer(std::nullptr_t) {}
  explicit offset_pointer(T* address) : offset_(reinterpret_cast<std::uintptr_t>(address) - base) {}
  T* operator->() const { return reinterpret_cast<T*>(offset_ + base); }
  reference operator*() const { return *operator->(); }
  friend bool operator==(offset_pointer a, offset_pointer b) { return a.offset_ == b.offset_; }
  friend bool operator!=(offset_pointer a, offset_pointer b) { return a.offset_ != b.offset_; }

 private:
  static constexpr std::uintptr_t base = 0x1234567;
  std::uintptr_t offset_ = std::uintptr_t{0} - base;
};

/// Gives memory that lies `Past` bytes behind a multiple of 128, whatever the type asks for.
template <class T, std::size_t Past>
struct misaligning_allocator {
  using value_type = T;
  template <class U>
  struct rebind {
    using other = misaligning_allocator<U, Past>;
  };
  misaligning_allocator() = default;
  template <class U>
  misaligning_allocator(misaligning_allocator<U, Past> const&) {}
  T* allocate(std::size_t n) {
    void* const memory = ::operator new (n * sizeof(T) + 256, std::align_val_t{128});
    return reinterpret_cast<T*>(static_cast<char*>(memory) + Past);
  }
  void deallocate(T* p, std::size_t) {
    ::operator delete (reinterpret_cast<char*>(p) - Past, std::align_val_t{128});
  }
  bool operator==(misaligning_allocator const&) const { return true; }
};

template <class T>
struct offset_allocator {
  using value_type = T;
  using pointer = offset_pointer<T>;
  offset_allocator() = default;
  template <class U>
  offset_allocator(offset_allocator<U> const&) {}
  pointer allocate(std::size_t n) { return pointer(std::allocator<T>().allocate(n)); }
  void deallocate(pointer p, std::size_t n) { std::allocator<T>().deallocate(p.operator->(), n); }
  bool operator==(offset_allocator const&) const { return true; }
};

template <class Allocator>
void check_allocator() {
  ds::workspace<Allocator> scratch{Allocator{}};
  for (std::size_t const n : {1U, 100U, 1000U, 5000U, 20000U, 1000000U}) {
    CAPTURE(n);
    ds::workspace<Allocator> fresh{Allocator{}};
    auto const [floats, ints] = fresh.take(ds::elements<float>(n), ds::elements<int>(3));
    CHECK(reinterpret_cast<std::uintptr_t>(floats) % 128 == 0);
    CHECK(reinterpret_cast<std::uintptr_t>(ints) % 128 == 0);
    CHECK(fresh.capacity() >= 4 * n + 12);
    std::fill_n(floats, n, 1.0F);  // a sanitizer sees what is not the workspace's
    std::fill_n(ints, 3, 1);
  }
  std::uint32_t const seed = test::run_seed();
  auto const ids = test::make_ids<std::uint8_t>(test::layout::random, 20011, 5, seed);
  ds::for_each_schedule([&](char const* name, auto const& schedule) {
    CAPTURE(name, seed);
    test::check_against_loop<test::cpp, 5>(schedule, 20011, ids.data(), scratch);
  });
}

}  // namespace test_allocators

using namespace test_allocators;

TEST_CASE("arrays are aligned whatever the allocator makes of it", "[workspace]") {
  check_allocator<misaligning_allocator<std::byte, 0>>();
  check_allocator<misaligning_allocator<std::byte, 8>>();
  check_allocator<misaligning_allocator<std::byte, 64>>();
}

TEST_CASE("an allocator may have pointers of its own", "[workspace]") {
  check_allocator<offset_allocator<std::byte>>();
}
