// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace test {

/// An allocator that counts, and that fails on demand.
struct ledger {
  std::size_t allocations = 0;
  std::size_t live_bytes = 0;
  std::size_t limit = static_cast<std::size_t>(-1);
};

template <class T>
struct ledger_allocator {
  using value_type = T;
  ledger* book;

  explicit ledger_allocator(ledger& l) : book(&l) {}
  template <class U>
  ledger_allocator(ledger_allocator<U> const& other) : book(other.book) {}

  T* allocate(std::size_t n) {
    if (n * sizeof(T) > book->limit) throw std::bad_alloc();
    ++book->allocations;
    book->live_bytes += n * sizeof(T);
    return std::allocator<T>().allocate(n);
  }
  void deallocate(T* p, std::size_t n) {
    book->live_bytes -= n * sizeof(T);
    std::allocator<T>().deallocate(p, n);
  }
  template <class U>
  bool operator==(ledger_allocator<U> const& other) const {
    return book == other.book;
  }
};

}  // namespace test
