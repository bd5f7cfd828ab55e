// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace deferred_shade::detail {

/// Whether T is an extended lambda for the device alone. nvcc does not tell its host compiler what
/// such a lambda returns.
#ifdef __CUDACC_EXTENDED_LAMBDA__
template <class T>
inline constexpr bool is_device_lambda = __nv_is_extended_device_lambda_closure_type(T);
#else
template <class T>
inline constexpr bool is_device_lambda = false;
#endif

}  // namespace deferred_shade::detail
