// The text of a design file with other values, everything else as it was.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace veritrack::certificates {

/// A key of a table and its value as TOML; none: the key is removed.
struct DesignEdit {
  std::string key;
  std::optional<std::string> value;
};

/// Values are replaced in place, a removed key takes its line along, and a new key gets a line below the
/// others. Empty when the text has no table [design] with a header and a line for each key. `text` must be a
/// design file that can be read.
[[nodiscard]] std::optional<std::string> with_design_values(const std::string& text,
                                                            const std::vector<DesignEdit>& edits);

/// The same for values under [model], `parameters`, which may stand in one line. Empty when the text does not
/// have such a table with all of these keys. Every edit has a value.
[[nodiscard]] std::optional<std::string> with_parameter_values(const std::string& text,
                                                               const std::vector<DesignEdit>& edits);

}  // namespace veritrack::certificates
