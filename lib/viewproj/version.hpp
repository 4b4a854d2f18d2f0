// The version of these headers. The build reads it from this file.
#pragma once

#define VIEWPROJ_VERSION_MAJOR 0
#define VIEWPROJ_VERSION_MINOR 2
#define VIEWPROJ_VERSION_PATCH 0

/// One number for comparisons: 10000 major + 100 minor + patch.
#define VIEWPROJ_VERSION (VIEWPROJ_VERSION_MAJOR * 10000 + VIEWPROJ_VERSION_MINOR * 100 + VIEWPROJ_VERSION_PATCH)
