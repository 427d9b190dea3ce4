// The arithmetic of a program that is not ours, left as it was.
#pragma once

#include "analysis/rigor/rounding.hpp"

namespace veritrack::rigor {

/// Gives this thread its control register back as it was when the object was made: rounding mode, treatment of
/// denormals, and the sticky exception flags, which HeldRounding leaves raised.
class KeptControl {
 public:
  KeptControl() noexcept : previous_(detail::read_control()) {}
  ~KeptControl() { detail::write_control(previous_); }
  KeptControl(const KeptControl&) = delete;
  KeptControl& operator=(const KeptControl&) = delete;
  KeptControl(KeptControl&&) = delete;
  KeptControl& operator=(KeptControl&&) = delete;

 private:
  unsigned int previous_;
};

}  // namespace veritrack::rigor
