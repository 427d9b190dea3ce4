// Suggests the known key that the author of an unknown one may have meant.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace veritrack::certificates {

/// The least number of insertions, deletions, replacements and swaps of neighbours that turns `a` into `b`,
/// no piece being edited twice (the optimal string alignment distance), in bytes.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The element of `known` (dotted paths, not empty) that is nearest to `path`: by the whole path, or by its
/// last part alone at the price of one more edit, since a key may be in the wrong table. The first one
/// when several are.
[[nodiscard]] const std::string& nearest_key(std::string_view path, std::span<const std::string> known);

}  // namespace veritrack::certificates
