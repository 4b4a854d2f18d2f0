// Catch2 2.13 (Debian 12) or 3.x, whichever is there.
#pragma once

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif

/// The number but for its last digits; Catch's own margin is 1.2e-5 of it.
inline Approx closely(double number) { return Approx(number).epsilon(1e-15); }
