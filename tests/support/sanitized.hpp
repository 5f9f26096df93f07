// Whether a test is compiled with sanitizers, which make it ten to thirty times as slow.
//
// What they watch is the code that runs, and it is the same in every step: such builds may take fewer steps, sizes or
// numbers of threads where the release build checks the result with all of them.
#pragma once

namespace galet::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace galet::test
