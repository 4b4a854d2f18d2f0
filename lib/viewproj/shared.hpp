// A pointer to numbers that never change and that copies share. It stands in for std::shared_ptr, because <memory>
// takes as long to compile as all other headers of the library together.
#pragma once

namespace viewproj::detail {

struct Owners;
void addOwner(Owners* owners) noexcept;
void removeOwner(Owners* owners) noexcept;  ///< the last one deletes what is shared

template <class Parts>
class Shared {
 public:
  Shared() noexcept = default;
  /// owners counts this one already.
  Shared(const Parts* parts, Owners* owners) noexcept : parts_(parts), owners_(owners) {}
  /// A member of what whole shares.
  template <class Whole>
  Shared(const Shared<Whole>& whole, const Parts& member) noexcept : parts_(&member), owners_(whole.owners_) {
    addOwner(owners_);
  }
  Shared(const Shared& other) noexcept : parts_(other.parts_), owners_(other.owners_) { addOwner(owners_); }
  Shared& operator=(const Shared& other) noexcept {
    addOwner(other.owners_);
    removeOwner(owners_);
    parts_ = other.parts_;
    owners_ = other.owners_;
    return *this;
  }
  ~Shared() { removeOwner(owners_); }

  const Parts* get() const noexcept { return parts_; }
  const Parts& operator*() const noexcept { return *parts_; }
  const Parts* operator->() const noexcept { return parts_; }
  explicit operator bool() const noexcept { return parts_ != nullptr; }

 private:
  template <class Other>
  friend class Shared;

  const Parts* parts_ = nullptr;
  Owners* owners_ = nullptr;
};

}  // namespace viewproj::detail
