// The floating-point arithmetic that every promise of this library rests on (viewproj/camera.hpp).
#pragma once

namespace viewproj::detail {

/// What of it this thread lacks, or null. Takes nanoseconds.
const char* arithmeticFault() noexcept;

}  // namespace viewproj::detail
