// Whatever the bytes: a listing that is written as it is read and has a recursion of as many formulas as
// states, or the error that says why not. The checker's reader reads it or says that it is malformed.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "certificates/code/listing_text.hpp"
#include "certificates/code/recursion.hpp"
#include "checker/code/listing.hpp"
#include "checker/verification.hpp"

using namespace veritrack::certificates::code;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  try {
    (void)veritrack::checker::read_listing(bytes);
  } catch (const veritrack::checker::Malformed&) {
    // It is for the producer to say why.
  }
  try {
    const auto listing = parse_listing(bytes);
    const auto text = listing_text(listing);
    if (listing_text(parse_listing(text)) != text) {
      std::abort();
    }
    const Recursion recursion = recursion_of(listing);
    if (recursion.start.size() != recursion.states.size()) {
      std::abort();
    }
  } catch (const ListingError&) {
    return 0;
  } catch (const NoRecursion&) {
    return 0;
  }
  return 0;
}
