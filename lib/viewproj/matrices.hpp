// The matrices of a camera, and the matrix of a model.
#pragma once

#include "matrices/matrices.hpp"
#include "matrices/model.hpp"
