// The stages between world and screen.
#pragma once

#include "projection/clip.hpp"
