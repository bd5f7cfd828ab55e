// SPDX-License-Identifier: Apache-2.0
// One program of sources that are compiled for different instruction sets: the linker must not take
// a piece of the one's code for a part of the other's.
#include <cstdint>
#include <cstdio>

std::uint32_t bucket_sse2(std::uint32_t n);
std::uint32_t bucket_avx2(std::uint32_t n);

int main() {
  std::uint32_t const n = 23 * 5000;
  std::uint32_t const expected = 20 * 5000;
  if (!__builtin_cpu_supports("avx2")) {
    std::printf("not tried: this processor has no AVX2\n");
    return 0;
  }
  std::uint32_t const plain = bucket_sse2(n);
  std::uint32_t const wide = bucket_avx2(n);
  std::printf("%u and %u, expected %u\n", plain, wide, expected);
  return plain == expected && wide == expected ? 0 : 1;
}
