// Numbers of a certificate.json in units in which those of two designs can be compared.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "analysis/rigor/interval.hpp"
#include "certificates/design/key_contract.hpp"

namespace veritrack::reports {

/// The value of a key as certificate.json repeats it, and what its numbers are in.
struct ContractValue {
  const nlohmann::ordered_json* json = nullptr;  ///< null: the key is left out
  bool in_hertz = false;                         ///< the ends of its numbers are in Hz, or Hz per second
  std::optional<rigor::Interval> sample_rate = std::nullopt;  ///< Hz
};

/// A number in the units in which two may be compared.
struct Measured {
  std::optional<rigor::Interval> sampled = std::nullopt;   ///< as it is, in rad/sample, or in samples
  std::optional<rigor::Interval> physical = std::nullopt;  ///< in Hz, or in seconds
  bool written_in_hertz = false;
};

/// The number of a decimal; nothing for other text.
[[nodiscard]] std::optional<rigor::Interval> decimal_in(std::string_view text);

/// The hexadecimal ends of a number of certificate.json; nothing for anything else.
[[nodiscard]] std::optional<rigor::Interval> number_in(const nlohmann::ordered_json& json);

/// A number of the value, in all units that its sample rate gives; nothing for anything but a number. Needs
/// the upward rounding mode.
[[nodiscard]] std::optional<Measured> measured(const nlohmann::ordered_json& json, const ContractValue& value,
                                               certificates::Measure measure);

}  // namespace veritrack::reports
