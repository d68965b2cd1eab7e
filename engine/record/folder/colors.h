// Colours of materials in pictures, pages and exported models.
#pragma once
#include <vector>

#include "engine/scene/scene.h"

namespace erbs {

// Where several materials have no colour of their own, each gets another one (sRGB): of fired clay, or of stone, by its name.
void tell_apart(std::vector<Material>& materials);

}  // namespace erbs
