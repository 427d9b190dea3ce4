// A request on the command line that does not fit the design.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace veritrack::certificates {

/// what(): the request and what is allowed, on one line.
class RequestError : public std::invalid_argument {
 public:
  /// `key` of the design file that does not fit, e.g. "model.states"; empty when none does.
  explicit RequestError(const std::string& message, std::string key = {})
      : std::invalid_argument(message), key_(std::move(key)) {}

  [[nodiscard]] const std::string& key() const noexcept { return key_; }

 private:
  std::string key_;
};

}  // namespace veritrack::certificates
