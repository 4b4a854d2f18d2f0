#include "output/named_output.hpp"

#include <system_error>

#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/visible.hpp"

namespace viewproj::cmd {

NamedOutput::NamedOutput(const std::string& name) : name_(name) {
  if (name == "-") return;
  requireNone(beginReplacement(name, replacement_));
  nameOutput(visible(name));
}

NamedOutput::~NamedOutput() { endReplacement(replacement_); }

void NamedOutput::keep() { requireNone(keepReplacement(replacement_)); }

void NamedOutput::requireNone(int error) const {
  if (error != 0) throw InputError(visible(name_) + ": " + std::generic_category().message(error));
}

}  // namespace viewproj::cmd
