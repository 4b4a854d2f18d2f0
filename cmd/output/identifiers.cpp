#include "output/identifiers.hpp"

#include <cctype>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace viewproj::cmd {
namespace {

/// Of C, C++, GLSL, HLSL, WGSL and Python, between blanks.
constexpr std::string_view kKept =
    " False None True abstract active alignas alignof and and_eq array as asm assert async atomic attribute auto "
    "await become binding_array bitand bitcast bitor bool break buffer case cast catch cbuffer centroid char "
    "char16_t char32_t char8_t class co_await co_return co_yield coherent column_major common compl concept const "
    "const_assert const_cast consteval constexpr constinit continue continuing decltype def default del delete "
    "demote diagnostic discard do double dynamic_cast elif else enable enum except explicit export extends extern "
    "external f16 f32 false filter final finally finish fixed flat float fn for friend from fvec2 fvec3 fvec4 get "
    "global goto groupshared half handle highp hvec2 hvec3 hvec4 i32 if immutable impl import in inline inout input "
    "instanceof int interface invariant is isampler2D lambda layout let line lineadj linear long loop lowp macro "
    "main mat2 mat3 mat4 match matrix mediump mod module move mut mutable namespace new nil noexcept nointerpolation "
    "nonlocal noperspective not not_eq np null nullptr of operator or or_eq out output override packed partition "
    "pass patch pixelfragment point precise precision priv private protected ptr pub public raise ref regardless "
    "register reinterpret_cast requires resource restrict return row_major sample sampler sampler2D self set shared "
    "short signed sizeof smooth snorm static static_assert static_cast string struct subroutine super superp switch "
    "target task tbuffer technique template texture then this thread_local throw trait triangle triangleadj true try "
    "type typedef typeid typename typeof u32 uint uniform union unless unorm unsafe unsigned use using var varying "
    "vec vec2 vec3 vec4 vector vertexfragment virtual void volatile wchar_t wgsl where while with writeonly xor "
    "xor_eq yield ";

std::string identifier(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const bool good = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (good || !result.ends_with('_')) result += good ? c : '_';  // two in a row are the languages' own
  }
  const bool starts =
      !result.empty() && std::isalpha(static_cast<unsigned char>(result[0])) && !result.starts_with("gl_");
  if (!starts) result = "m" + result;
  if (kKept.find(' ' + result + ' ') != std::string_view::npos) result += '_';
  return result;
}

}  // namespace

std::vector<std::string> identifiersOf(const std::vector<std::string>& names, std::vector<std::string> taken) {
  std::unordered_set<std::string> used(taken.begin(), taken.end());
  std::vector<std::string> result;
  // Those that need no number first.
  for (const std::string& name : names) {
    std::string own = identifier(name);
    if (own != name || !used.insert(own).second) own.clear();
    result.push_back(own);
  }
  std::unordered_map<std::string, std::size_t> next;  // number of a name, so that many of one name take no longer
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!result[i].empty()) continue;
    const std::string base = identifier(names[i]);
    std::size_t& number = next.try_emplace(base, 2).first->second;
    std::string own = base;
    while (!used.insert(own).second) own = base + (base.ends_with('_') ? "" : "_") + std::to_string(number++);
    result[i] = own;
  }
  return result;
}

}  // namespace viewproj::cmd
