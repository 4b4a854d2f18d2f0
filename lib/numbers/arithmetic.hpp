// The floating-point arithmetic that the library's accuracy depends on (viewproj/camera.hpp).
#pragma once

namespace viewproj::detail {

/// What is wrong with this thread's arithmetic, or null. Takes nanoseconds.
const char* arithmeticFault() noexcept;

}  // namespace viewproj::detail
