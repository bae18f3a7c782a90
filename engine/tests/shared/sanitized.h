#pragma once

namespace ccdt {

/// Is this test built with a sanitizer, which makes it about ten times as slow? Such tests leave out cases that run the
/// same code as smaller ones.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif

}  // namespace ccdt
