// The floating-point arithmetic that every promise of this library rests on.
//
// The thread that calls it must round to the nearest, ties to even, and keep subnormal numbers, as a program does that
// changes neither: no other fesetround, no flush-to-zero, no denormals-are-zero (which -ffast-math turns on in whatever
// is linked with it, for all of the program). makeCamera asks for it and throws CameraError; what is called with a
// camera afterwards, in whatever thread, does not look again.
#pragma once

namespace viewproj {

/// What of it this thread lacks, or null. Takes nanoseconds.
const char* arithmeticFault() noexcept;

}  // namespace viewproj
