// The pages of the topics.
#pragma once

#include <string>

namespace viewproj::cmd::pages {

std::string camera(std::size_t width);
std::string projection(std::size_t width);
std::string viewport(std::size_t width);
std::string points(std::size_t width);
std::string pixels(std::size_t width);
std::string scene(std::size_t width);
std::string conventions(std::size_t width);
std::string formats(std::size_t width);
std::string precision(std::size_t width);

}  // namespace viewproj::cmd::pages
