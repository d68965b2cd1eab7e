#include "engine/record/folder/colors.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace erbs {
namespace {

bool is_clay(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::ranges::any_of(std::array{"brick", "clay", "tile", "terracotta"},
                             [&](const char* word) { return name.find(word) != std::string::npos; });
}

}  // namespace

void tell_apart(std::vector<Material>& materials) {
  const Vec3 none = Material{}.color;
  static const std::vector<Vec3> clays{none, {0.55, 0.24, 0.19}, {0.80, 0.50, 0.33}, {0.60, 0.40, 0.34}, {0.86, 0.62, 0.42}},
      stones{{0.80, 0.75, 0.64}, {0.56, 0.57, 0.59}, {0.76, 0.62, 0.43}, {0.66, 0.70, 0.66},
             {0.42, 0.44, 0.49}, {0.90, 0.87, 0.80}, {0.58, 0.52, 0.44}, {0.72, 0.60, 0.57}};
  if (std::ranges::count(materials, none, &Material::color) < 2) return;
  std::size_t of_clay = 0, of_stone = 0;
  for (Material& m : materials) {
    if (m.color != none) continue;
    const bool clay = is_clay(m.name);
    std::size_t& used = clay ? of_clay : of_stone;
    const std::vector<Vec3>& colors = clay ? clays : stones;
    m.color = std::pow(0.85, double(used / colors.size())) * colors[used % colors.size()];  // each further round is darker
    ++used;
  }
}

}  // namespace erbs
