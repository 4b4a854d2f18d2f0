// Places on the Earth.
#pragma once

#include "geodesy/geodesy.hpp"
