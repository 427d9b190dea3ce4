// A listing as text: a line for each operation, the same on every machine.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "trackers/code/listing.hpp"

namespace veritrack::certificates::code {

/// A text that is no listing, with its line.
class ListingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Constants stand where they are used: f32:0x1p-1, i32:7.
[[nodiscard]] std::string listing_text(const trackers::code::Listing& listing);

/// The listing of a text that `listing_text` has made. Throws ListingError for any other.
[[nodiscard]] trackers::code::Listing parse_listing(std::string_view text);

/// A constant: f32:0x1p-1, i32:7.
[[nodiscard]] std::string constant_text(trackers::code::Format format, std::uint64_t bits);

}  // namespace veritrack::certificates::code
