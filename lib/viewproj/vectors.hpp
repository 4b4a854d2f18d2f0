// Plain vectors and matrices.
#pragma once

#include "numbers/vectors.hpp"
