// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pthread.h>
#include <cstddef>
#include <cstring>
#include <memory>

// Sanitizers make frames larger, and unoptimised code does.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
#define DEFERRED_SHADE_TEST_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define DEFERRED_SHADE_TEST_SANITIZED 1
#endif
#endif

namespace test {

/// The bytes of stack that a call of `f` takes, on a thread whose stack was painted before.
template <class Function>
std::size_t stack_bytes(Function const& f) {
  constexpr std::size_t size = std::size_t{4} << 20;
  constexpr unsigned char paint = 0xa5;
  std::unique_ptr<unsigned char[]> const memory(new unsigned char[size + 4096]);
  auto* const aligned =
      memory.get() + (4096 - reinterpret_cast<std::uintptr_t>(memory.get()) % 4096);
  std::memset(aligned, paint, size - 4096);
  auto const touched = [&] {
    std::size_t untouched = 0;
    while (untouched < size && aligned[untouched] == paint) ++untouched;
    return size - untouched;
  };
  auto const run = [&](void* (*body)(void*), void* argument) {
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstack(&attributes, aligned, size - 4096);
    pthread_t thread;
    pthread_create(&thread, &attributes, body, argument);
    pthread_join(thread, nullptr);
    pthread_attr_destroy(&attributes);
  };
  // What the thread itself takes, with its thread-local data, is not the function's.
  run([](void*) -> void* { return nullptr; }, nullptr);
  std::size_t const before = touched();
  run(
      [](void* argument) -> void* {
        (*static_cast<Function const*>(argument))();
        return nullptr;
      },
      const_cast<Function*>(&f));
  return touched() - before;
}

}  // namespace test
