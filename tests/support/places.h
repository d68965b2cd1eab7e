// Where the tests find the tree and what was built of it.
#pragma once
#include <string>

namespace erbs::test {

std::string in_source(const std::string& path);  // "/scenes/first.lua": of the tree
std::string in_build(const std::string& path);   // "/erbs": the program

}  // namespace erbs::test
