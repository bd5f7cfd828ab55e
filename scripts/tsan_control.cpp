// SPDX-License-Identifier: Apache-2.0
// A program with a race, on purpose: scripts/test makes sure that ThreadSanitizer finds it.
int main() {
  int sum = 0;
#pragma omp parallel for
  for (int i = 0; i < 1000; ++i) sum += i & 1;
  return sum < 0;
}
