// The only file of the tests that knows the folders: all others compile to the same object in any checkout.
#include "tests/support/places.h"

namespace erbs::test {

std::string in_source(const std::string& path) { return ERBS_SOURCE_DIR + path; }
std::string in_build(const std::string& path) { return ERBS_BINARY_DIR + path; }

}  // namespace erbs::test
