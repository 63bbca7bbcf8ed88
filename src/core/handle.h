/// Ownership of objects that a C library makes and releases.
#pragma once

#include <memory>

namespace tenku {

template <auto Release>
struct Releaser {
  void operator()(auto* object) const noexcept { Release(object); }
};

/// Sole owner of a C object; `Release` is the library's own function.
template <class T, auto Release>
using Handle = std::unique_ptr<T, Releaser<Release>>;

}  // namespace tenku
