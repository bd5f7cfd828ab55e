// SPDX-License-Identifier: Apache-2.0
#pragma once

// The architectures that a translation unit is compiled for, as a name: sm_800_900. All device code
// lies in an inline namespace of that name. Otherwise the linker would merge the kernels and
// launches of units that are compiled for different GPUs.

#define DEFERRED_SHADE_JOIN_1(a) sm_##a
#define DEFERRED_SHADE_JOIN_2(a, b) sm_##a##_##b
#define DEFERRED_SHADE_JOIN_3(a, b, c) sm_##a##_##b##_##c
#define DEFERRED_SHADE_JOIN_4(a, b, c, d) sm_##a##_##b##_##c##_##d
#define DEFERRED_SHADE_JOIN_5(a, b, c, d, e) sm_##a##_##b##_##c##_##d##_##e
#define DEFERRED_SHADE_JOIN_6(a, b, c, d, e, f) sm_##a##_##b##_##c##_##d##_##e##_##f
// Longer lists are named by their first six: nobody compiles two units of a program for lists that
// differ only behind those.
#define DEFERRED_SHADE_JOIN_7(a, b, c, d, e, f, ...) sm_##a##_##b##_##c##_##d##_##e##_##f##_more
#define DEFERRED_SHADE_PICK(_1, _2, _3, _4, _5, _6, _7, _8, _9, _10, _11, _12, _13, _14, _15, _16, \
                            NAME, ...)                                                             \
  NAME
#define DEFERRED_SHADE_JOIN(...)                                                           \
  DEFERRED_SHADE_PICK(__VA_ARGS__, DEFERRED_SHADE_JOIN_7, DEFERRED_SHADE_JOIN_7,           \
                      DEFERRED_SHADE_JOIN_7, DEFERRED_SHADE_JOIN_7, DEFERRED_SHADE_JOIN_7, \
                      DEFERRED_SHADE_JOIN_7, DEFERRED_SHADE_JOIN_7, DEFERRED_SHADE_JOIN_7, \
                      DEFERRED_SHADE_JOIN_7, DEFERRED_SHADE_JOIN_7, DEFERRED_SHADE_JOIN_6, \
                      DEFERRED_SHADE_JOIN_5, DEFERRED_SHADE_JOIN_4, DEFERRED_SHADE_JOIN_3, \
                      DEFERRED_SHADE_JOIN_2, DEFERRED_SHADE_JOIN_1, )                      \
  (__VA_ARGS__)
#define DEFERRED_SHADE_JOIN_LIST(list) DEFERRED_SHADE_JOIN(list)

#ifdef __CUDA_ARCH_LIST__
#define DEFERRED_SHADE_ARCHITECTURES DEFERRED_SHADE_JOIN_LIST(__CUDA_ARCH_LIST__)
#else
#define DEFERRED_SHADE_ARCHITECTURES any_architecture
#endif
