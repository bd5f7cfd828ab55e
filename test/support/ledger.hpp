// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <new>

#include "backends.hpp"

namespace test {

/// What a ledger_allocator wrote down, and the largest array that it may have.
struct ledger {
  std::size_t allocations = 0;
  std::size_t live_bytes = 0;
  std::size_t limit = static_cast<std::size_t>(-1);
};

/// The allocator of a backend, with a ledger: counts, and fails on demand.
template <class T, class Backend = cpp>
struct ledger_allocator {
  using value_type = T;
  using memory = typename Backend::template allocator<T>;
  ledger* book;

  explicit ledger_allocator(ledger& l) : book(&l) {}
  template <class U>
  ledger_allocator(ledger_allocator<U, Backend> const& other) : book(other.book) {}

  T* allocate(std::size_t n) {
    if (n * sizeof(T) > book->limit) throw std::bad_alloc();
    T* const p = memory().allocate(n);
    ++book->allocations;
    book->live_bytes += n * sizeof(T);
    return p;
  }
  void deallocate(T* p, std::size_t n) {
    book->live_bytes -= n * sizeof(T);
    memory().deallocate(p, n);
  }
  template <class U>
  bool operator==(ledger_allocator<U, Backend> const& other) const {
    return book == other.book;
  }
};

}  // namespace test
